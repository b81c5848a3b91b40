"""What things are cut into: nothing is lost, nothing overlaps, and the pattern is the one that was asked for."""

import itertools
import math

import numpy as np
import pytest

from worldkit import breaking
from worldkit.breaking.convex_cells import OUTSIDE, cells, solid
from worldkit.breaking.section import section, stress
from worldkit.forms import lathe

WHOLE = {
    "plate": (lambda: breaking.plate((0.5, 0.004, 0.4), 24, seed=2), 0.5 * 0.4 * 0.004, 1e-12),
    "struck": (lambda: breaking.plate((0.5, 0.4, 0.004), 24, 2, struck_at=(0.1, 0.0, 0.0)), 0.5 * 0.4 * 0.004, 1e-12),
    "twig": (lambda: breaking.rod(0.012, 0.3, 7, seed=1), math.pi * 0.006**2 * 0.3, 1e-12),
    "icicle": (
        lambda: breaking.rod(0.03, 0.3, 6, tip=0.006),
        math.pi * 0.3 * (0.015**2 + 0.015 * 0.003 + 0.003**2) / 3,
        1e-12,
    ),
    "cup": (
        lambda: breaking.vessel([(0, 0), (0.04, 0), (0.04, 0.08)], 0.004, 12),
        lathe(profile=[(0, 0), (0.04, 0), (0.04, 0.08)], wall=0.004).volume,
        0.006,
    ),
}


@pytest.mark.parametrize("name", WHOLE)
def test_the_pieces_are_the_whole(name: str) -> None:
    make, volume, share = WHOLE[name]
    made = make()
    assert abs(made.volume / volume - 1) < share + 1e-9
    assert all(piece.volume > 0 for piece in made.pieces)


@pytest.mark.parametrize("name", WHOLE)
def test_all_pieces_hang_together_by_their_bonds(name: str) -> None:
    made = WHOLE[name][0]()
    reached, found = {0}, True
    while found:
        found = {b for a, b, _ in made.bonds if a in reached} | {a for a, b, _ in made.bonds if b in reached}
        found -= reached
        reached |= found
    assert len(reached) == len(made.pieces)


@pytest.mark.parametrize("name", WHOLE)
def test_hulls_of_neighbours_stand_back_from_the_face_they_share(name: str) -> None:
    made = WHOLE[name][0]()
    for one, other, face in made.bonds:
        gap = (made.pieces[other].hull @ face.axes[0]).min() - (made.pieces[one].hull @ face.axes[0]).max()
        assert gap == pytest.approx(1e-4, abs=2e-8)


def test_a_seed_decides_the_pattern() -> None:
    first, again, other = (breaking.plate((0.5, 0.004, 0.4), 9, seed=s) for s in (1, 1, 2))
    assert np.array_equal(first.pieces[4].hull, again.pieces[4].hull)
    assert not np.array_equal(first.pieces[4].centre, other.pieces[4].centre)


def test_cracks_run_out_from_a_blow() -> None:
    """Shards near the blow are smaller, and longer along the way out from it than a pane's that breaks evenly."""
    blow = np.array([0.1, 0.0, -0.05])
    made = breaking.plate((0.6, 0.004, 0.6), 40, seed=1, struck_at=tuple(blow))
    away = np.array([np.linalg.norm(piece.centre - blow) for piece in made.pieces])
    size = np.array([piece.volume for piece in made.pieces])
    assert size[away < 0.1].mean() < 0.4 * size[away > 0.2].mean()


def test_chocolate_breaks_along_its_grooves() -> None:
    made = breaking.grooved((0.12, 0.06, 0.01), columns=4, rows=2, groove=0.004)
    assert len(made.pieces) == 8 and len(made.bonds) == 4 + 6
    for _, _, face in made.bonds:
        assert face.area == pytest.approx(0.03 * 0.006)  # what the groove leaves
        assert face.moduli[1] == pytest.approx(0.03 * 0.006**2 / 6)


