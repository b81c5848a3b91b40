"""What is told of the moment the simulation starts: ropes, springs, and joints that start turned."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.model.plan.committed import Plan
from worldwright.place.checks import check
from worldwright.place.engine import resolve
from worldwright.place.settling import settle
from worldwright.place.start import hung, motions, told

POST = {"name": "post", "primitive": "box", "size": [0.1, 0.1, 1.2], "fixed": True}
ROD = {"name": "rod", "primitive": "box", "size": [0.02, 0.02, 0.8]}
BOB = {"name": "bob", "primitive": "sphere", "size": [0.1, 0.1, 0.1]}
PIVOT = {"name": "pivot", "type": "hinge", "child": "rod", "anchor": [0, 0, 1.1], "axis": [0, 1, 0]}
GLUE = {"name": "glue", "type": "weld", "parent": "rod", "child": "bob"}


def made(joints=(PIVOT, GLUE), initial=None, post_x=1.0, **topology) -> Plan:
    """A pendulum beside a post: rod from z = 0.3 to 1.1, bob centred at 0.25."""
    return Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "initial_motion": initial or {},
            },
            "objectives": [{"claim": "it swings"}],
            "scene_objects": [POST, ROD, BOB],
            "topology": {
                "body_positions": {
                    "post": {"x": post_x, "y": 0, "z": 0.6},
                    "rod": {"x": 0, "y": 0, "z": 0.7},
                    "bob": {"x": 0, "y": 0, "z": 0.25},
                },
                "joints": list(joints),
                **topology,
            },
            "implementation_steps": [{"description": "let go", "motion_expectations": ["rod", "bob"]}],
        }
    )


def laid(plan):
    resolution = resolve(plan)
    assert resolution.scene.ok, resolution.scene.findings
    return resolution


def checked(plan):
    return check(plan, laid(plan), locate=lambda *path: None)


def start(deg, **more):
    return {"pivot": {"joint_position": deg, **more}}


@given(st.floats(-170, 170).filter(lambda deg: abs(deg) > 0.01))
def test_what_hangs_on_a_turned_joint_turns_with_it_as_the_engine_turns_it(deg):
    import mujoco

    plan = made(initial=start(deg))
    moved = motions(plan, laid(plan).scene)
    assert set(moved) == {"rod", "bob"}
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body pos="0 0 0.7"><joint type="hinge" axis="0 1 0" pos="0 0 0.4"/><geom size="0.1"/>
        <body pos="0 0 -0.45"><geom size="0.05"/></body></body></worldbody></mujoco>"""
    )
    data = mujoco.MjData(model)
    data.qpos[0] = math.radians(deg)
    mujoco.mj_kinematics(model, data)
    assert moved["rod"]((0.0, 0.0, 0.7)) == pytest.approx(data.xpos[1], abs=1e-9)
    assert moved["bob"]((0.0, 0.0, 0.25)) == pytest.approx(data.xpos[2], abs=1e-9)
    assert np.allclose(moved["bob"].rotation, data.xmat[2].reshape(3, 3))


def test_a_chain_of_joints_turns_link_after_link():
    elbow = {
        "name": "elbow",
        "type": "hinge",
        "parent": "rod",
        "child": "bob",
        "anchor": [0, 0, 0.3],
        "axis": [0, 1, 0],
    }
    plan = made((PIVOT, elbow), {**start(90), "elbow": {"joint_position": -90}})
    moved = motions(plan, laid(plan).scene)
    # About +y by 90 deg what hangs down points to -x; the elbow turns the bob back, so that it hangs from the rod's end.
    assert moved["rod"]((0.0, 0.0, 0.3)) == pytest.approx((-0.8, 0, 1.1))
    assert moved["bob"]((0.0, 0.0, 0.25)) == pytest.approx((-0.8, 0, 1.05))


def test_a_slide_starts_along_its_axis():
    slide = {"name": "pivot", "type": "slide", "child": "rod", "axis": [0, 0, 2]}
    plan = made((slide, GLUE), start(0.3))
    assert motions(plan, laid(plan).scene)["bob"]((0.0, 0.0, 0.25)) == pytest.approx((0, 0, 0.55))


def test_what_starts_inside_something_is_named_and_what_only_hangs_beside_it_is_not():
    apart = checked(made(initial=start(20)))
    assert not [f for f in apart.findings if f.code == "WP325"]
    assert apart.at_start == ("joint `pivot` starts at 20 deg from its layout (with it rod, bob)",)
    # At -20 deg the bob is 0.85 sin 20 = 0.29 m in front of the pivot: inside a post at 0.3 m.
    inside = [f for f in checked(made(initial=start(-20), post_x=0.3)).findings if f.code == "WP325"]
    assert any("`bob` and `post`" in f.message for f in inside)
    assert {f.severity for f in inside} == {"error"}
    # Straight up and on below: a rod of 0.8 m on a hinge 0.3 m high reaches under the ground.
    low = {**PIVOT, "anchor": [0, 0, 0.3]}
    found = [f.message for f in checked(made((low, GLUE), start(180))).findings if f.code == "WP325"]
    assert any("`rod`" in m and "ground" in m for m in found), found


