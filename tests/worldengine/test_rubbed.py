"""Edges that hands and knocks wore: in flakes along the edges of boxes and cylinders, otherwise on each, the same every time."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import rounded, rubbed, variant
from worldengine.film.renderers.traced.figures import Figures
from worldkit import bodies, materials, scene
from worldkit.materials import paint

WORN = [name for name in materials.LOOKS if materials.look(name).worn_m > 0]
HALF = np.array([0.2, 0.15, 0.1])


def world(before: int = 0) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A corner of a red box, seen from near, straight ahead, and `before` it some grains in the list of geoms, out of sight."""
    spec = scene.new("box", time_step=0.002, setting="studio")
    for number in range(before):
        bodies.sphere(spec, f"grain {number}", diameter=0.01, pos=(0, 5.0, 0.1), look="plastic_grey")
    bodies.box(spec, "box", size=2 * HALF, pos=(0, 0, 0.5), look="paint_red")
    spec.worldbody.add_camera(name="eye", pos=(0.2, -1.2, 0.6), xyaxes=(1, 0, 0, 0, 0, 1), fovy=8)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_what_wears_is_painted_flat() -> None:
    assert {"wood_oak", "concrete", "steel_dark", "paint_red"} <= set(WORN)
    for name in WORN:
        look = materials.look(name)
        assert look.paint and not look.around and look.worn_m <= 0.01, name


@pytest.mark.parametrize("kind", ["box", "cylinder"])
def test_a_strip_along_the_edges_and_the_sides_are_the_whole(kind) -> None:
    half = HALF if kind == "box" else np.array([0.1, 0.1, 0.15])
    wide = rubbed.width(materials.look("paint_red"), kind, half)
    whole = rounded.box(half, wide) if kind == "box" else rounded.cylinder(0.1, 0.15, 32, wide)
    parts = rubbed.parted(whole, kind, half, wide)

    def area(mesh: rounded.Mesh) -> float:
        a, b, c = np.moveaxis(mesh.points[mesh.faces], 1, 0)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

    assert area(parts.sides) + area(parts.strips) == pytest.approx(area(whole))
    assert 0.01 < area(parts.strips) / area(whole) < 0.2
    near = (np.abs(parts.strips.points) if kind == "box" else _turned(parts.strips.points)) - (half - wide)
    assert ((near > -1e-9).sum(axis=1) >= 2).all(), "each of its corners is near two sides at once"
    assert (
        rubbed.width(materials.look("plastic_red"), kind, half)
        == 0
        == rubbed.width(materials.look("paint_red"), "mesh", half)
    )


def _turned(points: np.ndarray) -> np.ndarray:
    """Distance from the axis, nothing, and height."""
    return np.column_stack([np.linalg.norm(points[:, :2], axis=1), np.full(len(points), -1.0), np.abs(points[:, 2])])


@pytest.mark.parametrize("name", ["paint_red", "wood_oak"])
def test_some_of_a_strip_is_worn_and_the_rest_is_as_it_was(name) -> None:
    look = materials.look(name)
    before = ((paint.tile(look, 256)[..., :3] / np.float32(255.0)) ** 2.2).astype(np.float32)
    after = rubbed.flaked(before, look)
    gone = np.abs(after - before).max(axis=-1) > 0.01
    assert 0.2 < gone.mean() < 0.7 and np.array_equal(after, rubbed.flaked(before, look))
    if look.beneath is None:
        assert (after[gone] > before[gone]).mean() > 0.99, "paler"


@pytest.mark.gl
def test_paint_is_chipped_along_edges_only_and_otherwise_on_every_thing() -> None:
    chips = []
    for before in (0, 0, 3):
        model, data = world(before)
        with Frames(model, 200, 112, "preview") as frames:
            picture = frames.image(data, "eye", "still").astype(int)
            front = frames.segmentation(data, "eye") == model.ngeom - 1
        chipped = front & (picture[..., 0] < 1.6 * picture[..., 2])
        assert 40 < chipped.sum() < 0.2 * front.sum()
        assert not chipped[70:, :86].any(), "a centimetre and a half from its edges"
        chips.append(chipped)
    assert np.array_equal(chips[0], chips[1]) and (chips[0] ^ chips[2]).sum() > 10


def test_the_tracer_draws_the_strips_of_a_geom_with_it() -> None:
    variant.choose()
    model, data = world()
    figures = Figures(model, data)
    figures.place(data)
    (strip,) = (figure for figure in figures.all if figure.strip)
    assert strip.geoms == [model.ngeom - 1]
    points = np.array(strip.params["vertex_positions"]).reshape(-1, 3) - (0, 0, 0.5)
    assert np.allclose(np.abs(points).max(axis=0), HALF, atol=1e-4)
    assert ((np.abs(points) > HALF - 0.01).sum(axis=1) >= 2).all()
    data.qpos[0] = 1.0
    mujoco.mj_forward(model, data)
    assert figures.place(data) and np.array(strip.params["vertex_positions"])[::3].mean() == pytest.approx(
        1.0, abs=1e-3
    )
    assert figures.how_many_moved(tuple(f.poses * 0 for f in figures.all), figures.poses()) == sum(
        len(f.geoms) for f in figures.all if not f.strip
    )
