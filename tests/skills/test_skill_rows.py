"""Rows of a plan that a skill shows (`yaml interventions`, `yaml objectives`) are ones the plan format and the scanner take."""

import re
from pathlib import Path

import pytest
import yaml

from worldwright.lint import tools
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import parse_plan
from worldwright.place.engine import resolve
from worldwright.scan.objectives.claims import EXPECTATIONS

REPO = Path(__file__).parents[2]
PAGES = sorted([*(REPO / "skills").glob("*/SKILL.md"), *(REPO / "skills").glob("*/references/*.md")])
ROWS = [
    pytest.param(kind, body, id=f"{page.relative_to(REPO / 'skills')}:{text[: found.start()].count(chr(10)) + 2}")
    for page in PAGES
    for text in [page.read_text(encoding="utf-8")]
    for found in re.finditer(r"^```yaml (interventions|objectives)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    for kind, body in [found.groups()]
]


@pytest.mark.parametrize(("kind", "body"), ROWS)
def test_the_rows_of_a_skill_are_valid(kind, body):
    rows = yaml.safe_load(body)
    parameters = {"time_step": 0.001, "simulation_duration": 1}
    objectives = [{"claim": "It stands.", "visual_only": "only a row"}]
    if kind == "interventions":
        parameters["interventions"] = rows
    else:
        objectives = rows
    plan = Plan.model_validate({"plan_type": "mbs", "simulation_parameters": parameters, "objectives": objectives})
    for objective in plan.objectives:
        for row in objective.expect:
            for name, arguments in row.items():
                EXPECTATIONS.find(name).Given.model_validate(arguments)


PLANS = [
    pytest.param(found[1], id=f"{page.relative_to(REPO / 'skills')}")
    for page in PAGES
    for found in re.finditer(r"^~~~~markdown\n(.*?)^~~~~$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
]


@pytest.mark.parametrize("text", PLANS)
def test_a_whole_plan_of_a_skill_can_be_committed_and_resolved(text, tmp_path):
    plan = tmp_path / "plan.md"
    plan.write_text(text, encoding="utf-8")
    assert [f for f in tools.check_plan(plan).findings if f.severity == "error"] == []
    scene = resolve(parse_plan(text).plan).scene
    assert scene.ok, scene.findings
