"""Compounds: placed by the box around their parts, standing on their lowest parts, heavy where their parts are."""

import numpy as np
import pytest

from worldwright.lint.tools import check_plan
from worldwright.model.errors import PlanError
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.plan.scene_objects import SceneObject
from worldwright.model.plan.weights import weight
from worldwright.place import settling
from worldwright.place.checks import check
from worldwright.place.drawing.silhouettes import primitive_clouds, silhouette
from worldwright.place.engine import resolve

CHAIR = {
    "name": "chair",
    "primitive": "compound",
    "parts": [
        {"name": "leg", "primitive": "cylinder", "size": [0.04, 0.04, 0.43], "offset": [0.18, 0.18, 0.215], "repeat": {"count": 4, "deg_z": 90}},
        {"name": "seat", "primitive": "box", "size": [0.42, 0.42, 0.04], "offset": [0, 0, 0.45]},
        {"name": "back", "primitive": "box", "size": [0.03, 0.42, 0.45], "offset": [-0.195, 0, 0.695]},
    ],
}  # fmt: skip
CUP = {"name": "cup", "primitive": "cylinder", "size": [0.08, 0.08, 0.1]}


def plan(objects, rows, **parameters) -> Plan:
    return Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0, **parameters},
            "objectives": [{"claim": "it stands"}],
            "scene_objects": objects,
            "topology": {
                "scene_predicates": [{"subject": s, "predicate": p, "object": o, "params": q} for s, p, o, q in rows]
            },
        }
    )


def found(made):
    return [f.code for f in check(made, resolve(made), file="plan.md", locate=lambda *path: None).findings]


def settle(made, seconds):
    return settling.settle(made, resolve(made).scene, file="plan.md", locate=lambda *path: None, duration_s=seconds)


def test_a_cup_stands_on_the_seat_and_both_stay():
    rows = [
        ("chair", "PLACE-ON-BASE", None, {"x": 1, "y": 2}),
        ("cup", "PLACE-ON", "chair", {"surface": "seat", "offset": [0.05, 0]}),
    ]
    made = plan([CHAIR, CUP], rows, masses={"chair": 5.0, "cup": 0.3})
    scene = resolve(made).scene
    assert scene["chair"].size == pytest.approx((0.42, 0.42, 0.92))
    assert scene["chair"].position == pytest.approx((1, 2, 0.46))
    assert scene["cup"].position == pytest.approx((1.05, 2, 0.52))
    assert found(made) == []
    report = settle(made, 1.0)
    assert max(np.hypot(m.drop_m, m.slide_m) for m in report.objects) < 2e-3
    assert [len(side) for side in (silhouette(made, scene["chair"]).top, silhouette(made, scene["chair"]).side)] == [
        6,
        6,
    ]


def test_a_surface_that_is_not_there_is_told_with_the_ones_that_are():
    rows = [
        ("chair", "PLACE-ON-BASE", None, {"x": 0, "y": 0}),
        ("cup", "PLACE-ON", "chair", {"surface": "cushion", "offset": [0, 0]}),
    ]
    (problem,) = [f for f in resolve(plan([CHAIR, CUP], rows)).scene.findings if "cushion" in f.message]
    assert "level are: top, leg_1, leg_2, leg_3, leg_4, seat, back" in problem.message


def test_a_trolley_takes_things_inside():
    trolley = {
        "name": "trolley",
        "primitive": "compound",
        "parts": [
            {"name": "tub", "primitive": "box_container", "size": [0.5, 0.4, 0.3], "wall_thickness": 0.02, "offset": [0, 0, 0.35]},
            {"name": "foot", "primitive": "sphere", "size": [0.2, 0.2, 0.2], "offset": [0.15, 0.1, 0.1], "repeat": {"count": 4, "deg_z": 90}},
        ],
    }  # fmt: skip
    rows = [
        ("trolley", "PLACE-ON-BASE", None, {"x": 0, "y": 0}),
        ("cup", "PLACE-IN", "trolley", {"offset": [0, 0]}),
    ]
    scene = resolve(plan([trolley, CUP], rows)).scene
    assert scene.ok, scene.findings
    assert scene["cup"].position == pytest.approx((0, 0, 0.2 + 0.02 + 0.05))


def suitcase(**books) -> dict:
    shell = {"name": "shell", "primitive": "box", "size": [0.4, 0.2, 0.5], "offset": [0, 0, 0.25], "mass": 2.0}
    inside = {"name": "books", "primitive": "box", "size": [0.1, 0.18, 0.1], "mass": 8.0, **books}
    feet = {"name": "foot", "primitive": "box", "size": [0.03, 0.1, 0.03], "offset": [-0.1, 0, -0.015], "mass": 0.01}
    return {
        "name": "suitcase",
        "primitive": "compound",
        "parts": [shell, inside, {**feet, "repeat": {"count": 2, "step": [0.2, 0, 0]}}],
    }


