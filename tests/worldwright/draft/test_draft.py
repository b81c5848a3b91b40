import ast
import dataclasses

import pytest

from worldwright.draft import draft
from worldwright.draft.python_text import Raw, call, constant_name, literal
from worldwright.model.errors import PlanError
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.layout import PlacedCamera, PlacedObject, Scene

PENDULUM = {
    "title": "A pendulum swings",
    "plan_type": "mbs",
    "simulation_parameters": {
        "time_step": 0.002,
        "simulation_duration": 2.0,
        "materials": {"steel": {"density": 7850, "friction": 0.4, "restitution": 0.6, "source": "handbook"}},
        "initial_motion": {"pivot": {"joint_position": 60.0}, "puck": {"linear": [1.0, 0, 0]}},
        "masses": {"bob": 2.0},
    },
    "objectives": [{"claim": 'It swings "freely" \\ for a while'}],
    "implementation_steps": [
        {
            "description": "swing",
            "cameras": ["perspective", {"name": "side", "view": "side_minus_y", "subjects": ["bob"], "fovy": 30}],
            "motion_expectations": ["bob"],
        }
    ],
    "scene_objects": [
        {"name": "bob", "primitive": "sphere", "size": [0.2, 0.2, 0.2], "material": "steel", "look": "brass"},
        {"name": "arm", "primitive": "box", "size": [0.02, 0.02, 1.0], "material": "steel", "role": "rod"},
        {"name": "puck", "primitive": "cylinder", "size": [0.1, 0.1, 0.03], "material": "steel"},
    ],
    "topology": {
        "joints": [
            {"name": "clamp", "type": "weld", "parent": "arm", "child": "bob"},
            {"name": "pivot", "type": "hinge", "child": "arm", "anchor": [0, 0, 2], "axis": [0, 1, 0], "damping": 0.01},
        ]
    },
}
LAYOUT = Scene(
    objects=tuple(
        PlacedObject(name=name, kind="scene_object", size=size, position=position)
        for name, size, position in (
            ("bob", (0.2, 0.2, 0.2), (0, 0, 0.9)),
            ("arm", (0.02, 0.02, 1.0), (0, 0, 1.5)),
            ("puck", (0.1, 0.1, 0.03), (1, 0, 0.015)),
        )
    )
)


def plan(**changes) -> Plan:
    return Plan.model_validate({**PENDULUM, **changes})


def test_a_declarative_plan_is_drafted_whole_and_twice_the_same():
    first, second = draft(plan(), LAYOUT), draft(plan(), LAYOUT)
    assert first == second
    assert first.complete
    ast.parse(first.source)


