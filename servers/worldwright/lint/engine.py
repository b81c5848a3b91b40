"""Run the rules of a shelf over a program or a plan."""

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING

from ..model.errors import NotFoundError
from ..model.finding import Finding
from ..model.plan import Plan
from ..shelf import Entry, Shelf
from . import source as sources
from . import suppression
from .problem import Problem
from .program import Program
from .proof import KINDS

if TYPE_CHECKING:
    from .compiled.fetch import Outcome

PER_RULE = 20
"""Hits of one rule shown per file: the rest would say the same."""

MOST_COUNTED = 100
"""Further hits that are counted: looking up near names for thousands of them would take long."""

SCOPES = ("file", "any", "contract", "plan")
"""What a program rule needs: any file, a parsed program or model, a program of ours, or a plan to compare with."""

_COMMON: dict[str, type | tuple[type, ...]] = {
    "SEVERITY": str,
    "GOOD": tuple,
    "BAD": tuple,
    "EVIDENCE": KINDS,
    "check": FunctionType,
}
PROGRAM_RULES = Shelf("worldwright.lint.rules.program", requires={**_COMMON, "SCOPE": str})
MODEL_RULES = Shelf("worldwright.lint.rules.model", requires={**_COMMON, "SCOPE": str})
PLAN_RULES = Shelf("worldwright.lint.rules.plan", requires=_COMMON)


@cache
def program_rules() -> tuple[Entry, ...]:
    """Every program rule, by code."""
    return tuple(PROGRAM_RULES.values())


@cache
def model_rules() -> tuple[Entry, ...]:
    """Every rule about compiled worlds, by code."""
    return tuple(MODEL_RULES.values())


NAMES = ("WL100", "WL101", "WL102", "WL103", "WL104", "WL105", "WL106")
"""Rules about names: a program that fails them is not worth building."""
SYMBOLS = (*NAMES, "WL107", "WL108", "WL109", "WL116", "WL117", "WL142", "WL151")
"""Program rules about names and signatures of the installed build; the others are about silent mistakes and staging."""
SKILLS = Path(__file__).parents[3] / "skills"
GROUPS = ("symbols", "mistakes", "model", "plan")


def group(rule: Entry) -> str:
    """Which of the four groups a rule is of."""
    shelf = rule.module.__name__.rsplit(".", 2)[-2]
    if shelf in ("model", "plan"):
        return shelf
    if rule.code.startswith(("WM", "WP")):  # a third party's
        return "model" if rule.code.startswith("WM") else "plan"
    return "symbols" if rule.code in SYMBOLS else "mistakes"


def find(code: str) -> Entry:
    """A rule of any shelf by code or name; a `NotFoundError` lists the nearest, or says where a code of scan is told."""
    for shelf in (PROGRAM_RULES, MODEL_RULES, PLAN_RULES):
        for key in (code.upper(), code.lower()):
            if key in shelf:
                return shelf[key]
    prefix = code.upper()[:2]
    if prefix in ("WS", "WE") and code[2:].isdigit():
        page = "review/references/anomalies" if prefix == "WS" else "expectations/references/vocabulary"
        raise NotFoundError(
            f"{code} is no lint rule but {'an anomaly check of scan' if prefix == 'WS' else 'an expectation'}",
            next_move=f"its page: `worldwright retrieve read skills/{page}.md`",
        )
    if prefix == "WP" and code[2:3] in ("0", "2", "3") and code[2:].isdigit():
        told = _told_in(code.upper())
        raise NotFoundError(
            f"{code.upper()} is no lint rule but a finding of {'the plan reader' if code[2] == '0' else 'place'}",
            next_move=f"its page: `worldwright retrieve read {told}`"
            if told
            else "`worldwright retrieve search` for its words",
        )
    return {"WP": PLAN_RULES, "WM": MODEL_RULES}.get(prefix, PROGRAM_RULES).find(code)


def _told_in(code: str) -> str | None:
    """The skill whose table of findings has a code, or None."""
    for page in sorted(SKILLS.glob("*/SKILL.md")):
        if any(line.startswith("| `WP") and f"`{code}`" in line for line in page.read_text("utf-8").splitlines()):
            return f"skills/{page.parent.name}/{page.name}"
    return None


def all_rules() -> tuple[Entry, ...]:
    """Every rule there is: about programs, compiled worlds, plans."""
    return (*program_rules(), *model_rules(), *plan_rules())


@cache
def plan_rules() -> tuple[Entry, ...]:
    """Every plan rule, by code."""
    return tuple(PLAN_RULES.values())


