"""The pages written from the shelves are up to date, and the skill speaks of what exists."""

import re
from pathlib import Path

import pytest
import yaml

from worldwright.model.plan.committed import Objective
from worldwright.scan import reference
from worldwright.scan.objectives.claims import EXPECTATIONS
from worldwright.scan.objectives.expecting import argument_problem

SKILL = (reference.SKILLS / "expectations/SKILL.md").read_text(encoding="utf-8")
NAMES = {entry.name: entry for entry in EXPECTATIONS.values()}


@pytest.mark.parametrize("page", reference.PAGES, ids=lambda p: p.stem)
def test_a_page_is_as_the_modules_say(page: Path):
    assert page.read_text(encoding="utf-8") == reference.PAGES[page](), (
        "run: .venv/bin/python -m worldwright.scan.reference"
    )


def test_the_page_tells_every_argument_and_its_examples_are_valid():
    text = reference.vocabulary()
    examples = re.findall(r"^Example: `- (\w+): (.*?)` · (WE\d+)$", text, re.MULTILINE)
    assert [code for _, _, code in examples] == list(
        dict.fromkeys(
            e.code
            for family in reference.FAMILIES
            for e in EXPECTATIONS.values()
            if family in e.module.__name__.split(".")
        )
    )
    for name, arguments, _ in examples:
        assert argument_problem(name, yaml.safe_load(arguments)) is None, name
    for entry in EXPECTATIONS.values():
        for field, info in entry.Given.model_fields.items():
            assert field == "window_s" or f"| `{info.alias or field}`" in text


def test_the_skill_names_every_expectation_and_marks_its_events():
    table = SKILL.split("## Which one")[1].split("## A worked")[0]
    told = dict(re.findall(r"`(\w+)`(\*?)", table))
    assert set(told) == set(NAMES), "each expectation has its place in skills/expectations/SKILL.md, table `Which one`"
    for name, star in told.items():
        assert bool(star) == bool(NAMES[name].EVENT), name


def test_the_objectives_of_the_skill_can_be_measured():
    (block,) = re.findall(r"^```yaml objectives\n(.*?)^```$", SKILL, re.MULTILINE | re.DOTALL)
    objectives = [Objective.model_validate(row) for row in yaml.safe_load(block)]
    assert any(o.visual_only for o in objectives) and any(o.cause for o in objectives)
    for objective in objectives:
        for row in objective.expect:
            ((name, arguments),) = row.items()
            assert name in NAMES and argument_problem(name, arguments) is None, name
