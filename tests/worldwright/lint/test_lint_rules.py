"""Every rule proves itself: its GOOD cases are clean, its BAD cases are found, its page is complete."""

import json
import math
import re
from functools import cache
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.lint import engine, source
from worldwright.lint.case import SOUND_PLAN, Case, plan_with
from worldwright.lint.compiled import planned
from worldwright.lint.compiled.fetch import Outcome
from worldwright.lint.compiled.view import ModelView
from worldwright.lint.harm import outcome_of
from worldwright.lint.plan_view import PlanView
from worldwright.lint.program_view import Program
from worldwright.lint.rules.plan import unknown_cause, unknown_inferred
from worldwright.model.errors import PlanError

HEADINGS = ("What it does:", "Why is this bad:", "Use instead:")


def program_cases(kind):
    for rule in engine.program_rules():
        for index, case in enumerate(getattr(rule, kind)):
            yield pytest.param(
                rule, case if isinstance(case, Case) else Case(case), id=f"{rule.code}-{rule.name}-{index}"
            )


def plan_cases(kind):
    for rule in engine.plan_rules():
        for index, change in enumerate(getattr(rule, kind)):
            yield pytest.param(rule, change, id=f"{rule.code}-{rule.name}-{index}")


def world_cases(kind):
    for rule in engine.model_rules():
        for index, case in enumerate(getattr(rule, kind)):
            text, change = case if isinstance(case, tuple) else (case, {})
            yield pytest.param(rule, text, change, id=f"{rule.code}-{rule.name}-{index}")


def world_problems(rule, text, change):
    """What a rule says of a case's world, compiled here: cases are part of the project."""
    plan = plan_with(change) if rule.SCOPE in ("plan", "acts") else None
    path = "model.xml" if text.lstrip().startswith("<") else "simulation.py"
    twin = ModelView(planned_outcome(json.dumps(change)), None, plan) if rule.SCOPE == "acts" else None
    return list(rule.check(ModelView(outcome_of(text), Program(source.parse(text, path), plan), plan, twin)))


@cache
def planned_outcome(change):
    """The world of the plan's own draft, compiled here."""
    try:
        return outcome_of(planned.source(plan_with(json.loads(change))))
    except PlanError as error:
        return Outcome("failed", message=str(error))


@pytest.mark.parametrize(("rule", "text", "change"), [*world_cases("GOOD")])
def test_good_worlds_are_clean(rule, text, change):
    assert world_problems(rule, text, change) == []


@pytest.mark.parametrize(("rule", "text", "change"), [*world_cases("BAD")])
def test_bad_worlds_are_found(rule, text, change):
    found = world_problems(rule, text, change)
    assert found
    lines = text.count("\n") + 1
    for problem in found:
        assert problem.message and not problem.message.endswith(".")
        assert problem.fix and problem.line is not None and 1 <= problem.line <= lines


def problems(rule, case):
    planned = rule.SCOPE == "plan" or bool(case.plan)
    plan = plan_with(case.plan or {}) if planned and case.plan is not None else None
    contract = None if case.plan is None else True  # without a plan, what the program imports decides
    return list(rule.check(Program(source.parse(case.source, case.path), plan, contract=contract)))


@pytest.mark.parametrize(("rule", "case"), [*program_cases("GOOD")])
def test_good_programs_are_clean(rule, case):
    assert problems(rule, case) == []


@pytest.mark.parametrize(("rule", "case"), [*program_cases("BAD")])
def test_bad_programs_are_found(rule, case):
    found = problems(rule, case)
    assert found
    lines = case.source.count("\n") + 1
    for problem in found:
        assert problem.message and not problem.message.endswith(".")
        assert problem.fix
        assert problem.line is not None and 1 <= problem.line <= lines


@pytest.mark.parametrize(("rule", "change"), [*plan_cases("GOOD")])
def test_good_plans_are_clean(rule, change):
    assert list(rule.check(PlanView(plan_with(change)))) == []


@pytest.mark.parametrize(("rule", "change"), [*plan_cases("BAD")])
def test_bad_plans_are_found(rule, change):
    found = list(rule.check(PlanView(plan_with(change))))
    assert found
    assert all(problem.section and problem.message and problem.fix for problem in found)


def test_a_cause_that_pushes_nothing_is_refused_with_one_that_works():
    found = next(f for f in engine.check_plan_rules(plan_with(unknown_cause.BAD[-2]), "plan.md") if f.code == "WP115")
    assert found.severity == "error" and "`heat` pushes nothing" in found.message and "without it: ramp;" in found.fix


def test_a_law_that_is_named_as_a_cause_is_refused_with_the_words_for_what_it_does():
    found = next(f for f in engine.check_plan_rules(plan_with(unknown_cause.BAD[-1]), "plan.md") if f.code == "WP115")
    assert found.severity == "error" and "solver:crate, solver:world" in (found.fix or "")


def test_the_sound_plan_is_clean_under_every_rule():
    assert engine.check_plan_rules(plan_with({}), "plan.md") == []
    assert SOUND_PLAN["title"]


@pytest.mark.parametrize("rule", engine.all_rules(), ids=lambda rule: rule.code)
def test_pages_are_complete(rule):
    place = -1
    for heading in HEADINGS:
        assert rule.doc.find(heading) > place, f"{rule.name}: '{heading}' is missing or out of order"
        place = rule.doc.find(heading)
    assert rule.summary.endswith(".") and len(rule.summary) < 140
    assert rule.SEVERITY in ("error", "warning", "info")
    assert len(rule.GOOD) >= 1 and len(rule.BAD) >= 1
    prefix = {"program": "WL", "model": "WM", "run": "WR", "plan": "WP"}[rule.module.__name__.split(".")[3]]
    assert re.fullmatch(prefix + r"\d{3}", rule.code)
    if prefix not in ("WP", "WR"):
        assert rule.SCOPE in engine.SCOPES


def test_codes_are_unique_and_names_do_not_repeat():
    rules = engine.all_rules()
    assert len({rule.code for rule in rules}) == len(rules)
    assert len({rule.name for rule in rules}) == len(rules)
    assert len(rules) >= 60


@given(step=st.floats(1e-5, 0.02), steps_a_period=st.floats(3.2, 10.4))
def test_the_step_that_a_stiff_spring_asks_for_is_shorter_than_the_worlds(step, steps_a_period):
    from worldwright.lint.rules.model import spring_faster_than_step as rule

    view = SimpleNamespace(time_step=step, name=lambda *_: "root", at=lambda *told: told)
    phase = 2 * math.pi / steps_a_period
    ((_, _, message, fix, severity),) = rule._problems(view, "joint", 0, phase)
    asked = float(re.search(r"to (\S+) s or less", fix).group(1))
    assert severity == "warning" and f"{steps_a_period:.1f} steps" in message
    assert 0 < asked < step and asked * phase / step <= rule.UNRESOLVED * (1 + 1e-9)


def test_a_law_whose_file_does_not_lie_beside_the_program_is_found(tmp_path):
    rule = engine.find("WL128")
    case = rule.GOOD[0]
    path = tmp_path / "simulation.py"
    path.write_text(case.source)
    program = Program(source.read(path), plan_with(case.plan))
    (problem,) = rule.check(program)
    assert "laws/rubber.py, which does not belong to the program" in problem.message
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws" / "rubber.py").write_text("class Rubber:\n    pass\n")
    assert list(rule.check(Program(source.read(path), plan_with(case.plan)))) == []


BESIDE = (
    "from laws.rubber import Rubber\nclass Own(Rubber):\n    pass\ndef made():\n    return Rubber()\nband = Rubber()\n"
)


@pytest.mark.parametrize(
    ("imported", "given", "says"),
    [
        ("from laws.rubber import Rubber", "Rubber()", []),
        ("import laws.rubber", "laws.rubber.Rubber()", []),
        ("from helpers import made", "made()", []),
        ("from helpers import band", "band", []),
        ("from helpers import Rubber", "Rubber()", []),
        ("import copy, helpers", "copy.copy(helpers.band)", []),
        ("from laws.honey import Honey", "Honey()", ["Honey(), which comes from none", "handed none of it"]),
        ("from helpers import Own", "Own()", ["Own(), which comes from none", "handed none of it"]),
        ("import helpers", "helpers.Own()", ["helpers.Own(), which comes from none", "handed none of it"]),
    ],
)
def test_of_a_law_that_a_file_beside_makes_only_its_class_says_where_it_stands(tmp_path, imported, given, says):
    rule = engine.find("WL128")
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws" / "rubber.py").write_text("class Rubber:\n    pass\n")
    (tmp_path / "laws" / "honey.py").write_text("class Honey:\n    pass\n")
    (tmp_path / "helpers.py").write_text(BESIDE)
    head, call = "from worldkit import program\nimport laws.rubber\n", "program.main(build, duration=3.0, laws=[{}])\n"
    path = tmp_path / "simulation.py"
    path.write_text(f"{head}{imported}\ndef build():\n    return None\n{call.format(given)}")
    found = rule.check(Program(source.read(path), plan_with(rule.GOOD[0].plan)))
    for problem, said in zip(found, says, strict=True):
        assert said in problem.message


def test_the_size_that_would_be_right_is_told_and_of_what_shows_a_law_that_alone():
    rule = engine.find("WM151")
    law = {"simulation_parameters": {"interventions": [{**unknown_inferred.LAW, "bodies": ["ramp"]}]}}
    (crate,), (mug,), (points,) = (
        world_problems(rule, *case) for case in ((rule.BAD[0], {}), (rule.BAD[1], {}), (rule.BAD[0], law))
    )
    assert crate.fix == "build it in the plan's size, or write `size: [0.8, 0.6, 0.4]` in the plan"
    assert mug.fix.endswith("or write `asset_dimensions.mug: 0.2` in the plan")
    assert (
        points.fix.startswith("its size is that of its law's points") and "write `size: [0.8, 0.6, 0.4]`" in points.fix
    )


def test_what_is_inferred_in_the_file_of_a_law_is_a_name_that_stands_there(tmp_path):
    rule = engine.find("WP124")
    names = ["laws/snow.py", "laws/snow.py.spacing", "laws/snow.py.spacings"]
    told = plan_with({"simulation_parameters": {"interventions": [unknown_inferred.LAW], "inferred": names}})
    told.__dict__["folder"] = tmp_path
    (tmp_path / "laws").mkdir()
    (tmp_path / "laws/snow.py").write_text("def __init__(self, spacing=0.014): ...\n", encoding="utf-8")
    (problem,) = rule.check(PlanView(told))
    assert "`laws/snow.py.spacings` leads to nothing" in problem.message
