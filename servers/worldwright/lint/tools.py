"""The tools of the lint server."""

import time
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from ..expose import reads
from ..model.errors import JobError, NotFoundError, PlanError
from ..model.evidence.reports import EvidenceKey, LintReport
from ..model.finding import Finding
from ..model.plan.committed import Plan
from .completing import Completed
from .report import RuleDoc, RuleList, RuleSummary, ShownReport, capped

WORLD_S, WORLDS_S = 20.0, 35.0
"""Seconds of its own to build one world, and all those of a call; by the clock `model.call_time` ends a client's call."""


@reads
def check_plan(plan: Annotated[Path, Field(description="Path of a plan.md")]) -> ShownReport:
    """May this plan be committed? Checks all thirteen sections and every plan rule (WP…).

    Findings name file, line, section, cause and fix. Numbers must have one owner, objectives need evidence, names must
    exist, steps need complementary cameras. `explain CODE` says more about a rule.
    """
    from . import engine

    committed, found, line_of = _read_plan(plan)
    if committed is not None:
        found += engine.check_plan_rules(committed, str(plan), line_of)
    return ShownReport(findings=capped(found), rules=len(engine.plan_rules()))


def check_program(
    files: Annotated[list[Path], Field(description="Programs (.py) or bare MJCF models (.xml)")],
    plan: Annotated[Path | None, Field(description="Plan to compare with; default: plan.md beside the program")] = None,
    model: Annotated[
        bool | None,
        Field(
            description="Build the world in the sandbox and inspect it (no: only read); default: for programs of ours and MJCF, while plain scripts are watched"
        ),
    ] = None,
    fix: Annotated[bool, Field(description="Apply the safe fixes first, in place")] = False,
) -> ShownReport:
    """May these programs run? Reads them; what they build is compiled in the sandbox and inspected there.

    Names, keywords and MJCF are resolved against the installed MuJoCo; the compiled world is compared with the plan;
    staging, silent mistakes and worlds the engine cannot carry are named. The report on a run's own simulation.py is
    evidence that the physics pass needs. Answer for a finding with `# worldwright: ignore[WL123] reason`.
    """
    from . import engine, fixing

    found: list[Finding] = []
    kept, worlds, fixed = "", [], []
    rules = len(engine.program_rules()) + len(engine.model_rules())
    deadline = time.monotonic() + WORLDS_S
    for file in files:
        if not file.exists():
            raise NotFoundError("there is no such program", place=str(file), next_move="name an existing file")
        beside = file.parent / "plan.md"
        in_run = file.name == "simulation.py" and beside.is_file()
        chosen = plan or (beside if in_run else None)
        evidence = in_run and (plan is None or plan.resolve() == beside.resolve())
        key = _key(file.parent) if evidence else None
        committed, here = None, []
        if chosen is not None:
            committed, here, line_of = _read_plan(chosen)
            if committed is not None:
                faults = engine.check_plan_rules(committed, str(chosen), line_of)
                here += [fault for fault in faults if fault.severity == "error"]
        if fix and (codes := fixing.fix(file, committed, True if chosen else None)):
            fixed.append(f"{file.name}: {len(codes)} safe fix{'es' * (len(codes) > 1)} ({', '.join(codes)})")
            key = _key(file.parent) if evidence else None
        left = min(WORLD_S, deadline - time.monotonic())
        bundle = _bundle(file.parent, key) if key is not None and model is not False else None
        looked, world = engine.check_program_file(file, committed, True if chosen else None, model, left, bundle)
        here += looked
        worlds += [world] if world else []
        if key is not None and key == _key(file.parent):  # if it was edited meanwhile, they fit neither version
            kept = _keep(file.parent, key, here, rules)
        found += here
    return ShownReport(
        findings=capped(found),
        rules=rules,
        files=len(files),
        kept=kept,
        worlds=tuple(worlds),
        fixed=tuple(fixed),
    )


def complete_plan(run: Annotated[str, Field(description="The run folder, or its name")]) -> Completed:
    """Write into plan.md what the program's world has and the plan does not name, marked as built.

    The world is built in the sandbox. Objects, joints, masses, surfaces, and places that the plan leaves to the program become
    rows; what is stated stays as it is, and where the world differs from it, that is a finding. `left` names what no row can say.
    """
    from ..model.evidence.run import Run
    from .completing import complete

    return complete(Run.find(run), WORLD_S)


@reads
def explain(
    code: Annotated[str, Field(description="Code or name of a rule, e.g. WL101, or of any other finding")],
) -> RuleDoc:
    """What a lint rule does, why it matters, what to write instead, and some bad and good cases.

    Codes of place, of the plan reader and of scan are answered with what the skills say of them.
    """
    from . import engine, shown_cases, told_elsewhere

    elsewhere = told_elsewhere.passage(code)
    if elsewhere is not None:
        return elsewhere
    rule = engine.find(code)
    bad, good = shown_cases.shown(rule.BAD, rule.GOOD)
    return RuleDoc(
        code=rule.code,
        name=rule.name,
        severity=rule.SEVERITY,
        summary=rule.summary,
        documentation=rule.doc,
        bad=bad,
        good=good,
    )