def test_an_unevenly_packed_suitcase_is_told_to_tip_and_tips():
    rows = [("suitcase", "PLACE-ON-BASE", None, {"x": 0, "y": 0})]
    even, uneven = (plan([suitcase(offset=[x, 0, 0.3])], rows) for x in (0.0, 0.15))
    assert found(even) == [] and found(uneven) == ["WP307"]
    assert weight(uneven, uneven.scene_objects[0]).centre[0] == pytest.approx(8 * 0.15 / 10.02)
    assert resolve(uneven).scene["suitcase"].weight.startswith("10.02 kg in 4 parts, centre of mass (0.1198, 0, ")
    moves = [settle(p, 1.5).objects[0] for p in (even, uneven)]
    assert moves[0].tilt_deg < 0.5 and moves[1].tilt_deg > 4


def test_a_tilted_compound_is_placed_by_the_box_around_it():
    row = SceneObject.model_validate({**CHAIR, "deg_x": 37})
    points = np.concatenate(primitive_clouds(row))
    assert np.ptp(points, axis=0) == pytest.approx(row.extents, rel=1e-3)
    assert (points.max(axis=0) + points.min(axis=0)) / 2 == pytest.approx((0, 0, 0), abs=1e-3)


PLAN = """# A chair

## plan_type

scene

## simulation_parameters

```yaml
time_step: 0.002
simulation_duration: 1.0
masses: {{chair: 5.0}}
```

## objectives

- It stands.

## implementation_steps

## scene_objects

```yaml
- name: chair
  primitive: compound
  {size}
  parts:
    - {{name: seat, primitive: box, size: [0.4, 0.4, 0.04], offset: [0, 0, 0.42]}}
    - {part}
```

## assets

## asset_dimensions

## layout_density

## topology

```yaml
scene_predicates:
  - {{subject: chair, predicate: PLACE-ON-BASE, params: {{x: 0, y: 0}}}}
```

## visualization

## recording_mode

## clarifications_needed

## geometry_relations
"""
POST = "{name: post, primitive: cylinder, size: [0.1, 0.1, 0.4], offset: [0, 0, 0.2]}"


@pytest.mark.parametrize(
    ("size", "part", "told"),
    [
        ("size: [0.4, 0.4, 0.5]", POST, "the box around its parts measures [0.4, 0.4, 0.44] m, not [0.4, 0.4, 0.5]: leave"),
        ("", POST.replace("[0.1, 0.1, 0.4]", "[0.1, 0.2, 0.4]"), "part post: a cylinder is round: write [d, d, height]"),
        ("", POST.replace("post,", "seat,"), "two parts are called chair/seat"),
        ("", POST.replace("}", ", position: [0, 0, 1]}"), "its place in the object is its `offset` [x, y, z]"),
        ("", POST.replace("}", ", material: felt}"), "`scene_objects[0].parts[1].material` names the material `felt`"),
        ("", POST.replace("post,", "my post,"), "`my post` cannot be used as a name"),
        ("", POST.replace("}", ", repeat: {count: 3}}"), "copies need a `step` (m) or a turn `deg_z`"),
        ("", POST.replace("}", ", primitve: box}"), "did you mean `primitive`?"),
        ("", POST.replace("}", ", wall_thickness: 0.1}"), "`wall_thickness` is needed by a box_container, and only by it"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_part_is_told_at_its_line(size, part, told, tmp_path):
    path = tmp_path / "plan.md"
    path.write_text(PLAN.format(size=size, part=part))
    with pytest.raises(PlanError) as refusal:
        read_plan(path)
    (finding,) = refusal.value.findings
    assert told in f"{finding.message} {finding.fix}"
    lines = path.read_text().splitlines()
    whole_row = "box around" in told or "two parts" in told
    assert lines[finding.line - 1].strip().startswith("- name: chair" if whole_row else "- {name: ")


def test_a_size_may_be_left_out_or_agree(tmp_path):
    for size in ("", "size: [0.4, 0.4, 0.44]"):
        path = tmp_path / "plan.md"
        path.write_text(PLAN.format(size=size, part=POST))
        assert read_plan(path).plan.scene_objects[0].size == pytest.approx((0.4, 0.4, 0.44))


def test_masses_that_contradict_each_other_are_told(tmp_path):
    path = tmp_path / "plan.md"
    path.write_text(PLAN.format(size="", part=POST.replace("}", ", mass: 6}")))
    told = [f for f in check_plan(path).findings if f.code == "WP112"]
    assert "some parts weigh 6 kg, which leaves nothing of 5 kg for the others" in told[0].message
