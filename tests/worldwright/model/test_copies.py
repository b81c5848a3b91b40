"""Objects with a `count`: names, places, joints and ropes of the copies."""

import math

import mujoco
import numpy as np
import pytest
from pydantic import ValidationError

from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.spread import Spread
from worldwright.place.engine import resolve


def plan(objects, rows, topology=None, **parameters) -> Plan:
    return Plan.model_validate(
        {
            "title": "Copies",
            "plan_type": "scene",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "materials": {"wood": {"friction": 0.5, "density": 600, "source": "handbook"}},
                **parameters,
            },
            "objectives": [{"claim": "They stand."}],
            "implementation_steps": [
                {
                    "description": "Build.",
                    "scene_objects": [row["name"] for row in objects],
                    "cameras": [{"name": "all", "view": "perspective", "subjects": [row["name"] for row in objects]}],
                    "motion_expectations": [objects[0]["name"]],
                }
            ],
            "scene_objects": [{"primitive": "box", "material": "wood", **row} for row in objects],
            "topology": {"scene_predicates": rows, **(topology or {})},
        }
    )


def built(made: Plan):
    layout = resolve(made)
    assert not layout.scene.findings, layout.scene.findings
    drafted = draft(made, layout.scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


DOMINO = {"name": "domino", "size": [0.01, 0.03, 0.06], "count": 12}
AT = {"subject": "domino", "predicate": "PLACE-ON-BASE", "params": {"x": 1.0, "y": 2.0}}


def test_what_is_said_of_the_name_is_said_of_each_copy():
    made = plan(
        [DOMINO], [AT | {"spread": {"pattern": "row", "step": [0.04, 0, 0]}}], masses={"domino": 0.02, "domino_3": 0.05}
    )
    names = tuple(f"domino_{k}" for k in range(1, 13))
    assert made.object_names() == names == made.families["domino"] == made.movers()
    assert made.cameras()[0].subjects == names
    assert (
        made.simulation_parameters.masses["domino_2"] == 0.02 and made.simulation_parameters.masses["domino_3"] == 0.05
    )
    model, data = built(made)
    assert model.nbody == 13 and model.body("domino_3").mass[0] == pytest.approx(0.05)
    assert data.body("domino_5").xpos == pytest.approx((1.16, 2.0, 0.03))


@pytest.mark.parametrize(
    ("spread", "place", "facing"),
    [
        ({"pattern": "grid", "step": [0.1, 0.2, 0], "columns": 4}, lambda k: (1 + (k % 4 - 1.5) * 0.1, 2 + (k // 4 - 1) * 0.2), None),
        ({"pattern": "ring", "radius": 0.5, "facing": "out"}, lambda k: (1 + 0.5 * math.cos(math.tau * k / 12), 2 + 0.5 * math.sin(math.tau * k / 12)), lambda k: 30.0 * k),
        ({"pattern": "ring", "radius": 0.5, "arc_deg": 110, "start_deg": 90, "facing": "along"}, lambda k: (1 + 0.5 * math.cos(math.radians(90 + 10 * k)), 2 + 0.5 * math.sin(math.radians(90 + 10 * k))), lambda k: 180.0 + 10 * k),
    ],
)  # fmt: skip
def test_patterns_are_where_geometry_puts_them(spread, place, facing):
    _, data = built(plan([DOMINO], [AT | {"spread": spread}]))
    for k in range(12):
        body = data.body(f"domino_{k + 1}")
        assert body.xpos[:2] == pytest.approx(place(k), abs=1e-6)
        if facing is not None:
            angle = math.radians(facing(k))
            assert body.xmat[[0, 3]] == pytest.approx((math.cos(angle), math.sin(angle)), abs=1e-6)


def test_a_helix_is_a_staircase_and_a_grid_has_layers():
    stair = {"name": "stair", "size": [0.6, 0.2, 0.04], "count": 8, "fixed": True}
    spread = {"pattern": "helix", "radius": 0.6, "step_deg": 30, "rise": 0.15, "facing": "out"}
    _, data = built(plan([stair], [{**AT, "subject": "stair", "spread": spread}]))
    for k in range(8):
        expected = (1 + 0.6 * math.cos(math.radians(30 * k)), 2 + 0.6 * math.sin(math.radians(30 * k)), 0.02 + 0.15 * k)
        assert data.body(f"stair_{k + 1}").xpos == pytest.approx(expected, abs=1e-6)
    brick = {"name": "brick", "size": [0.1, 0.1, 0.1], "count": 8}
    spread = {"pattern": "grid", "columns": 2, "rows": 2, "step": [0.1, 0.1, 0.1]}
    _, data = built(plan([brick], [{**AT, "subject": "brick", "spread": spread}]))
    assert data.body("brick_8").xpos == pytest.approx((1.05, 2.05, 0.15), abs=1e-6)


def test_copies_are_scattered_on_a_table_without_touching():
    table = {"name": "table", "size": [1, 1, 0.5], "fixed": True}
    rows = [
        {"subject": "table", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}},
        {"subject": "domino", "predicate": "PLACE-ANYWHERE", "object": "table", "params": {"spacing": 0.02}},
        {"subject": "domino", "predicate": "FACING-LEFT"},
    ]
    _, data = built(plan([table, DOMINO], rows))
    places = np.array([data.body(f"domino_{k}").xpos for k in range(1, 13)])
    apart = np.linalg.norm(places[:, None] - places, axis=2) + 9 * np.eye(12)
    assert apart.min() > 0.03 and np.abs(places[:, :2]).max() < 0.5 and places[:, 2] == pytest.approx(0.53)


def test_a_row_of_pendulums_hangs_on_a_row_of_ropes_and_a_chain_on_itself():
    bob = {"name": "bob", "primitive": "sphere", "size": [0.1, 0.1, 0.1], "count": 3}
    rows = [
        {
            "subject": "bob",
            "predicate": "PLACE-ON-BASE",
            "params": {"x": 0, "y": 0, "gap": 0.5},
            "spread": {"pattern": "row", "step": [0.1, 0, 0]},
        }
    ]
    ropes = {
        "tendons": [
            {"name": "rope", "ends": [{"offset": [0, 0, 1.5], "step": [0.1, 0, 0]}, {"body": "bob", "at": "top"}]}
        ]
    }
    model, data = built(plan([bob], rows, ropes))
    assert [model.tendon(k).name for k in range(3)] == ["rope_1", "rope_2", "rope_3"]
    assert data.ten_length == pytest.approx([0.9] * 3)
    link = {"name": "link", "size": [0.02, 0.02, 0.1], "count": 4}
    rows = [
        {
            "subject": "link",
            "predicate": "PLACE-ON-BASE",
            "params": {"x": 0, "y": 0, "gap": 0.6},
            "spread": {"pattern": "row", "step": [0.1, 0, 0]},
        }
    ]
    hinges = {
        "joints": [
            {
                "name": "pin",
                "type": "hinge",
                "child": "link",
                "parent": "link",
                "axis": [0, 1, 0],
                "anchor": [-0.05, 0, 0.65],
                "step": [0.1, 0, 0],
            }
        ]
    }
    model, _ = built(plan([link], rows, hinges, initial_motion={"pin": {"joint_velocity": 0.5}}))
    assert [model.body(model.body(f"link_{k}").parentid[0]).name for k in range(1, 5)] == [
        "world",
        "link_1",
        "link_2",
        "link_3",
    ]
    assert model.joint("pin_3").pos == pytest.approx((-0.05, 0, 0))


def test_what_cannot_be_spread_or_paired_is_refused_with_the_reason():
    lone = plan([{**DOMINO, "count": 1}], [AT | {"spread": {"pattern": "row", "step": [1, 0, 0]}}])
    assert "has no `count`" in resolve(lone).scene.findings[0].message
    facing = plan(
        [DOMINO],
        [AT, {"subject": "domino", "predicate": "FACING-LEFT", "spread": {"pattern": "row", "step": [1, 0, 0]}}],
    )
    assert any("no place that `spread`" in f.message for f in resolve(facing).scene.findings)
    other = {"name": "post", "size": [1, 1, 1], "count": 3}
    with pytest.raises(ValidationError, match="give both the same `count`"):
        plan([DOMINO, other], [], {"joints": [{"name": "j", "type": "hinge", "child": "domino", "parent": "post"}]})
    for wrong, said in (
        ({"pattern": "ring"}, "a ring needs radius"),
        ({"pattern": "row", "step": [1, 0, 0], "radius": 1}, "a row has no radius"),
        ({"pattern": "grid", "step": [0, 0, 0], "columns": 2}, "in one place"),
        ({"pattern": "row", "step": [1, 0, 0], "facing": "out"}, "no middle to face"),
    ):
        with pytest.raises(ValidationError, match=said):
            Spread.model_validate(wrong)


def test_copies_of_an_asset_are_named_as_those_of_an_object():
    made = plan([{"name": "stand", "size": [0.6, 0.6, 0.1]}], [])
    said = made.model_dump(mode="json", exclude_none=True, exclude_defaults=True)
    said["assets"] = [{"name": "apple", "filename": "apple", "count": 4}]
    said["asset_dimensions"] = {"apple": 0.079}
    said["simulation_parameters"]["masses"] = {"apple": 0.2}
    step = said["implementation_steps"][0]
    step |= {"assets": ["apple"], "motion_expectations": ["apple"]}
    step["cameras"][0]["subjects"] = ["stand", "apple"]
    said["topology"] = {
        "scene_predicates": [
            {"subject": "stand", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}},
            {"subject": "apple", "predicate": "PLACE-ON", "object": "stand", "params": {"offset": [0, 0], "gap": 0.02},
             "spread": {"pattern": "ring", "radius": 0.1}},
        ]
    }  # fmt: skip
    read = Plan.model_validate(said)
    four = tuple(f"apple_{k}" for k in range(1, 5))
    assert read.implementation_steps[0].motion_expectations == four
    assert read.implementation_steps[0].cameras[0].subjects == ("stand", *four)
    model, data = built(read)
    for k, name in enumerate(four):
        around = 0.1 * np.array([math.cos(math.radians(90 * k)), math.sin(math.radians(90 * k))])
        assert np.allclose(data.body(name).xpos[:2], around, atol=1e-3)
        assert model.body(name).mass[0] == pytest.approx(0.2)