@reads
def list_rules() -> RuleList:
    """Every lint rule: code, name, severity and one sentence."""
    from . import engine

    return RuleList(
        rules=tuple(
            RuleSummary(code=rule.code, name=rule.name, severity=rule.SEVERITY, summary=rule.summary)
            for rule in engine.all_rules()
        )
    )


def acts_as_planned(bundle: Path, plan: Plan) -> list[Finding]:
    """Every way in which the world of a bundle (`world.mjz`, or any MJCF) acts otherwise than its plan. For other servers.

    Both worlds are compiled in the sandbox, the plan's from its own draft; nothing of the author's runs. A finding of severity
    `error` means that it is not the planned world.

    Raises:
        JobError: this machine lacks what making the plan's takes, which says nothing of the bundle.
    """
    from concurrent.futures import ThreadPoolExecutor
    from contextvars import copy_context

    from . import engine
    from .compiled import fetch, planned

    with ThreadPoolExecutor(1) as beside:
        waiting = beside.submit(copy_context().run, planned.world, plan)
        outcome = fetch.world(bundle, is_mjcf=True)
    twin = waiting.result()
    if lacked := twin.lacked:
        cause = f"what acts could not be held against the plan, whose world this machine could not make: {lacked[0]}"
        raise JobError(cause, code=twin.failure or twin.status, place="plan.md", next_move=lacked[1])
    if outcome.status == "compiled":
        return engine.check_acting(outcome, twin, plan, bundle.name)
    return [
        Finding(
            code="WM101",
            name="does_not_compile",
            severity="error",
            message=f"the bundle cannot be compiled: {outcome.message or outcome.status}",
            fix="make the physics pass again",
            file=bundle.name,
        )
    ]


def stated_facts(program: Path, defaults: bool = True) -> dict[str, Any]:
    """What a program says of itself in its call of `program.main`; for other servers, no tool: see `lint.main_call`."""
    from . import main_call

    return main_call.facts(program, defaults)


def states_alone(program: Path) -> bool:
    """Whether no other call than that one can be made; for other servers, no tool: see `lint.main_call.sole`."""
    from . import main_call

    return main_call.sole(program)


def _read_plan(path: Path):
    """The plan (None when it cannot be read as one), its findings, and its line look-up."""
    from ..model.plan.plan_text import read_plan

    if not path.is_file():
        raise NotFoundError("there is no such plan", place=str(path), next_move="name an existing plan.md")
    try:
        document = read_plan(path)
    except PlanError as error:
        found = list(error.findings) or [
            Finding(
                code="WP100",
                name="unreadable_plan",
                severity="error",
                message=error.cause,
                fix=error.next_move,
                file=str(path),
            )
        ]
        return None, found, None
    plan: Plan = document.plan
    return plan, [], document.line_of


def _key(folder: Path) -> EvidenceKey:
    """The hashes for which a report on the run's program and plan vouches, as they stand now."""
    from ..model.evidence.environment import current
    from ..model.evidence.run import Run

    return Run(folder).evidence_key(current().sha256())


def _bundle(folder: Path, key: EvidenceKey) -> tuple[Path, float] | None:
    """The world that the run's bundle pass has made already, which is then looked at in place of another build."""
    from ..model.evidence.run import Run
    from .compiled import fetch

    return fetch.bundled(Run(folder), key)


def _keep(folder: Path, key: EvidenceKey, found: list[Finding], rules: int) -> str:
    """Store the report as evidence of the run."""
    from ..model.evidence.run import Run

    run = Run(folder)
    # Files are named relative to the run, so that the evidence says the same wherever the folder lies.
    report = LintReport(
        findings=tuple(f.model_copy(update={"file": Path(f.file).name if f.file else ""}) for f in capped(found)),
        rules=rules,
    )
    path = run.keep(key, "lint", report)
    codes = sorted({finding.code for finding in report.findings if finding.severity == "error"})
    unknown = [code for code in codes if to_look_up(code)]
    run.log("lint", "lint", key=key.key, ok=report.ok, findings=len(report.findings), codes=codes, unknown=unknown)
    return str(path.relative_to(run.folder))


def to_look_up(code: str) -> bool:
    """Whether a finding is about a name that must be looked up before the program runs again; for other servers, no tool."""
    from . import engine

    return engine.to_look_up(code)


check_plan.formats = check_program.formats = ("sarif", "github")  # type: ignore[attr-defined]
TOOLS = (check_plan, check_program, complete_plan, explain, list_rules)
