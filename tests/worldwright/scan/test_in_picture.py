"""What is too small to be watched is told once, of the whole thing, with a move that helps."""

from dataclasses import replace

import numpy as np
import pytest

from worldwright.model.plan.committed import Plan
from worldwright.model.recording.stills import Lens
from worldwright.scan.anomalies.checks import too_small_to_watch
from worldwright.scan.anomalies.in_picture import largest
from worldwright.scan.anomalies.sign import Context, SkipError
from worldwright.scan.known import analytic

ASIDE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Axes of a camera that looks along +y, x to the right and z up."""
MODEL = {"name": "arm", "type": "urdf", "filename": "arm.urdf"}


def lens(distance: float) -> Lens:
    return Lens(np.array([0.0, -distance, 0.7]), ASIDE, 40.0, (640, 360))


def side_by_side(names, apart: float, distance: float):
    """Bodies of 10 cm that fall beside each other, `apart` m from one to the next, seen from `distance` m."""
    one = analytic.falling(height=1.0, seconds=0.4)
    aside = np.array([[apart * k, 0.0, 0.0] for k in range(len(names))])
    rows = {name: np.repeat(getattr(one, name), len(names), axis=1) for name in ("quat", "linvel", "angvel")}
    boxes = {"center": np.zeros((len(names), 3)), "half_extents": np.full((len(names), 3), 0.05)}
    return replace(
        one, names=tuple(names), pos=one.pos + aside, cameras={"side": lens(distance)}, contacts=None, contact_force_sum=None,
        mechanics=replace(type(one.mechanics)(), **boxes), **rows,
    )  # fmt: skip


def plan(movers, *, count=1, cameras=("side",), assets=()):
    things = [] if assets else [{"name": "pea", "primitive": "sphere", "size": [0.1, 0.1, 0.1], "count": count}]
    rows = [{"name": name} for name in cameras]
    return Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.001, "simulation_duration": 0.4},
            "objectives": [{"claim": "They fall."}],
            "scene_objects": things,
            "assets": list(assets),
            "implementation_steps": [{"description": "all", "cameras": rows, "motion_expectations": list(movers)}],
            "recording_mode": {"size": [640, 360]},
        }
    )


def signs(trajectory, told):
    return list(too_small_to_watch.check(trajectory, Context.of(told)))


def test_copies_are_told_once_and_by_the_smallest():
    fell = side_by_side(("pea_1", "pea_2", "pea_3"), 0.2, 12.0)
    fell = replace(fell, pos=fell.pos + np.array([[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.0]]))
    (sign,) = signs(fell, plan(["pea"], count=3))
    assert sign.body == "pea_2" and "(and 2 more of `pea` are too small)" in sign.message
    (alone,) = signs(side_by_side(("pea",), 0.2, 12.0), plan(["pea"]))
    assert "more of" not in alone.message


def test_all_that_a_model_brings_along_is_measured():
    """An arm of ten links, 10 cm each, is a metre long, though its root is 10 cm."""
    names = ("arm", *(f"arm_{k}" for k in range(1, 10)))
    long = side_by_side(names, 0.1, 12.0)
    chain = {"parent": np.arange(-1, 9), "jointed": np.array([False] + [True] * 9)}
    long = replace(long, mechanics=replace(long.mechanics, **chain))
    told = plan(["arm"], assets=[MODEL])
    (seen,) = largest(long, told)
    scale = 360 / 2 / np.tan(np.radians(20))
    assert seen.pixels == pytest.approx(1.0 / 11.95 * scale, rel=0.01) and seen.place[0] == pytest.approx(0.45)
    assert not signs(long, told)


def test_what_another_picture_may_show_large_is_not_told():
    fell = side_by_side(("pea",), 0.2, 12.0)
    with pytest.raises(SkipError, match="camera near"):
        signs(fell, plan(["pea"], cameras=("side", "near")))
    both = replace(fell, cameras={"side": lens(12.0), "near": lens(2.0)})
    assert not signs(both, plan(["pea"], cameras=("side", "near")))


def test_a_camera_that_follows_is_not_told_to_stand_still():
    fell = side_by_side(("pea",), 0.2, 12.0)
    assert "move camera side to `position: [" in signs(fell, plan(["pea"]))[0].message
    follows = {"follows": ("pea",), "along": np.array([True, True, True]), "away": np.array([0.0, -12.0, 0.0])}
    (sign,) = signs(replace(fell, cameras={"side": replace(lens(12.0), **follows)}), plan(["pea"]))
    assert "position:" not in sign.message
    assert "add `{name: close_pea, view: close_up, subjects: [pea], follow: true}`" in sign.message
