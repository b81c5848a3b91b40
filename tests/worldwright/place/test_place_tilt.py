"""Tilted primitives: their boxes are those of their shapes, and what stands on an edge tips."""

import numpy as np
import pytest

from worldwright.model.plan.committed import Plan
from worldwright.model.plan.scene_objects import SceneObject
from worldwright.place import settling
from worldwright.place.checks import check
from worldwright.place.drawing.silhouettes import primitive_clouds
from worldwright.place.engine import resolve
from worldwright.place.footprints import inset


def plan(objects, rows) -> Plan:
    return Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0},
            "objectives": [{"claim": "it lies"}],
            "scene_objects": objects,
            "topology": {
                "scene_predicates": [{"subject": s, "predicate": p, "object": o, "params": q} for s, p, o, q in rows]
            },
        }
    )


@pytest.mark.parametrize("deg_x", [0, 30, 90, -135, 180])
@pytest.mark.parametrize(
    ("primitive", "size"),
    [
        ("box", (0.3, 0.2, 1.0)),
        ("cylinder", (0.2, 0.2, 1.0)),
        ("capsule", (0.2, 0.2, 1.0)),
        ("ellipsoid", (0.3, 0.2, 0.6)),
    ],
)
def test_the_box_around_a_tilted_shape(primitive, size, deg_x):
    row = SceneObject(name="a", primitive=primitive, size=size, deg_x=deg_x)
    points = np.concatenate(primitive_clouds(row))
    assert np.ptp(points, axis=0) == pytest.approx(row.extents, rel=0.01)


def test_worked_numbers():
    log = SceneObject(name="log", primitive="cylinder", size=(0.2, 0.2, 1.0), deg_x=90)
    assert log.extents == pytest.approx((0.2, 1.0, 0.2), abs=1e-12)
    ramp = SceneObject(name="ramp", primitive="box", size=(1, 2, 0.1), deg_x=30)
    assert ramp.extents == pytest.approx((1, 2 * 0.8660254 + 0.05, 1.0 + 0.1 * 0.8660254))
    with pytest.raises(ValueError, match="cannot be tilted"):
        SceneObject(name="t", primitive="box_container", size=(1, 1, 1), wall_thickness=0.1, deg_x=10)


LOG = {"name": "log", "primitive": "cylinder", "size": [0.2, 0.2, 1.0], "deg_x": 90}
BENCH = {"name": "bench", "primitive": "box", "size": [1, 1.2, 0.45], "fixed": True}
LAID = [("bench", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), ("log", "PLACE-ON", "bench", {"offset": [0, 0]})]


def test_a_log_lies_on_a_bench_and_stays():
    made = plan([BENCH, LOG], LAID)
    resolution = resolve(made)
    assert resolution.scene["log"].position == (0, 0, 0.55)
    assert resolution.scene["log"].size == pytest.approx((0.2, 1.0, 0.2))
    assert not check(made, resolution, locate=lambda *path: None).findings
    report = settling.settle(made, resolution.scene, file="plan.md", locate=lambda *path: None, duration_s=0.5)
    assert report.ok, report.text()


def test_a_box_on_its_edge_is_told_to_tip():
    crate = {"name": "parcel", "primitive": "box", "size": [0.4, 0.4, 0.5], "deg_x": 20}
    made = plan([BENCH, crate], [LAID[0], ("parcel", "PLACE-ON", "bench", {"offset": [0, 0]})])
    resolution = resolve(made)
    assert "WP307" in {f.code for f in check(made, resolution, locate=lambda *path: None).findings}
    report = settling.settle(made, resolution.scene, file="plan.md", locate=lambda *path: None, duration_s=1.0)
    assert not report.ok


def test_nothing_is_placed_on_a_slope():
    ramp = {"name": "ramp", "primitive": "box", "size": [1, 2, 0.1], "deg_x": 15, "fixed": True}
    ball = {"name": "ball", "primitive": "sphere", "size": [0.1, 0.1, 0.1]}
    scene = resolve(
        plan(
            [ramp, ball],
            [("ramp", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), ("ball", "PLACE-ON", "ramp", {"offset": [0, 0]})],
        )
    ).scene
    assert any("no level surface" in f.message for f in scene.findings)


def test_a_line_supports_what_is_above_it():
    assert inset([(0, -1), (0, 1)], (0, 0.5)) == 0
    assert inset([(0, -1), (0, 1)], (0.2, 0.5)) == pytest.approx(-0.2)
    assert inset([(0, -1), (0, 1)], (0, 1.5)) == pytest.approx(-0.5)
