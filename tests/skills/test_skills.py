"""Skills are short, their examples work, and everything they cite exists."""

import importlib
import re
from pathlib import Path

import pytest
import yaml

from worldwright import expose
from worldwright.cli import COMMANDS
from worldwright.model.plan.committed import SECTIONS, Plan
from worldwright.model.plan.plan_text import parse_plan
from worldwright.place.engine import resolve
from worldwright.place.vocabulary import PREDICATES

REPO = Path(__file__).parents[2]
SKILLS = sorted((REPO / "skills").glob("*/SKILL.md"))
PLANNING = [p for p in SKILLS if p.parent.name in ("plan-format", "coordinates", "layouts", "dimensions", "cameras")]
by_name = pytest.mark.parametrize("path", SKILLS, ids=lambda p: p.parent.name)


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def front(path: Path) -> dict:
    _, header, _ = text_of(path).split("---\n", 2)
    return yaml.safe_load(header)


def test_the_planning_skills_are_there():
    assert len(PLANNING) == 5
    assert all(front(path)["metadata"]["tier"] == "planning" for path in PLANNING)


@by_name
def test_a_skill_introduces_itself_and_is_short(path):
    header = front(path)
    assert header["name"] == path.parent.name
    assert "Use when" in header["description"]
    assert header["metadata"]["tier"] in ("baseline", "feature", "planning")
    assert len(text_of(path).splitlines()) <= 120, "what an example cannot show stays; the rest lies in its references"
    assert max(map(len, text_of(path).split("---\n", 2)[2].splitlines())) <= 140


@by_name
def test_every_command_a_skill_names_exists(path):
    found = re.findall(r"`(?:\S*/)?worldwright ([a-z]+(?:-[a-z]+)*)(?: ([a-z][a-z-]+))?\b", text_of(path))
    for server, verb in found:
        assert server in (*expose.SERVERS, *COMMANDS), server
        if server in expose.SERVERS and verb:
            names = {function.__name__.replace("_", "-") for function in expose.tools(server)}
            assert verb in names, f"worldwright {server} {verb}"


@by_name
def test_every_path_a_skill_names_exists(path):
    tops = ("servers", "skills", "catalog", "examples", "tests", "commands")
    for cited in re.findall(rf"`((?:{'|'.join(tops)})/[\w./-]+)`", text_of(path)):
        assert (REPO / cited).exists(), cited


@by_name
def test_every_code_a_skill_names_is_used(path):
    sources = "".join(p.read_text(encoding="utf-8") for p in (REPO / "servers").rglob("*.py"))
    for code in re.findall(r"\bW[LPS]\d{3}\b", text_of(path)):
        assert f'"{code}"' in sources, code


@pytest.mark.parametrize("path", PLANNING, ids=lambda p: p.parent.name)
def test_every_predicate_a_planning_skill_names_is_in_the_vocabulary(path):
    for name in re.findall(r"`((?:[A-Z]+-)+[A-Z]+)`|predicate: ([A-Z-]+)", text_of(path)):
        assert (name[0] or name[1]) in PREDICATES, name


def test_the_coordinates_skill_tells_every_predicate_and_parameter():
    text = text_of(REPO / "skills/coordinates/SKILL.md")
    assert "skills/coordinates/references/vocabulary.md" in text  # every relation template, with its formula
    for code, entry in PREDICATES.items():
        assert f"`{code}`" in text, code
        assert all(f"`{name}" in text for name in entry.PARAMS), code


def test_the_plan_skill_tells_every_section():
    text = text_of(REPO / "skills/plan-format/SKILL.md")
    for section in SECTIONS:
        assert section in text


def test_the_plan_of_the_plan_skill_reads_and_resolves():
    text = text_of(REPO / "skills/plan-format/SKILL.md")
    (block,) = re.findall(r"^~~~~markdown\n(.*?)^~~~~$", text, re.MULTILINE | re.DOTALL)
    plan = parse_plan(block).plan
    scene = resolve(plan).scene
    assert scene.ok, scene.findings
    assert scene["ball"].position == (0, 0, 0.55)
    looks = importlib.import_module("worldkit.materials").LOOKS
    assert all(row.look in looks for row in plan.scene_objects)


