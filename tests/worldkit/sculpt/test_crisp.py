"""Exact solids: watertight, of the volume that geometry says, with edges where they were put."""

import math

import numpy as np
import pytest
import trimesh

from worldkit.sculpt import crisp

SQUARE = [(-0.2, -0.15), (0.2, -0.15), (0.2, 0.15), (-0.2, 0.15)]


def closed(solid):
    skin = solid.skin()
    mesh = trimesh.Trimesh(skin.vertices, skin.faces, process=False)
    assert mesh.is_watertight
    return mesh


def test_a_lathe_and_what_is_taken_away():
    outer = crisp.lathe([(0.04, 0.0), (0.04, 0.1)])
    assert closed(outer).volume == pytest.approx(math.pi * 0.0016 * 0.1, rel=2e-3)
    cup = outer - crisp.lathe([(0.036, 0.005), (0.036, 0.2)])
    assert closed(cup).volume == pytest.approx(math.pi * (0.0016 * 0.1 - 0.036**2 * 0.095), rel=2e-3)


def test_a_bevel_takes_the_edges_and_no_more():
    sharp, round_ = closed(crisp.slab(SQUARE, 0.02)), closed(crisp.slab(SQUARE, 0.02, bevel=0.003))
    assert round_.bounds == pytest.approx(sharp.bounds, abs=1e-4)
    assert 0.98 * sharp.volume < round_.volume < sharp.volume
    box = closed(crisp.box((0.1, 0.2, 0.3), bevel=0.01))
    assert box.extents == pytest.approx((0.1, 0.2, 0.3)) and box.volume < 0.006


def test_a_loft_is_the_frustum_it_describes():
    rows = [[(s * x, s * y, z) for x, y in SQUARE] for z, s in ((0.0, 1.0), (0.3, 0.5))]
    assert closed(crisp.loft(rows)).volume == pytest.approx(0.3 / 3 * 0.12 * (1 + 0.5 + 0.25))


def test_a_sweep_keeps_its_section():
    path = [(0.1 * math.cos(a), 0.1 * math.sin(a), 0.0) for a in np.linspace(0, math.pi, 9)]
    mesh = closed(crisp.sweep(crisp.ring(0.02), path))
    assert mesh.volume == pytest.approx(math.pi * 0.0001 * math.pi * 0.1, rel=0.02)


def test_hard_edges_are_drawn_hard_and_round_ones_round():
    drawn = crisp.lathe([(0.04, 0.0), (0.04, 0.1)]).drawn()
    assert np.isclose(np.abs(drawn.normals[:, 2]), 1).sum() + np.isclose(drawn.normals[:, 2], 0).sum() == len(
        drawn.normals
    )


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: crisp.box((0.1, 0.1, 0.1)) - crisp.box((0.2, 0.2, 0.2)),
        lambda: crisp.slab(SQUARE, 0.004, bevel=0.003),
        lambda: crisp.slab([(0, 0), (1, 0)], 0.1),
        lambda: crisp.loft([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]]),
    ],
)
def test_what_cannot_be_made_is_refused_with_words(wrong):
    with pytest.raises(ValueError, match=r".{15}"):
        wrong()


@pytest.mark.parametrize(
    ("solid", "volume"),
    [
        (lambda: crisp.ball(0.1), math.pi * 0.1**3 / 6),
        (lambda: crisp.cylinder(0.1, 0.2), math.pi * 0.05**2 * 0.2),
        (lambda: crisp.pipe(0.1, 0.08, 0.2), math.pi * (0.05**2 - 0.04**2) * 0.2),
        (lambda: crisp.torus(0.1, 0.02), 2 * math.pi**2 * 0.04 * 0.01**2),
        (lambda: crisp.torus(0.1, 0.02, 90), math.pi**2 / 2 * 0.04 * 0.01**2),
        (lambda: crisp.wire([(0, 0, 0), (0, 0.1, 0), (0, 0.2, 0)], 0.02), math.pi * 0.01**2 * 0.2),
        (lambda: crisp.around(crisp.ball(0.02).translate(x=0.1), 6), math.pi * 0.02**3),
    ],
    ids=["ball", "cylinder", "pipe", "torus", "a quarter of one", "wire", "around"],
)
def test_round_things_have_the_volume_of_geometry(solid, volume):
    assert closed(solid()).volume == pytest.approx(volume, rel=0.025)


def test_a_bevelled_cylinder_keeps_its_size_and_one_too_large_is_refused():
    low, high = closed(crisp.cylinder(0.1, 0.2, 0.01)).bounds
    assert low == pytest.approx((-0.05, -0.05, 0), abs=1e-6) and high == pytest.approx((0.05, 0.05, 0.2), abs=1e-6)
    with pytest.raises(ValueError, match="does not fit"):
        crisp.cylinder(0.1, 0.02, 0.01)


def test_a_vessel_has_one_wall_and_a_flat_rim():
    cup = closed(crisp.vessel([(0.04, 0.0), (0.04, 0.1)], wall=0.004))
    assert cup.volume == pytest.approx(math.pi * (0.0016 * 0.1 - 0.036**2 * 0.096), rel=2e-3)
    flares = crisp.vessel([(0.02, 0.0), (0.05, 0.06)], wall=0.003).skin().vertices
    rim = flares[flares[:, 2] > 0.06 - 1e-3]
    assert np.allclose(rim[:, 2], 0.06), "nothing of it stands up or is missing"
    across = 0.003 / math.sin(math.atan2(0.06, 0.03))  # the same wall, cut level
    assert np.ptp(np.hypot(rim[:, 0], rim[:, 1])) == pytest.approx(across, rel=0.01)


@pytest.mark.parametrize(
    "profile", [[(0.03, 0), (0.03, -0.05)], [(0.03, 0), (0.002, 0.05)], [(0.003, 0), (0.003, 0.05)]]
)
def test_a_vessel_that_does_not_rise_or_has_no_room_is_refused(profile):
    with pytest.raises(ValueError, match="vessel: "):
        crisp.vessel(profile, wall=0.004)


def test_two_balls_in_a_skin_are_an_egg_and_a_cut_leaves_a_flat_half():
    egg = crisp.hull(crisp.ball(0.05), crisp.ball(0.03).translate(y=-0.03))
    half = closed(egg.cut((0, 0, 2.0), 0.01))
    assert half.bounds[:, 2] == pytest.approx((-0.025, 0.01), abs=1e-6)
    assert half.bounds[:, 1] == pytest.approx((-0.045, 0.025), abs=1e-4)