def check_source(source: sources.Source, plan: Plan | None = None, contract: bool | None = None) -> list[Finding]:
    """Findings of every program rule that applies, in the order of the lines."""
    program = Program(source, plan, contract)
    answered = suppression.of(source)
    found: list[Finding] = []
    for rule in program_rules():
        if applies(rule, program):
            found += findings(rule, rule.check(program), source.path, answered)
    return in_order(found)


ALWAYS = ("WM101", "WM102")
"""Model rules that speak of worlds which could not be built, too."""


def applies(rule: Entry, program: Program) -> bool:
    """Whether a rule has something to look at in this program."""
    scope = rule.SCOPE
    if scope == "file":
        return True
    if program.source.problem is not None:
        return False
    if scope == "any":
        return True
    if program.source.is_mjcf:
        return False
    return program.plan is not None if scope == "plan" else program.contract


def findings(
    rule: Entry, problems: Iterable[Problem], file: str, answered: tuple[suppression.Suppression, ...] = ()
) -> Iterator[Finding]:
    """A rule's problems as findings; what a comment answers for becomes information."""
    seen: set[tuple[int | None, str]] = set()
    more = 0
    for problem in problems:
        if (problem.line, problem.message) in seen:
            continue
        seen.add((problem.line, problem.message))
        if len(seen) > PER_RULE:
            more += 1
            if more >= MOST_COUNTED:
                break
            continue
        answer = next((s for s in answered if s.covers(rule.code, problem)), None)
        yield Finding(
            code=rule.code,
            name=rule.name,
            severity="info" if answer else problem.severity or rule.SEVERITY,
            message=problem.message + (f" (suppressed: {answer.reason})" if answer else ""),
            fix=problem.fix,
            file=file,
            line=problem.line,
            column=problem.column,
            section=problem.section,
        )
    if more:
        yield Finding(
            code=rule.code,
            name=rule.name,
            severity=rule.SEVERITY,
            message=f"{more}{'+' * (more >= MOST_COUNTED)} more of the same",
            fix=f"see `worldwright lint explain {rule.code}`",
            file=file,
        )


def in_order(found: Iterable[Finding]) -> list[Finding]:
    """By line, then code; findings without a line come first."""
    return sorted(found, key=lambda f: (f.line or 0, f.column or 0, f.code))


def check_plan_rules(plan: Plan, file: str, line_of=None) -> list[Finding]:
    """Findings of every plan rule; `line_of(section, *path)` places them."""
    from .plan_view import PlanView

    view = PlanView(plan, line_of)
    found: list[Finding] = []
    for rule in plan_rules():
        found += findings(rule, rule.check(view), file)
    return in_order(found)


def check_world(program: Program, outcome: "Outcome") -> list[Finding]:
    """Findings of every model rule on the world that a program makes."""
    from .compiled.view import ModelView

    view = ModelView(outcome, program, program.plan)
    answered = suppression.of(program.source)
    found: list[Finding] = []
    for rule in model_rules():
        needs_world = rule.CODE not in ALWAYS and outcome.status != "compiled"
        if needs_world or (rule.SCOPE == "plan" and program.plan is None):
            continue
        found += findings(rule, rule.check(view), program.path, answered)
    return in_order(found)


LEAST_WALL_S = 2.0


def check_program_file(
    path: Path, plan: Plan | None, contract: bool | None = None, model: bool | None = None, wall_s: float = 20.0
) -> tuple[list[Finding], str]:
    """Findings on one file, and in a few words how building its world went (empty: it was not wanted).

    Args:
        path: program or MJCF file.
        plan: to compare with.
        contract: it is a program of ours (None: to be seen from its imports).
        model: build its world in the sandbox (None: for programs of ours and model files).
        wall_s: time to build it, s.
    """
    source = sources.read(path)
    found = check_source(source, plan, contract)
    program = Program(source, plan, contract)
    if source.problem is not None or (model is None and not (source.is_mjcf or program.contract)) or model is False:
        return found, ""
    if model is None and any(f.code in NAMES for f in found):  # an author's ignore does not make a name exist
        return found, f"{path.name}: the world is not built until its names are right"
    from .compiled import fetch

    if wall_s < LEAST_WALL_S:
        return found, f"{path.name}: the world is not built: the call's time went into the files before it"
    outcome = fetch.world(path, is_mjcf=source.is_mjcf, wall_s=wall_s)
    if outcome.status == "refused":
        return found, f"{path.name}: the world is not built: no sandbox confines here (worldwright doctor says why)"
    if outcome.status == "nothing":
        return found, f"{path.name}: the program makes no world"
    said = f"{path.name}: world {outcome.status.replace('_', ' ')} in {outcome.wall_s:.1f} s, sandbox {outcome.level}"
    return in_order([*found, *check_world(program, outcome)]), said