def test_the_draft_compiles_to_the_plan(tmp_path):
    import mujoco
    import numpy as np

    path = tmp_path / "simulation.py"
    path.write_text(draft(plan(), LAYOUT).source)
    names: dict = {"__name__": "drafted"}
    exec(compile(path.read_text(), str(path), "exec"), names)
    model = names["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    assert model.opt.timestep == 0.002
    assert model.body("bob").mass[0] == pytest.approx(2.0)
    assert model.body("bob").parentid[0] == model.body("arm").id
    assert np.degrees(data.joint("pivot").qpos[0]) == pytest.approx(60.0)
    assert np.allclose(data.body("puck").cvel[3:], [1, 0, 0])
    # swung by 60 degrees about +y, the bob hangs towards -x at 1.1 m below the pivot
    assert np.allclose(data.body("bob").xpos, [-1.1 * np.sin(np.pi / 3), 0, 2 - 1.1 * np.cos(np.pi / 3)], atol=1e-6)
    assert {model.camera(i).name for i in range(model.ncam)} == {"perspective", "side"}


def test_light_sky_and_lamps_are_drafted_as_they_are_stated():
    from worldkit import lights

    shown = {
        "setting": "outdoor",
        "sun": {"azimuth": 20, "elevation": 8, "colour": "#ffb46a"},
        "lamps": [{"name": "bulb", "on": "bob", "at": [0, 0, -0.15], "strength": 2}, {"name": "far", "at": [3, 0, 2]}],
    }
    names: dict = {"__name__": "drafted"}
    exec(draft(plan(visualization=shown), LAYOUT).source, names)
    model = names["build"]().compile()
    wanted = lights.treated(sky="clear", azimuth_deg=20, elevation_deg=8, colour="#ffb46a")  # outdoors a sun has a sky
    assert lights.of(model) == wanted
    assert model.body(model.light("lamp.bulb").bodyid[0]).name == "bob" and model.light("lamp.far").bodyid[0] == 0
    assert "lights" not in draft(plan(), LAYOUT).source


def test_every_copy_carries_a_lamp_of_its_own_under_a_name_of_its_own():
    from worldwright.model.plan.visualization import Visualization

    shown = Visualization.model_validate({"lamps": [{"name": "bulb", "on": "post"}, {"name": "moon"}]})
    hung = [(name, on) for name, _, on in shown.hung({"post": ("post_1", "post_2")})]
    assert hung == [("bulb_1", "post_1"), ("bulb_2", "post_2"), ("moon", "")]
    with pytest.raises(ValueError, match="9 of them, and at most 8"):
        shown.hung({"post": tuple(f"post_{k}" for k in range(1, 9))})
    with pytest.raises(ValueError, match="'bulb_1'"):
        Visualization.model_validate({"lamps": [{"name": "bulb", "on": "post"}, {"name": "bulb_1"}]}).hung(
            {"post": ("post_1", "post_2")}
        )
    balls = [{"name": "bob", "primitive": "sphere", "size": [0.1, 0.1, 0.1], "material": "steel", "count": 9}]
    with pytest.raises(ValueError, match="at most 8"):
        plan(scene_objects=balls, visualization={"lamps": [{"name": "bulb", "on": "bob"}]})


def test_a_child_is_written_after_its_parent():
    source = draft(plan(), LAYOUT).source
    assert source.index('"arm"') < source.index('"bob"')


def test_what_cannot_be_drafted_is_left_to_the_author_by_name():
    wind = {"kind": "force", "bodies": ["bob"], "law": "0.5 rho c A v^2", "source": "drag equation"}
    parameters = {**PENDULUM["simulation_parameters"], "interventions": [wind]}
    drafted = draft(plan(simulation_parameters=parameters, plan_type="fsi_in_scene"), LAYOUT)
    assert not drafted.complete
    assert len(drafted.open_places) == 2
    assert drafted.source.count("AUTHOR:") == 2
    assert "program.main(build, control" in drafted.source


def test_a_tie_that_holds_throughout_belongs_into_build_as_an_equality():
    thread = {"kind": "constraint", "bodies": ["thread"], "law": "feed = 2 mm per turn of pivot", "source": "M12"}
    pendulum = {**PENDULUM, "topology": {"joints": [
        *PENDULUM["topology"]["joints"], {"name": "feed", "type": "slide", "child": "puck", "axis": [0, 0, 1]},
    ]}}  # fmt: skip

    def drafted(row):
        parameters = {**PENDULUM["simulation_parameters"], "interventions": [row]}
        return draft(Plan.model_validate({**pendulum, "simulation_parameters": parameters}), LAYOUT)

    tied = drafted(thread)
    (place,) = tied.open_places
    tie = "spec.add_equality(name='thread', type=mujoco.mjtEq.mjEQ_JOINT, name1='feed', name2='pivot')"
    assert tie in place and "in build(), not in control()" in place
    assert "AUTHOR: constraint on thread" in tied.source.partition("return spec")[0]
    assert "def control" not in tied.source
    for change in ({"trigger": "at 2 s"}, {"law": "breaks at 50 N"}):
        assert "in control()" in drafted({**thread, **change}).open_places[0]


def test_a_wind_that_the_medium_blows_leaves_nothing_to_write():
    row = {"kind": "force", "bodies": ["wind"], "law": "air at 3 m/s along +x", "source": "the prompt's breeze"}
    medium = {"wind": [3.0, 0, 0], "source": "Beaufort 2"}
    parameters = {**PENDULUM["simulation_parameters"], "medium": medium}
    still = draft(plan(simulation_parameters=parameters), LAYOUT)
    declared = draft(plan(simulation_parameters={**parameters, "interventions": [row]}), LAYOUT)
    assert declared.source == still.source and "wind on" not in declared.source
    begun = {**row, "trigger": "t >= 0 s"}
    assert draft(plan(simulation_parameters={**parameters, "interventions": [begun]}), LAYOUT).source == still.source
    gust = {**row, "law": "air at 9 m/s along +x for half a second", "trigger": "at 2 s"}
    blown = draft(plan(simulation_parameters={**parameters, "interventions": [row, gust]}), LAYOUT)
    assert blown.source.count("AUTHOR: force on wind") == 1 and "trigger: at 2 s" in blown.source and not blown.complete
    calm = {**parameters, "medium": {**medium, "wind": [0, 0, 0]}, "interventions": [row]}
    assert "AUTHOR: force on wind" in draft(plan(simulation_parameters=calm), LAYOUT).source


def test_open_questions_and_missing_poses_are_refused():
    with pytest.raises(PlanError, match="time step of what"):
        draft(plan(clarifications_needed=["time step of what?"]), LAYOUT)
    with pytest.raises(PlanError, match="no pose was resolved for puck"):
        draft(plan(), Scene(objects=LAYOUT.objects[:2]))


def test_a_cycle_of_joints_is_refused():
    joints = [
        {"name": "a", "type": "hinge", "parent": "arm", "child": "bob"},
        {"name": "b", "type": "hinge", "parent": "bob", "child": "arm"},
    ]
    with pytest.raises(PlanError, match="cycle"):
        draft(plan(topology={"joints": joints}), LAYOUT)


def test_source_text():
    wide = "y" * 90
    wrapped = f'bodies.cylinder(\n    x, "{wide}", size=(1.0,)\n)'
    assert call("bodies.cylinder", Raw("x"), wide, size=(1.0,), indent=0) == wrapped
    assert all(ast.literal_eval(literal(v)) == v for v in ("a\"b'c\n\\", (1, 2.5), {"k": (1,)}, -0.1, True, None))
    assert constant_name("8-ball felt") == "_8_BALL_FELT"
    assert dataclasses.is_dataclass(draft(plan(), LAYOUT))


def test_the_draft_is_formatted_and_lints_clean(tmp_path):
    import subprocess
    import sys

    path = tmp_path / "simulation.py"
    path.write_text(draft(plan(), LAYOUT).source)
    options = ["--line-length", "120", "--isolated"]
    for command in (["format", "--check", "--diff"], ["check", "--select", "E,F,W"]):
        done = subprocess.run([sys.executable, "-m", "ruff", *command, *options, path], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout


def test_tilts_and_the_cameras_that_templates_place_are_written():
    rows = [{**row, "deg_x": 90} if row["name"] == "puck" else row for row in PENDULUM["scene_objects"]]
    shot = PlacedCamera(name="side", template="side_minus_y", position=(0, -3, 1), target=(0, 0, 1), fovy_deg=30)
    source = draft(plan(scene_objects=rows), LAYOUT.model_copy(update={"cameras": (shot,)})).source
    assert "tilt_deg=90.0" in source
    assert "position=(0.0, -3.0, 1.0), target=(0.0, 0.0, 1.0)" in source


def towing(**row) -> Plan:
    motor = {"name": "winch", "joint": "rail", "control": "pull", **row}
    return plan(
        simulation_parameters={
            **PENDULUM["simulation_parameters"],
            "initial_motion": {},
            "constants": {"pull": {"value": 12.0, "unit": "N", "source": "the prompt"}},
            "interventions": [{"kind": "control", "bodies": ["winch"], "law": "constant pull of 12 N", "source": "the prompt"}],
        },
        topology={
            "joints": [{"name": "rail", "type": "slide", "child": "arm", "axis": [1, 0, 0]}],
            "actuators": [motor],
            "tendons": [
                {"name": "rope", "slack": 0.2, "ends": [{"body": "arm", "at": "front"}, {"body": "puck", "at": "back"}]},
                {"name": "coil", "stiffness": 50.0, "ends": [{"offset": [0, 0, 3]}, {"body": "bob", "at": "top"}]},
            ],
        },
    )  # fmt: skip


def test_ropes_springs_and_motors_are_drafted_whole():
    made = draft(towing(), LAYOUT)
    assert made.complete, made.open_places
    assert "tendons.rope(" in made.source and '("arm", (0.01, 0.0, 1.5)), ("puck", (0.95, 0.0, 0.015))' in made.source
    assert "tendons.spring(" in made.source and '("world", (0.0, 0.0, 3.0)), ("bob", (0.0, 0.0, 1.0))' in made.source
    assert 'actuators.motor(spec, "winch", joint="rail")' in made.source
    assert 'data.actuator("winch").ctrl[0] = PULL' in made.source
    names: dict = {"__name__": "drafted"}
    exec(compile(made.source, "drafted", "exec"), names)
    model = names["build"]().compile()
    assert (model.ntendon, model.nu) == (2, 1)
    assert model.tendon_range[model.tendon("rope").id, 1] > 0.2


def test_a_control_without_a_value_is_left_to_the_author():
    made = draft(towing(control=None), LAYOUT)
    assert any("control on winch" in place for place in made.open_places)
    assert "actuators.motor" in made.source and "AUTHOR:" in made.source


def test_what_the_plan_says_of_shells_feet_and_surfaces_is_drafted():
    parameters = {
        **PENDULUM["simulation_parameters"],
        "impratio": 10,
        "masses": {"bob": 2.0, "puck": 0.2},
        "materials": {
            "steel": {"density": 7850, "friction": 0.4, "source": "handbook"},
            "ice": {"friction": 0.1, "restitution": 0.2, "source": "handbook"},
        },
        "constants": {
            "share": {"value": 0.6667, "unit": "", "source": "a shell"},
            "pull": {"value": 3.0, "unit": "N", "source": "the winch"},
        },
    }
    topology = {**PENDULUM["topology"], "actuators": [{"name": "winch", "joint": "pivot", "control": "pull"}]}
    objects = [*PENDULUM["scene_objects"][:2], {**PENDULUM["scene_objects"][2], "hollow": True}]
    drafted = draft(plan(simulation_parameters=parameters, scene_objects=objects, topology=topology), LAYOUT)
    assert "spec.option.impratio = 10" in drafted.source
    assert drafted.source.count("hollow=True") == 1
    assert drafted.source.count("time_constant=4 * TIME_STEP") == 2
    assert drafted.unread == ("share",)


def test_a_long_draft_is_as_a_formatter_would_leave_it(tmp_path):
    import shutil
    import subprocess
    import sys

    names = [f"a_thing_with_a_long_name_{i}" for i in range(8)]
    rows = [{"name": n, "primitive": "sphere", "size": [0.1, 0.1, 0.1], "material": "steel"} for n in names]
    step = {**PENDULUM["implementation_steps"][0], "motion_expectations": names}
    hinge = {**PENDULUM["topology"]["joints"][1], "range": [-10, 170], "stiffness": 1.3, "spring_rest": 200}
    hinge |= {"name": "a_shoulder_of_some_length", "child": names[0], "frictionloss": 0.125}
    long = plan(
        scene_objects=rows,
        implementation_steps=[step],
        topology={"joints": [hinge]},
        simulation_parameters={**PENDULUM["simulation_parameters"], "initial_motion": {}, "masses": {}},
    )
    places = tuple(
        PlacedObject(name=n, kind="scene_object", size=(0.1,) * 3, position=(i, 0, 1)) for i, n in enumerate(names)
    )
    file = tmp_path / "drafted.py"
    file.write_text(draft(long, Scene(objects=places)).source)
    ruff = shutil.which("ruff") or [sys.executable, "-m", "ruff"]
    command = [ruff] if isinstance(ruff, str) else ruff
    done = subprocess.run(
        [*command, "format", "--check", "--isolated", "--line-length", "120", file], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout
