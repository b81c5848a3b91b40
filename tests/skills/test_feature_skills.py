"""What feature skills say to write into a plan is a plan: rows validate, expectations and looks exist."""

import re
from functools import cache
from pathlib import Path

import pytest
import yaml

from worldkit.materials import LOOKS
from worldwright.lint.tools import check_program
from worldwright.model.plan.committed import Constant, InitialMotion, Intervention, Joint, Objective, SurfaceConstants
from worldwright.model.plan.drives import Actuator
from worldwright.model.plan.scene_objects import AssetRow
from worldwright.scan.objectives.claims import EXPECTATIONS

REPO = Path(__file__).parents[2]
PAGES = sorted([*(REPO / "skills").glob("*/SKILL.md"), *(REPO / "skills").glob("*/references/*.md")])
ROWS = {
    "actuators": Actuator,
    "assets": AssetRow,
    "interventions": Intervention,
    "joints": Joint,
    "objectives": Objective,
}
NAMED = {"materials": SurfaceConstants, "constants": Constant, "initial_motion": InitialMotion}
BLOCKS = [
    pytest.param(what, text, id=f"{page.relative_to(REPO / 'skills')}-{what}-{number}")
    for page in PAGES
    for number, (what, text) in enumerate(
        re.findall(r"^```yaml (\w+)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    )
]


@pytest.mark.parametrize(("what", "text"), BLOCKS)
def test_what_a_skill_puts_into_a_plan_belongs_there(what, text):
    rows = yaml.safe_load(text)
    if what in NAMED:
        for row in rows.values():
            NAMED[what].model_validate(row)
        return
    for row in rows:
        made = ROWS[what].model_validate(row)
        if what == "objectives":
            for expected in made.expect:
                for name, arguments in expected.items():
                    EXPECTATIONS.find(name).Given.model_validate(arguments)


@cache
def sources() -> str:
    """All that the suite's own modules say."""
    return "".join(path.read_text(encoding="utf-8") for path in (REPO / "servers").rglob("*.py"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(REPO / "skills")))
def test_every_rule_a_page_names_exists(page):
    text = page.read_text(encoding="utf-8")
    for code in re.findall(r"\bW[A-Z]\d{3}\b", text):
        assert f'"{code}"' in sources(), code


def test_the_looks_of_the_materials_skill_exist():
    page = (REPO / "skills/materials/SKILL.md").read_text(encoding="utf-8")
    families = page[page.index("## Looks") :]
    named = re.findall(r"`([a-z]+(?:_[a-z]+)*)`", families)
    assert len(named) > 50
    assert [name for name in named if name not in LOOKS and name != "look"] == []


PROGRAMS = [
    pytest.param(text, id=f"{page.relative_to(REPO / 'skills')}-{number}")
    for page in PAGES
    if "tier: baseline" not in (REPO / "skills" / page.relative_to(REPO / "skills").parts[0] / "SKILL.md").read_text()
    for number, text in enumerate(
        re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    )
]
OWN_CLOCK = {"WL110", "WL111"}
"""A block that proves a number steps its world itself; a generated program leaves that to worldkit.

Baseline skills are about the tools around a program; their blocks need not be such programs.
"""


@pytest.mark.parametrize("text", PROGRAMS)
def test_the_linter_has_nothing_to_say_about_a_program_of_a_skill(text, tmp_path):
    program = tmp_path / ("film.py" if "worldkit.filming" in text else "simulation.py")
    program.write_text(text, encoding="utf-8")
    report = check_program([program], model=False)
    assert [f for f in report.findings if f.code not in OWN_CLOCK] == []
