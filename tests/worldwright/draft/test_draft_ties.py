"""Stops, pairs, pretension and two freedoms of one child: drafted, compiled and stepped."""

import math

import mujoco
import pytest
from pydantic import ValidationError

from worldwright.draft import draft
from worldwright.model.plan.committed import Joint, Plan
from worldwright.model.plan.drives import Tendon
from worldwright.place.engine import resolve

STEP = 0.0005


def built(objects, rows, topology=None, **parameters):
    made = Plan.model_validate(
        {
            "title": "Ties",
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": STEP,
                "simulation_duration": 1.0,
                "materials": {"wood": {"friction": 0.8, "density": 600, "source": "handbook"}},
                **parameters,
            },
            "objectives": [{"claim": "They hold."}],
            "scene_objects": [{"primitive": "box", "material": "wood", **row} for row in objects],
            "topology": {
                "scene_predicates": [
                    {"subject": row["name"], "predicate": "PLACE-ON-BASE", "params": params}
                    for row, params in zip(objects, rows, strict=True)
                ],
                **(topology or {}),
            },
        }
    )
    layout = resolve(made)
    assert not layout.scene.findings, layout.scene.findings
    drafted = draft(made, layout.scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return model, data


BOX = {"name": "box", "size": [0.1, 0.1, 0.1]}


@pytest.mark.parametrize("restitution", [0.3, 0.6, 0.9])
def test_a_stop_rebounds_as_it_is_asked_to(restitution):
    """A slide of 0.5 m: it falls to its lower end at sqrt(2 g h) and comes back at e times that."""
    slide = {
        "name": "guide", "type": "slide", "child": "box", "axis": [0, 0, 1], "range": [-0.5, 0.1],
        "stop": {"time_constant": 8 * STEP, "restitution": restitution},
    }  # fmt: skip
    model, data = built([BOX], [{"x": 0, "y": 0, "gap": 1.0}], {"joints": [slide]})
    speeds = []
    for _ in range(round(0.5 / STEP)):
        mujoco.mj_step(model, data)
        speeds.append(float(data.qvel[0]))
    arrived = min(speeds)
    assert arrived == pytest.approx(-math.sqrt(2 * 9.81 * 0.5), rel=0.01)
    assert max(speeds) / -arrived == pytest.approx(restitution, abs=0.05)


def test_a_pair_slides_by_its_own_friction_and_the_others_by_their_materials():
    """On level ground a body comes to rest after v^2 / (2 mu g): 0.64 m by the pair's 0.08, 0.064 m by the material's 0.8."""
    objects = [BOX, {**BOX, "name": "other"}]
    start = {name: {"linear": [1.0, 0, 0]} for name in ("box", "other")}
    pairs = [{"between": ["box", "ground"], "friction": 0.08, "source": "waxed wood on snow"}]
    ground = {"ground": {"friction": 0.1, "source": "handbook"}, "wood": {"friction": 0.8, "density": 600}}
    rows = [{"x": 0, "y": 0}, {"x": 0, "y": 1}]
    model, data = built(objects, rows, pairs=pairs, initial_motion=start, materials=ground)
    assert model.npair == 1
    mujoco.mj_step(model, data, round(2.5 / STEP))
    assert data.body("box").xpos[0] == pytest.approx(1 / (2 * 0.08 * 9.81), rel=0.05)
    assert data.body("other").xpos[0] == pytest.approx(1 / (2 * 0.8 * 9.81), rel=0.15)


def test_a_spring_pulls_with_its_pretension_at_the_start():
    spring = {
        "name": "s",
        "ends": [{"offset": [0, 0, 2]}, {"body": "box", "at": "top"}],
        "stiffness": 100,
        "pretension": 30,
    }
    model, data = built([BOX], [{"x": 0, "y": 0, "gap": 1.0}], {"tendons": [spring]})
    assert 100 * (data.ten_length[0] - model.tendon_lengthspring[0, 0]) == pytest.approx(30)
    weight = model.body("box").mass[0] * 9.81
    assert data.qacc[2] == pytest.approx((30 - weight) / model.body("box").mass[0], rel=1e-6)
    with pytest.raises(ValidationError, match="`pretension` is a spring's"):
        Tendon.model_validate({**spring, "stiffness": 0})


def test_two_joints_of_one_child_are_two_freedoms_and_close_no_loop():
    """A carriage that slides along x and turns on itself about z: neither hinders the other."""
    joints = [
        {"name": "rail", "type": "slide", "child": "box", "axis": [1, 0, 0]},
        {"name": "pivot", "type": "hinge", "child": "box", "axis": [0, 0, 1], "beside": True},
    ]
    start = {"rail": {"joint_velocity": 0.5}, "pivot": {"joint_velocity": 2.0}}
    model, data = built([BOX], [{"x": 0, "y": 0, "gap": 0.5}], {"joints": joints}, initial_motion=start)
    assert (model.nv, model.neq, model.nbody) == (2, 0, 2)
    mujoco.mj_step(model, data, round(0.5 / STEP))
    assert data.qpos == pytest.approx((0.25, 1.0), rel=1e-3)


def test_a_stop_without_a_range_is_refused():
    with pytest.raises(ValidationError, match="give the `range`"):
        Joint.model_validate({"name": "j", "type": "hinge", "child": "box", "stop": {"restitution": 0.5}})


def test_constants_keep_all_their_digits():
    made = Plan.model_validate(
        {
            "title": "Digits",
            "plan_type": "scene",
            "simulation_parameters": {
                "time_step": 1e-10,
                "simulation_duration": 1e-7,
                "masses": {"box": 9.1093837015e-31},
                "constants": {"big_g": {"value": 6.6743015e-11, "unit": "m^3/(kg s^2)", "source": "CODATA 2018"}},
            },
            "objectives": [{"claim": "It is light."}],
            "scene_objects": [{"primitive": "box", **BOX}],
            "topology": {
                "scene_predicates": [{"subject": "box", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}}]
            },
        }
    )
    source = draft(made, resolve(made).scene).source
    for number in ("BIG_G = 6.6743015e-11", "mass=9.1093837015e-31", "TIME_STEP = 1e-10", "DURATION = 1e-07"):
        assert number in source


