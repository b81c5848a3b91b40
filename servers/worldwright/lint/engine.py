"""Run the rules of a shelf over a program or a plan."""

import ast
import time
from collections.abc import Iterable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.finding import Finding
from ..model.plan.committed import Plan
from ..shelf import Attribute, Entry, Function, Shelf, failed
from . import source as sources
from . import suppression
from .harm import KINDS
from .problem import NOT_TRIED, Problem
from .program_view import Program

if TYPE_CHECKING:
    from .compiled.fetch import Outcome

PER_RULE = 20
"""A file shows so many findings of one rule: more would say the same."""

MOST_COUNTED = 100
"""So many more are counted: to look up near names for thousands would take long."""

SCOPES = ("file", "any", "contract", "plan", "acts")
"""What a rule needs: any file, a parsed program or model, a program of ours, a plan to compare with, or the world that the
plan's own draft makes."""

_COMMON = {
    "SEVERITY": Attribute(str, "`error`, `warning` or `info`"),
    "GOOD": Attribute(tuple, "cases that the rule must not complain of"),
    "BAD": Attribute(tuple, "cases that it must complain of"),
    "FIXED": Attribute(tuple, "what `--fix` makes of the BAD cases, in their order", ()),
    "EVIDENCE": Attribute(KINDS, "how the harm is shown: `Raises`, `Warns`, `Measured` or `Argued`"),
}
_SCOPE = {"SCOPE": Attribute(str, "what it needs: " + ", ".join(f"`{scope}`" for scope in SCOPES))}
PROGRAM_RULES = Shelf(
    "worldwright.lint.rules.program",
    {
        **_COMMON,
        **_SCOPE,
        "check": Attribute(Function, "(Program) -> the problems of a program"),
        "ABOUT": Attribute(
            str, "`names` of the installed build, its `signatures`, or silent `mistakes` and staging", "mistakes"
        ),
        "LOOK_UP": Attribute(bool, "the name that it finds must be looked up before the program runs again", False),
    },
)
MODEL_RULES = Shelf(
    "worldwright.lint.rules.model",
    {
        **_COMMON,
        **_SCOPE,
        "check": Attribute(Function, "(ModelView) -> the problems of a compiled world"),
        "UNBUILT": Attribute(bool, "it speaks of worlds that could not be built, too", False),
        "NO_TWIN": Attribute(bool, "it speaks where the plan makes no world to compare with, too", False),
    },
)
RUN_RULES = Shelf(
    "worldwright.lint.rules.run",
    {
        **_COMMON,
        "check": Attribute(Function, "(Run) -> the problems of what a program was seen to do"),
        "SAID_BY_NAMES": Attribute(bool, "it is silent on a line of which a rule about names has spoken", False),
    },
)
PLAN_RULES = Shelf(
    "worldwright.lint.rules.plan", {**_COMMON, "check": Attribute(Function, "(PlanView) -> the problems of a plan")}
)
SHELVES = {"program": PROGRAM_RULES, "model": MODEL_RULES, "run": RUN_RULES, "plan": PLAN_RULES}


@cache
def program_rules() -> tuple[Entry, ...]:
    """Every program rule, by code."""
    return tuple(PROGRAM_RULES.values())


@cache
def model_rules() -> tuple[Entry, ...]:
    """Every rule about compiled worlds, by code."""
    return tuple(MODEL_RULES.values())


@cache
def run_rules() -> tuple[Entry, ...]:
    """Every rule about what a program was seen to do, by code."""
    return tuple(RUN_RULES.values())


GROUPS = ("symbols", "mistakes", "model", "run", "plan")


def group(rule: Entry) -> str:
    """The one of `GROUPS` that a rule belongs to."""
    for name, shelf in SHELVES.items():
        if rule.code in shelf.entries and name != "program":
            return name
    return "mistakes" if rule.ABOUT == "mistakes" else "symbols"


def about_names(code: str) -> bool:
    """Whether a code is that of a program rule about names: a program that fails it is not worth building."""
    return code in PROGRAM_RULES.entries and PROGRAM_RULES.entries[code].ABOUT == "names"


def to_look_up(code: str) -> bool:
    """Whether a finding of this code is about a name that must be looked up before the program runs again."""
    return code in PROGRAM_RULES.entries and PROGRAM_RULES.entries[code].LOOK_UP


def find(code: str) -> Entry:
    """A rule of any shelf by code or name; a `NotFoundError` lists the nearest."""
    for shelf in SHELVES.values():
        for key in (code.upper(), code.lower()):
            if key in shelf:
                return shelf[key]
    shelf = {"WP": PLAN_RULES, "WM": MODEL_RULES, "WR": RUN_RULES}.get(code.upper()[:2], PROGRAM_RULES)
    return shelf.find(code)


def all_rules() -> tuple[Entry, ...]:
    """Every rule there is: about programs, compiled worlds, what programs do, plans."""
    return (*program_rules(), *model_rules(), *run_rules(), *plan_rules())


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
            found += findings(rule, program, source.path, answered)
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