def test_a_section_bends_as_beams_do() -> None:
    b, h = 0.04, 0.01
    corners = np.array([[0, y, z] for y, z in ((-b / 2, 0), (b / 2, 0), (b / 2, h), (-b / 2, h))])
    halves = [np.clip(corners, [0, -1, 0], [0, 0, 1]), np.clip(corners, [0, 0, 0], [0, 1, 1])]
    for polygons in ([corners], halves, [corners[::-1]]):
        made = section(polygons, np.array([1.0, 0, 0]))
        assert made.area == pytest.approx(b * h)
        assert made.centre == pytest.approx([0, 0, h / 2])
        assert made.moduli == pytest.approx([b * h**2 / (3 + 1.8 * h / b), b * h**2 / 6, h * b**2 / 6])
        assert abs(made.axes[1]) == pytest.approx([0, 1, 0])


def test_stress_is_the_largest_tension() -> None:
    areas, moduli = np.array([2.0]), np.array([[1.0, 4.0, 5.0]])

    def under(force: tuple[float, ...], moment: tuple[float, ...]) -> float:
        return float(stress(np.array([force]), np.array([moment]), areas, moduli)[0])

    assert under((6, 0, 0), (0, 0, 0)) == pytest.approx(3)
    assert under((0, 0, 0), (0, -8, 0)) == pytest.approx(2)
    assert under((-6, 0, 0), (0, 0, 0)) == pytest.approx(0)  # what is pressed does not tear
    assert under((0, 3, 4), (0, 0, 0)) == pytest.approx(2.5)  # pure shear tears aslant, at its own number
    assert under((0, 0, 0), (1.5, 0, 0)) == pytest.approx(1.5)


def test_cells_of_any_solid_fill_it() -> None:
    rng = np.random.default_rng(0)
    whole = solid(rng.normal(size=(20, 3)))
    made = cells(whole, 0.3 * rng.normal(size=(15, 3)))
    joined = breaking.convex([tuple(p) for f in whole.faces for p in f.corners], [(0, 0, 0)])
    pieces = breaking.convex([tuple(p) for f in whole.faces for p in f.corners], 0.3 * rng.normal(size=(15, 3)))
    assert pieces.volume == pytest.approx(joined.volume, rel=1e-9)
    assert sum(face.neighbour == OUTSIDE for cell in made for face in cell.faces) >= len(whole.faces)


REFUSED = {
    "too few": (lambda: breaking.plate((0.5, 0.004, 0.4), 1), "give 2 or more"),
    "no thickness": (lambda: breaking.plate((0.5, 0.0, 0.4), 5), "three numbers above"),
    "a point": (lambda: breaking.rod(0.04, 0.3, 5, tip=0.0), "diameter above 0"),
    "a tip below none": (lambda: breaking.rod(0.04, 0.3, 5, tip=-0.01), "diameter above 0"),
    "struck beside": (lambda: breaking.plate((0.5, 0.004, 0.4), 5, struck_at=(0.4, 0, 0)), "lies beside"),
    "groove too deep": (lambda: breaking.grooved((0.1, 0.1, 0.01), 2, 2, 0.02), "give one between"),
    "one place": (
        lambda: breaking.convex(list(itertools.product((0, 1), repeat=3)), [(0.5, 0.5, 0.5)] * 2),
        "move one",
    ),
    "outside": (
        lambda: breaking.convex(list(itertools.product((0, 1), repeat=3)), [(0.5, 0.5, 0.5), (9, 9, 9), (8, 8, 8)]),
        "owns nothing",
    ),
    "flat": (lambda: breaking.convex([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0.5, 0.5, 0)]), "in one plane"),
    "unknown stuff": (lambda: breaking.material("unobtainium"), "porcelain"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_break_is_refused_with_a_way_out(name: str) -> None:
    call, words = REFUSED[name]
    with pytest.raises(ValueError, match=words):
        call()