def test_a_wind_of_the_plan_blows_and_drags_at_its_speed():
    """A floating box far from anything takes on the speed of the wind, with drag as its only force."""
    medium = {"density": 1000, "viscosity": 0.001, "wind": [2.0, 0, 0], "source": "water, handbook"}
    model, data = built([BOX], [{"x": 0, "y": 0, "gap": 5.0}], gravity=0.0, medium=medium)
    assert (model.opt.density, model.opt.viscosity) == (1000, 0.001) and tuple(model.opt.wind) == (2, 0, 0)
    mujoco.mj_step(model, data, round(2 / STEP))
    assert 1.5 < data.qvel[0] < 2.0


@pytest.mark.parametrize(("adhesion", "holds"), [(2.5, True), (2.3, False)])
def test_an_adhesive_face_holds_with_its_force_at_each_of_four_points(adhesion, holds):
    """A box of 1 kg hangs under a ceiling: 4 x 2.5 N carry 9.81 N, 4 x 2.3 N do not."""
    objects = [
        {"name": "ceiling", "size": [1, 1, 0.1], "fixed": True},
        {**BOX, "material": "magnet"},
    ]
    materials = {"wood": {"friction": 0.5, "density": 600}, "magnet": {"friction": 0.5, "adhesion": adhesion}}
    rows = [{"x": 0, "y": 0, "gap": 1.0}, {"x": 0, "y": 0, "gap": 0.9}]
    model, data = built(objects, rows, materials=materials, masses={"box": 1.0})
    mujoco.mj_step(model, data, round(0.5 / STEP))
    assert (data.body("box").xpos[2] > 0.94) == holds


ROD = {"name": "strut", "ends": [{"offset": [0, 0, 1.0]}, {"body": "box", "at": "top"}], "rod": True}


def test_a_rod_holds_up_what_stands_on_it():
    """A box that stands on a rod below it, in the balance: the rod pushes with its weight, and keeps its length."""
    on = {"name": "strut", "ends": [{"offset": [0, 0, 0.3]}, {"body": "box", "at": "bottom"}], "rod": True}
    guide = {"name": "guide", "type": "slide", "child": "box", "axis": [0, 0, 1]}
    model, data = built([BOX], [{"x": 0, "y": 0, "gap": 0.5}], {"tendons": [on], "joints": [guide]})
    for _ in range(round(0.3 / STEP)):
        mujoco.mj_step(model, data)
    assert data.tendon("strut").length[0] == pytest.approx(0.2, abs=2e-4)
    assert abs(data.qvel[0]) < 1e-3 and data.efc_force[data.efc_type == 4].sum() == pytest.approx(0.6 * 9.81, rel=0.02)


def test_a_hanging_rod_keeps_its_length_while_a_rope_would_go_slack():
    up = {"box": {"linear": [0, 0, 2.0]}}
    lengths = {}
    for kind, row in (("rod", ROD), ("rope", {**ROD, "rod": False})):
        model, data = built([BOX], [{"x": 0, "y": 0, "gap": 0.4}], {"tendons": [row]}, initial_motion=up)
        found = []
        for _ in range(round(0.2 / STEP)):
            mujoco.mj_step(model, data)
            found.append(float(data.tendon("strut").length[0]))
        lengths[kind] = min(found)
    assert lengths["rod"] == pytest.approx(0.5, abs=2e-3) and lengths["rope"] < 0.4


@pytest.mark.parametrize("more", [{"length": 1.0}, {"slack": 0.1}, {"stiffness": 10.0}, {"damping": 1.0}])
def test_a_rod_is_as_long_as_it_is_laid_out(more):
    with pytest.raises(ValidationError, match="rod"):
        Tendon.model_validate({**ROD, **more})