def problems(rule: Entry, looked_at: Any) -> Iterator[Problem]:
    """What a rule finds in a program, world or plan; if it fails itself, that is a problem, as grave as what it looks for.

    So a rule that fails never passes for a yes, and the other rules are asked all the same.
    """
    try:
        yield from rule.check(looked_at)
    except Exception as defect:
        yield Problem(
            f"the rule {failed(rule, defect)}", "the other rules were asked; a comment can answer for this one"
        )


def findings(
    rule: Entry, looked_at: Any, file: str, answered: tuple[suppression.Suppression, ...] = ()
) -> Iterator[Finding]:
    """A rule's problems as findings; what a comment answers for becomes information."""
    seen: set[tuple[int | None, str]] = set()
    more = 0
    for problem in problems(rule, looked_at):
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


def law_rows(plan: Plan) -> Iterator[str]:
    """Names of the author's own laws that a plan declares."""
    yield from (row.solver.name for row in plan.simulation_parameters.interventions if row.solver and row.solver.file)


def in_order(found: Iterable[Finding]) -> list[Finding]:
    """Sort by line, column and code; findings without a line come first."""
    return sorted(found, key=lambda f: (f.line or 0, f.column or 0, f.code))


def check_plan_rules(plan: Plan, file: str, line_of=None) -> list[Finding]:
    """Findings of every plan rule; `line_of(section, *path)` places them."""
    from .plan_view import PlanView

    view = PlanView(plan, line_of)
    found: list[Finding] = []
    for rule in plan_rules():
        found += findings(rule, view, file)
    return in_order(found)


def check_world(program: Program, outcome: "Outcome", planned: "Outcome | None" = None) -> list[Finding]:
    """Findings of every model rule on the world that a program makes; `planned` is the world of its plan's draft."""
    from .compiled.view import ModelView

    twin = None if planned is None or program.plan is None else ModelView(planned, None, program.plan)
    view = ModelView(outcome, program, program.plan, twin)
    answered = suppression.of(program.source)
    found: list[Finding] = []
    for rule in model_rules():
        needs_world = not rule.UNBUILT and outcome.status != "compiled"
        if needs_world or (rule.SCOPE == "plan" and program.plan is None) or not comparable(rule, planned):
            continue
        # Only the plan can change what it says: a comment in the program cannot answer for it.
        found += findings(rule, view, program.path, () if rule.SCOPE == "acts" else answered)
    return in_order(found)


def comparable(rule: Entry, planned: "Outcome | None") -> bool:
    """Whether the world that a rule compares with exists."""
    if rule.SCOPE != "acts":
        return True
    return planned is not None and (planned.status == "compiled" or rule.NO_TWIN)


def check_acting(outcome: "Outcome", planned: "Outcome", plan: Plan, file: str = "") -> list[Finding]:
    """Every way in which a compiled world acts otherwise than its plan: a pure function of the two worlds and the plan."""
    from .compiled.view import ModelView

    view = ModelView(outcome, None, plan, ModelView(planned, None, plan))
    found: list[Finding] = []
    for rule in model_rules():
        if rule.SCOPE in ("plan", "acts") and comparable(rule, planned):
            found += findings(rule, view, file)
    return found


LEAST_WALL_S = 2.0