def test_parts_that_a_joint_holds_together_may_overlap():
    elbow = {
        "name": "elbow",
        "type": "hinge",
        "parent": "rod",
        "child": "bob",
        "anchor": [0, 0, 0.3],
        "axis": [0, 1, 0],
    }
    plan = made((PIVOT, elbow), {"elbow": {"joint_position": 150}})
    assert not [f for f in checked(plan).findings if f.code == "WP325"]


def rope(**more):
    ends = [{"body": "post", "at": "top"}, {"body": "bob", "at": "center"}]
    return {"name": "leash", "ends": ends, **more}


def test_a_rope_is_told_against_the_distance_of_its_ends():
    away = math.dist((1.0, 0, 1.2), (0, 0, 0.25))
    for given_, slack in (({"slack": 0.1}, 0.1), ({"length": 2.0}, 2.0 - away), ({}, 0.0)):
        plan = made(tendons=[rope(**given_)])
        (one,) = hung(plan, laid(plan).scene)
        assert one.slack_m == pytest.approx(slack)
        assert not [f for f in checked(plan).findings if f.code == "WP324"]
    assert list(told(plan, laid(plan).scene)) == [
        f"rope `leash`: {away:.4f} m from end to end at the start, {away:.4f} m long: taut"
    ]
    short = checked(made(tendons=[rope(length=1.0)]))
    (finding,) = [f for f in short.findings if f.code == "WP324"]
    assert f"{away:.4f} m apart" in finding.message
    assert not short.ok
    assert any("too short by 0.3793 m" in line for line in short.at_start)


def test_a_start_angle_that_stretches_a_rope_is_refused_and_one_that_slackens_it_is_not():
    stretched = checked(made(initial=start(30), tendons=[rope()]))
    (finding,) = [f for f in stretched.findings if f.code == "WP324"]
    assert "start angle" in finding.message
    slack = checked(made(initial=start(-30), tendons=[rope()]))
    assert not [f for f in slack.findings if f.code == "WP324"]
    assert any("slack by" in line for line in slack.at_start)


def test_a_start_angle_at_which_a_rod_does_not_fit_is_refused():
    for deg, fits in ((0, True), (30, False), (-30, False)):
        report = checked(made(initial=start(deg) if deg else None, tendons=[rope(rod=True)]))
        assert ("WP324" in {f.code for f in report.findings}) != fits
        assert not fits or any("rod `" in line and line.endswith(": fits") for line in report.at_start)


def test_a_spring_is_told_with_its_force():
    plan = made(tendons=[rope(length=1.0, stiffness=10.0)])
    away = math.dist((1.0, 0, 1.2), (0, 0, 0.25))
    assert f"pulls with {10 * (away - 1):.3g} N" in next(told(plan, laid(plan).scene))


def test_settle_names_what_it_does_not_let_go_and_why():
    plan = made()
    report = settle(plan, laid(plan).scene, file="plan.md", locate=lambda *path: None, duration_s=0.2)
    assert report.held == {"rod": "on hinge pivot of world", "bob": "on weld glue of rod"}
    assert "rod: not let go, on hinge pivot of world" in report.text()


def test_check_holds_every_row_and_says_how_many_it_does_not_print():
    names = [f"box_{n}" for n in range(45)]
    data = made().model_dump(mode="json")
    data["scene_objects"] += [{"name": n, "primitive": "box", "size": [0.1, 0.1, 0.1]} for n in names]
    data["topology"]["scene_predicates"] = [
        {"subject": n, "predicate": "PLACE-ON-BASE", "params": {"x": 2 + 0.2 * i, "y": 0}} for i, n in enumerate(names)
    ]
    big = Plan.model_validate(data)
    report = check(big, laid(big), locate=lambda *path: None, exact=False)
    assert len(report.margins) == len(names) + 3
    assert "… and 36 more rows, none tighter" in report.text()


def test_a_loop_says_which_joints_it_leaves_out_and_whether_its_ends_meet():
    pin = {"name": "pin", "type": "hinge", "child": "bob", "axis": [1, 0, 0], "anchor": [0, 0, 0.25]}
    (line,) = checked(made((PIVOT, GLUE, pin))).at_start
    assert line == "3 joints, of which 1 closes a loop and no pose hangs on: `pin`"
    lines = checked(made((PIVOT, GLUE, pin), start(20))).at_start
    # The bob swings away from the pin in the world: a chord of 0.85 m by 20 degrees.
    apart = 2 * 0.85 * math.sin(math.radians(10))
    assert any(f"whose ends are {apart:.4f} m apart at the start" in line for line in lines), lines
