"""Run the rules of a shelf over a program or a plan."""

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from types import FunctionType

from ..model.finding import Finding
from ..model.plan import Plan
from ..shelf import Entry, Shelf
from . import source as sources
from . import suppression
from .problem import Problem
from .program import Program

PER_RULE = 20
"""Hits of one rule shown per file: the rest would say the same."""

SCOPES = ("file", "any", "contract", "plan")
"""What a program rule needs: any file, a parsed program or model, a program of ours, or a plan to compare with."""

PROGRAM_RULES = Shelf(
    "worldwright.lint.rules.program",
    requires={"SEVERITY": str, "SCOPE": str, "GOOD": tuple, "BAD": tuple, "check": FunctionType},
)
PLAN_RULES = Shelf(
    "worldwright.lint.rules.plan",
    requires={"SEVERITY": str, "GOOD": tuple, "BAD": tuple, "check": FunctionType},
)


@cache
def program_rules() -> tuple[Entry, ...]:
    """Every program rule, by code."""
    return tuple(PROGRAM_RULES.values())


@cache
def plan_rules() -> tuple[Entry, ...]:
    """Every plan rule, by code."""
    return tuple(PLAN_RULES.values())


def check_source(source: sources.Source, plan: Plan | None = None, contract: bool | None = None) -> list[Finding]:
    """Findings of every program rule that applies, in the order of the lines."""
    program = Program(source, plan, contract)
    answered = suppression.read(source.text) if source.tree is not None else ()
    found: list[Finding] = []
    for rule in program_rules():
        if applies(rule, program):
            found += findings(rule, rule.check(program), source.path, answered)
    return in_order(found)


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
            message=f"{more} more of the same",
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


def check_program_file(path: Path, plan: Plan | None, contract: bool | None = None) -> list[Finding]:
    """Findings on one file."""
    return check_source(sources.read(path), plan, contract)