IDLE = (ast.Import, ast.ImportFrom, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
"""Statements that only define something."""


def plain_script(program: Program) -> bool:
    """A program that drives the engine itself, not by worldkit, and does something when it is run."""
    if program.source.is_mjcf or program.source.problem is not None or program.contract:
        return False
    imported = {full.split(".")[0] for table in program.scopes.imports.values() for full in table.values()}
    return "mujoco" in imported and any(
        isinstance(node, ast.Call)
        for statement in program.tree.body
        if not isinstance(statement, IDLE)
        for node in ast.walk(statement)
    )


def check_run(program: Program, path: Path, wall_s: float) -> tuple[list[Finding], str]:
    """Findings on what a program was seen to do in the sandbox, and a few words on how that went."""
    from .observed import observing
    from .observed.run_view import Run

    if wall_s < LEAST_WALL_S:
        return [], f"{path.name}: not run: the call's time went into the files before it"
    seen = observing.observe(path, wall_s)
    if seen.status == "refused":
        return [], f"{path.name}: not run: no sandbox confines here (worldwright doctor says why)"
    run, answered = Run(seen, len(program.lines)), suppression.of(program.source)
    found = [f for rule in run_rules() for f in findings(rule, run, program.path, answered)]
    told = f" ({seen.failure}: {seen.message[:80]})" if seen.status == "cannot" and seen.failure else ""
    words = {"cannot": f"cannot be run here{told}", "timed_out": "watched until the time was up"}
    return (
        found,
        f"{path.name}: {words.get(seen.status, 'run: ' + seen.status)} in {seen.wall_s:.1f} s, sandbox {seen.level}",
    )


def check_film(program: Program, path: Path) -> tuple[list[Finding], str]:
    """Findings on what a film does when it is described and one picture of it is drawn, on the run's recording."""
    from ..stage.tools import try_film
    from .observed.observing import Observation
    from .observed.run_view import Run

    failure = try_film(path.parent)
    if failure is None:
        first = f"`worldwright go {path.parent} --until lint` says what it lacks, then ask again"
        return [], f"{path.name}: {NOT_TRIED}: there is no world of its program and plan yet; {first}"
    if failure.get("code") == "needs_recording":
        where = f"line {failure['line']}: " if failure.get("line") else ""
        said = failure["message"].removeprefix("NeedsRecordingError: ")
        why = f"{where}{said}; that may be the missing motion's, and is tried again on the recording"
        return [], f"{path.name}: tried on the world as it starts, where nothing moves: {why}"
    if not failure:
        return [], f"{path.name}: described and drawn; next: `worldwright stage frames {path.parent} --show shots`"
    line = int(failure.get("line") or 1)
    seen = Observation("failed", (), failure["code"], failure["message"], (line,))
    found = [f for rule in run_rules() for f in findings(rule, Run(seen, len(program.lines)), program.path)]
    fix = failure.get("next_move") or "correct what the message names"
    return [f.model_copy(update={"fix": fix}) for f in found], f"{path.name}: it does not come to a picture"


def check_program_file(
    path: Path,
    plan: Plan | None,
    contract: bool | None = None,
    model: bool | None = None,
    wall_s: float = 20.0,
    bundle: tuple[Path, float] | None = None,
) -> tuple[list[Finding], str]:
    """Findings on one file, and a few words on how building its world went (none if nobody asked for it).

    Args:
        path: program or MJCF file.
        plan: the plan to compare with.
        contract: whether it is a program of ours (None: its imports tell).
        model: whether to build its world in the sandbox (None: for programs of ours and model files).
        wall_s: the most time that building may take, s.
        bundle: the world that this program has built already, as one file, and how long it is simulated, s.
    """
    source, began = sources.read(path), time.monotonic()
    found = check_source(source, plan, contract)
    program = Program(source, plan, contract)
    if program.films:
        tried, said = check_film(program, path) if not found and model is not False else ([], "")
        return in_order([*found, *tried]), said
    if plain_script(program) and model is not False:
        seen, said = check_run(program, path, wall_s)
        told = {f.line for f in found if about_names(f.code) and f.severity == "error"}
        # A rule about names has told it together with the migration: once is enough.
        seen = [f for f in seen if f.line not in told or not RUN_RULES[f.code].SAID_BY_NAMES]
        if model is None:
            return in_order([*found, *seen]), said
        found = in_order([*found, *seen])
    if source.problem is not None or (model is None and not (source.is_mjcf or program.contract)) or model is False:
        return found, ""
    if model is None and any(about_names(f.code) for f in found):  # an author's ignore does not make a name exist
        return found, f"{path.name}: the world is not built until its names are right"
    from .compiled import fetch, law_trial

    if wall_s < LEAST_WALL_S:
        return found, f"{path.name}: the world is not built: the call's time went into the files before it"
    planned = None
    world = partial(fetch.world, path, is_mjcf=source.is_mjcf, wall_s=wall_s)
    if bundle is not None:
        world = partial(fetch.world, bundle[0], is_mjcf=True, wall_s=wall_s, lasting_s=bundle[1])
    if plan is None:
        outcome = world()
    else:
        from .compiled import planned as plans

        outcome, planned = plans.beside(plan, source.text, world, wall_s)
    if outcome.status == "refused":
        return found, f"{path.name}: the world is not built: no sandbox confines here (worldwright doctor says why)"
    if outcome.status == "nothing":
        return found, f"{path.name}: the program makes no world"
    said = f"{path.name}: world {outcome.status.replace('_', ' ')} in {outcome.wall_s:.1f} s, sandbox {outcome.level}"
    price = outcome.pass_s
    found += check_world(program, outcome, planned)
    rehearsed = law_trial.of(path, plan, outcome, found, began + wall_s - time.monotonic())
    beside = rehearsed is None and plan is not None and any(law_rows(plan))
    if beside and bundle is not None and price is not None:  # the file has no laws: they are the program's
        price = fetch.world(path, wall_s=max(LEAST_WALL_S, began + wall_s - time.monotonic())).pass_s
        said += "" if price is not None else "; its laws were not asked in time, so its price is not known"
    if price is not None:
        apart = " without its laws" * bool(rehearsed and bundle)  # a bundle holds none
        said += f"; by its first steps{' and its laws' * beside} the physics{apart} takes about {max(price, 1):.2g} s"
    if rehearsed is not None:
        return in_order([*found, *rehearsed.findings]), f"{said}\n{path.name}: {rehearsed.said}"
    return in_order(found), said
