"""Filling a container with water: its shape is that of the walls, closed, and what cannot hold it is refused with the number."""

import mujoco
import numpy as np
import pytest

from worldengine.film.renderers.preview import closed_flexes
from worldengine.waves.shown_water import ShownWater
from worldkit import bodies, forms, scene, waters
from worldkit.errors import ProgramError

BOWL = [[0, 0], [0.05, 0], [0.06, 0.1], [0.055, 0.1], [0.045, 0.01], [0, 0.01]]


def basin(**changes: object) -> mujoco.MjSpec:
    spec = scene.new("basin", time_step=0.002)
    bodies.container(
        spec, "basin", **{"size": (1.0, 0.6, 0.3), "wall": 0.05, "pos": (0.2, 0, 0.15), "fixed": True, **changes}
    )
    return spec


def test_a_basin_is_filled_from_wall_to_wall_and_no_higher() -> None:
    spec = basin()
    waters.fill(spec, "water", container="basin", level=0.2, drops=3)
    model = spec.compile()
    shown = ShownWater(model, 0)
    assert (shown.level, shown.beads) == (pytest.approx(0.2), 3)
    assert shown.floor == pytest.approx(0.05, abs=2e-3)
    low, high = shown.outline.min(axis=0), shown.outline.max(axis=0)
    assert low == pytest.approx((-0.25, -0.25), abs=3e-3) and high == pytest.approx((0.65, 0.25), abs=3e-3)
    assert closed_flexes.closed(model, 0), "light goes in and out of it as of a solid thing"


def test_a_round_glass_is_filled_to_its_round_wall() -> None:
    spec = scene.new("glass", time_step=0.002)
    bodies.formed(spec, "glass", form=forms.lathe(profile=BOWL), pos=(0, 0, 0.05), fixed=True)
    waters.fill(spec, "water", container="glass", level=0.08, drops=1)
    reach = np.hypot(*ShownWater(spec.compile(), 0).outline.T)
    assert reach.min() > 0.045 and np.ptp(reach) < 0.003


@pytest.mark.parametrize(
    ("changes", "level", "container", "says"),
    [
        ({}, 0.35, "basin", "open to"),
        ({}, 0.02, "basin", "no floor"),
        ({}, 0.2, "lake", "there is no 'lake'"),
        ({"fixed": False, "density": 500.0}, 0.2, "basin", "can move"),
    ],
)
def test_what_cannot_hold_water_is_refused(changes: dict, level: float, container: str, says: str) -> None:
    with pytest.raises(ProgramError, match=says):
        waters.fill(basin(**changes), "water", container=container, level=level)


@pytest.mark.parametrize("drops", [-1, 0.5, 10**6, float("nan")])
def test_drops_are_a_number_that_can_fly(drops: float) -> None:
    with pytest.raises(ProgramError, match="cannot fly"):
        waters.fill(basin(), "water", container="basin", level=0.2, drops=drops)
    spec = basin()
    waters.fill(spec, "water", container="basin", level=0.2, drops=0)
    assert ShownWater(spec.compile(), 0).beads == 0


def test_a_body_without_a_shape_holds_nothing() -> None:
    spec = basin()
    spec.worldbody.add_body(name="idea", pos=(0, 0, 1))
    with pytest.raises(ProgramError, match="idea has no shape"):
        waters.fill(spec, "water", container="idea", level=1.0)


def test_a_square_rim_over_what_narrows_holds_water_of_both_shapes() -> None:
    """A square of walls over a smaller one that is turned by an eighth."""
    spec = scene.new("sink", time_step=0.002)
    sink = spec.worldbody.add_body(name="sink")
    box = mujoco.mjtGeom.mjGEOM_BOX
    sink.add_geom(type=box, size=(0.3, 0.3, 0.01), pos=(0, 0, 0.01))
    for half, low, high, turn in ((0.12, 0.02, 0.12, np.pi / 4), (0.25, 0.12, 0.3, 0.0)):
        for angle in turn + np.pi / 2 * np.arange(4):
            at = (half + 0.02) * np.array([np.cos(angle), np.sin(angle)])
            sink.add_geom(
                type=box, size=(0.02, half + 0.04, (high - low) / 2), pos=(*at, (low + high) / 2),
                quat=(np.cos(angle / 2), 0, 0, np.sin(angle / 2)),
            )  # fmt: skip
    vessel = waters.measure(spec, "sink", 0.25)
    reach = np.hypot(*vessel.rings.transpose(2, 0, 1))
    assert reach[0].max() == pytest.approx(0.25 * np.sqrt(2), abs=3e-3), "to its corners"
    assert reach[-1].max() == pytest.approx(0.12 * np.sqrt(2), abs=5e-3) and reach[-1].min() < 0.125
    waters.fill(spec, "water", container="sink", level=0.25, drops=1)
    model = spec.compile()
    assert closed_flexes.closed(model, 0) and len(ShownWater(model, 0).outline) == vessel.rings.shape[1]
