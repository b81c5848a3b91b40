"""A plan is completed from the world that its program builds: what is claimed stays, the rest is written down as built."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.lint import tools
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.plan.plan_text import read_plan
from worldwright.place import tools as place

BALL = "- {name: ball, role: falls, primitive: sphere, size: [0.2, 0.2, 0.2], material: rubber}   # as claimed"
PLAN = f"""# A ball falls beside a gate

## plan_type

mbs_in_scene

## simulation_parameters

```yaml
time_step: 0.001             # s
simulation_duration: 1.0     # s
materials:
  rubber: {{friction: 0.6, restitution: 0.5, source: "CRC Handbook, rubber"}}
masses:
  ball: 0.5                  # kg, as claimed
inferred: [time_step, simulation_duration, masses.ball]
```

## objectives

```yaml
- claim: The ball falls.
  cause: gravity
  expect:
    - falls: {{body: ball, min_m: 0.5}}
```

## implementation_steps

```yaml
- description: Let the ball go beside the gate.
  scene_objects: [ball]
  cameras:
    - {{name: overview, view: perspective, subjects: [ball], fovy: 35}}
    - {{name: side, view: side_minus_y, subjects: [ball]}}
  motion_expectations: [ball]
```

## scene_objects

```yaml
{BALL}
```

## assets

## asset_dimensions

## layout_density

## topology

## visualization

headless

## recording_mode

cameras

## clarifications_needed

- none

## geometry_relations
"""
PROGRAM = '''"""A ball falls beside a gate.