def test_the_recipes_of_the_coordinates_skill_resolve():
    text = text_of(REPO / "skills/coordinates/SKILL.md")
    recipes = [yaml.safe_load(block) for block in re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)]
    assert len(recipes) == 3
    layouts = []
    for rows in recipes:
        names = list(dict.fromkeys(row["subject"] for row in rows))
        size = [0.6, 0.3, 0.2]
        plan = Plan.model_validate(
            {
                "plan_type": "scene",
                "simulation_parameters": {"time_step": 0.001, "simulation_duration": 1},
                "objectives": [{"claim": "it stands"}],
                "scene_objects": [{"name": name, "primitive": "box", "size": size} for name in names],
                "topology": {"scene_predicates": rows},
            }
        )
        scene = resolve(plan).scene
        assert scene.ok, scene.findings
        layouts.append(scene)
    assert layouts[0]["laptop"].deg_z == pytest.approx(180)
    assert layouts[1]["box_3"].position[0] == pytest.approx(1.24)
    assert layouts[2]["ball"].position == (0, 0, 1.9)


def test_the_blocks_of_the_interventions_skill_run(tmp_path):
    import mujoco

    from worldengine.recording import stored
    from worldkit import program
    from worldwright.scan.audits.causes import Causes
    from worldwright.scan.objectives.claims import EXPECTATIONS

    folder = REPO / "skills/interventions"
    text = text_of(folder / "SKILL.md") + text_of(folder / "references/honest-release.md")
    blocks = dict(re.findall(r"^```\w+ (\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1,
                "interventions": yaml.safe_load(blocks["interventions"]),
            },
            "objectives": yaml.safe_load(blocks["objectives"]),
        }
    )
    assert Causes and plan.objectives[0].cause == ("crate",)
    for objective in plan.objectives:
        for row in objective.expect:
            for name, arguments in row.items():
                EXPECTATIONS.find(name).Given.model_validate(arguments)
    names: dict = {}
    exec(compile(blocks["program"], "SKILL.md", "exec"), names)

    def build():
        spec = mujoco.MjSpec()
        for name, z, mass in (("shelf", 1.0, 2.0), ("crate", 1.35, 8.0)):
            body = spec.worldbody.add_body(name=name, pos=(0, 0, z))
            body.add_freejoint()
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.2, 0.1), mass=mass)
        bolt = spec.add_equality(name="bolt", type=mujoco.mjtEq.mjEQ_WELD, name1="shelf")
        bolt.objtype, bolt.data[:3] = mujoco.mjtObj.mjOBJ_BODY, 0
        return spec

    argv = ["--pass", "physics", "--out", str(tmp_path / "out")]
    assert program.main(build, names["control"], duration=0.6, argv=argv) == 0
    (kind,), (value,) = (getattr(stored.open(tmp_path / "out/trajectory").interventions, n) for n in ("kind", "value"))
    assert kind == "constraint" and value[1] > names["STRENGTH_N"]


def test_the_blocks_of_the_layouts_skill_are_read():
    from worldwright.model.plan.layout_density import read
    from worldwright.model.plan.observation import ImageObservation
    from worldwright.model.plan.plan_yaml import compose

    text = text_of(REPO / "skills/layouts/SKILL.md")
    blocks = re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    rows, density, observation = (compose(b, 0, len(b), lambda *why: None).data() for b in blocks)
    targets, clearances, wrong = read(density)
    assert (set(targets), len(clearances), wrong) == ({"scene", "table"}, 2, [])
    assert ImageObservation.model_validate(observation["image_observation"]).viewpoint == "side_minus_y"
    sizes = {"table": [1.6, 0.9, 0.75], "plate": [0.27, 0.27, 0.03], "fork": [0.2, 0.02, 0.01]}
    names = [*dict.fromkeys(row["subject"] for row in rows), "fork_2", "table"]
    plan = Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.001, "simulation_duration": 1},
            "objectives": [{"claim": "it stands"}],
            "scene_objects": [{"name": n, "primitive": "box", "size": sizes[n.split("_")[0]]} for n in names],
            "topology": {
                "scene_predicates": [
                    {"subject": "table", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}},
                    *rows,
                ]
            },
        }
    )
    scene = resolve(plan).scene
    assert scene.ok, scene.findings
    one, two = scene["fork_1"].position, scene["fork_2"].position
    assert (one[0] + two[0], one[1] + two[1]) == pytest.approx((-0.8, 0.0))


def test_the_cameras_skill_names_every_view():
    from worldkit.cameras.views import VIEWS

    text = text_of(REPO / "skills/cameras/SKILL.md")
    for view in VIEWS:
        kin = view.startswith(("camera_side_", "inside_"))
        assert f"`{view}`" in text or kin, view