What the plan claims of it:
- The ball falls.
"""

import mujoco

from worldkit import bodies, cameras, contacts, joints, program, scene
from worldkit.parts import Part

TIME_STEP = 0.001  # s
RUBBER = contacts.surface(friction=0.6, restitution=0.5, time_constant=4 * TIME_STEP)
WOOD = contacts.surface(friction=0.35)
HINGE = joints.Hinge("pivot", anchor=(-1.0, -0.4, 0.5), axis=(0, 0, 1), range_deg=(-90, 90), stiffness=2.0, damping=0.2)
STAND = (
    Part("top", "box", (0.6, 0.4, 0.03), offset=(0, 0, 0.5)),
    Part("leg", "box", (0.05, 0.05, 0.5), offset=(0, 0, 0.25), deg_x=10.0, deg_y=-5.0, deg_z=20.0),
)


def build() -> mujoco.MjSpec:
    """The world at t = 0."""
    spec = scene.new("half", time_step=TIME_STEP, gravity=(0.0, 0.0, -9.81))
    bodies.sphere(spec, "ball", diameter=0.2, pos=(0.0, 0.0, 1.0), mass=0.5, surface=RUBBER)
    bodies.box(spec, "wall", size=(0.1, 2.0, 0.5), pos=(1.0, 0.0, 0.25), yaw_deg=30.0, fixed=True, surface=WOOD)
    bodies.box(spec, "gate", size=(0.05, 0.8, 0.6), pos=(-1.0, 0.0, 0.5), mass=3.0, surface=WOOD, joint=HINGE)
    bodies.cylinder(spec, "log", diameter=0.2, height=0.6, tilt_deg=90.0, pos=(0.0, 1.5, 0.1), mass=4.0, surface=WOOD)
    bodies.compound(spec, "stand", parts=STAND, pos=(0.0, -1.5, 0.3), yaw_deg=10.0, mass=5.0, surface=WOOD)
    # MORE
    cameras.add(spec, "overview", view="perspective", subjects=("ball",), fovy=35)
    cameras.add(spec, "side", view="side_minus_y", subjects=("ball",))
    return spec


if __name__ == "__main__":
    program.main(build, duration=1.0, movers=("ball",))
'''


@pytest.fixture
def run(tmp_path) -> Run:
    folder = tmp_path / "runs/half"
    folder.mkdir(parents=True)
    (folder / "plan.md").write_text(PLAN, encoding="utf-8")
    (folder / "simulation.py").write_text(PROGRAM, encoding="utf-8")
    return Run(folder)


def completed(run: Run):
    return tools.complete_plan(str(run.folder))


def test_what_the_program_builds_is_written_down_and_holds(run):
    done = completed(run)
    assert done.ok and done.written and done.left == () and done.findings == ()
    assert done.objects == ("wall", "gate", "log", "stand") and done.joints == ("pivot",)
    assert done.placed == ("wall", "gate", "log", "stand", "ball")
    plan = read_plan(run.plan).plan
    built = {row.name: row for row in plan.scene_objects if row.built}
    assert set(built) == {"wall", "gate", "log", "stand"} and built["wall"].fixed and not built["gate"].fixed
    assert (built["log"].primitive, built["log"].deg_x) == ("cylinder", 90)
    leg = built["stand"].parts[1]
    assert (leg.deg_x, leg.deg_y, leg.deg_z) == pytest.approx((10, -5, 20))
    (joint,) = plan.topology.joints
    assert joint.built and joint.anchor == pytest.approx((-1, -0.4, 0.5)) and joint.range == pytest.approx((-90, 90))
    assert plan.simulation_parameters.masses == {"ball": 0.5, "gate": 3.0, "log": 4.0, "stand": 5.0}
    assert {"masses.ball", "masses.gate"} <= set(plan.simulation_parameters.inferred)
    # The plan's own draft is now the program's world: nothing of it acts otherwise, and its places hold.
    assert tools.check_plan(run.plan).findings == ()
    assert tools.check_program([run.program]).findings == ()
    assert place.check(run.plan).ok


def test_what_was_stated_stands_as_it_was_written(run):
    completed(run)
    after = run.plan.read_text(encoding="utf-8").splitlines()
    changed = [line for line in PLAN.splitlines() if line not in after]
    assert changed == ["inferred: [time_step, simulation_duration, masses.ball]"] and BALL in after


def test_a_second_time_there_is_nothing_to_add(run):
    completed(run)
    before = run.plan.read_bytes()
    again = completed(run)
    assert again.ok and not again.written and run.plan.read_bytes() == before


def test_the_journal_says_what_was_completed(run):
    completed(run)
    (line,) = run.entries()
    assert (line["actor"], line["action"], line["plan_sha256"]) == ("lint", "plan", sha256_file(run.plan))
    assert line["completed"] == ["wall", "gate", "log", "stand"]


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("mass=0.5, surface=RUBBER", "mass=0.6, surface=RUBBER", "WM162"),
        ('"ball", diameter=0.2', '"ball", diameter=0.3', "WM151"),
        ("contacts.surface(friction=0.6", "contacts.surface(friction=0.9", "WM160"),
    ],
)
def test_a_difference_from_what_is_stated_is_a_finding_and_never_overwritten(run, old, new, code):
    assert old in PROGRAM
    run.program.write_text(PROGRAM.replace(old, new), encoding="utf-8")
    done = completed(run)
    assert not done.ok and code in {finding.code for finding in done.findings}
    plan = read_plan(run.plan).plan
    assert plan.simulation_parameters.masses["ball"] == 0.5
    assert plan.simulation_parameters.materials["rubber"].friction == 0.6
    assert BALL in run.plan.read_text(encoding="utf-8")


def test_a_stated_place_is_kept_and_a_world_that_departs_from_it_is_told(run):
    rows = "scene_predicates:\n  - {subject: ball, predicate: PLACE-ON-BASE, params: {x: 0.5, y: 0, gap: 0.9}}\n"
    run.plan.write_text(PLAN.replace("## topology\n", f"## topology\n\n```yaml\n{rows}```\n"), encoding="utf-8")
    place.resolve(run.plan)
    done = completed(run)
    assert "ball" not in done.placed and "WM152" in {finding.code for finding in done.findings}


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (
            "spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=(3, 0, 1), size=(.1, .1, .1))",
            "a body of its own",
        ),
        (
            "b = spec.worldbody.add_body(pos=(3, 0, 1)); b.add_freejoint(); b.add_geom(size=(.1, 0, 0))",
            "give it a name",
        ),
        (
            (
                "b = spec.worldbody.add_body(name='off', pos=(3, 0, 1)); b.add_freejoint(); "
                "b.add_geom(size=(.1, 0, 0), pos=(0, 0, .2))"
            ),
            "is not the middle of its box",
        ),
        (
            (
                "b = spec.worldbody.add_body(name='slanting', pos=(3, 0, 1), quat=(.9, .1, 0, 0)); b.add_freejoint(); "
                "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.1, .2, .3))"
            ),
            "its frame is tilted",
        ),
        (
            (
                "m = spec.add_mesh(name='tetra'); m.uservert = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]; "
                "spec.worldbody.add_body(name='odd', pos=(3, 0, 1)).add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname='tetra')"
            ),
            "",
        ),
        (
            (
                "b = spec.worldbody.add_body(name='twice', pos=(3, 0, 1)); b.add_geom(size=(.1, 0, 0)); "
                "b.add_joint(name='a', axis=(1, 0, 0)); b.add_joint(name='b', axis=(0, 1, 0))"
            ),
            "several joints",
        ),
        (
            "spec.add_equality(name='glue', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='log')",
            "glue",
        ),
        ("spec.add_actuator(name='push', target='pivot', trntype=mujoco.mjtTrn.mjTRN_JOINT)", "topology.actuators"),
    ],
)
def test_what_no_row_can_say_is_left_with_the_next_move(run, more, told):
    run.program.write_text(PROGRAM.replace("# MORE", more), encoding="utf-8")
    done = completed(run)
    assert not done.ok and len(done.left) >= 1 and told in " ".join(done.left)
    assert "left to you" in done.text() and done.next_move.startswith("mend")
    assert set(done.objects) >= {"wall", "gate", "log", "stand"}  # the rest is written down all the same


def test_a_surface_of_the_plan_is_used_again(run):
    more = 'bodies.box(spec, "pad", size=(0.3, 0.3, 0.1), pos=(3, 0, 0.05), fixed=True, surface=RUBBER)'
    run.program.write_text(PROGRAM.replace("# MORE", more), encoding="utf-8")
    assert completed(run).materials == ("built_1",)
    rows = {row.name: row for row in read_plan(run.plan).plan.scene_objects}
    assert rows["pad"].material == "rubber" and rows["wall"].material == "built_1"


def test_without_a_world_nothing_is_written(run):
    before = run.plan.read_bytes()
    run.program.write_text(PROGRAM.replace("# MORE", "raise ValueError('no world')"), encoding="utf-8")
    with pytest.raises(GateError, match="no world") as refused:
        completed(run)
    assert "simulation.py:" in str(refused.value.place)
    run.program.unlink()
    with pytest.raises(NotFoundError, match="no program"):
        completed(run)
    assert run.plan.read_bytes() == before


def test_the_command_answers_yes_or_no(run):
    done = CliRunner().invoke(main, ["plan", "complete", str(run.folder)])
    assert done.exit_code == 0 and "objects: wall, gate, log, stand" in done.output
    run.program.write_text(PROGRAM.replace("mass=0.5, surface", "mass=0.6, surface"), encoding="utf-8")
    assert CliRunner().invoke(main, ["plan", "complete", str(run.folder)]).exit_code == 1


@pytest.mark.parametrize("name", ["box-slides-to-rest", "pendulum-dies-out", "rolling-marble", "suitcase-tips"])
def test_an_example_names_all_that_its_program_builds(name, tmp_path):
    """A motor, a model of the catalog, copies of a group: what the plan places in any way is not placed again."""
    world, folder = Path(__file__).parents[3] / "examples" / name, tmp_path / name
    folder.mkdir()
    for file in ("plan.md", "simulation.py"):
        (folder / file).write_bytes((world / file).read_bytes())
    done = tools.complete_plan(str(folder))
    assert done.ok and not done.written, done.text()
