"""`worldwright build plan.md`: from a plan to an accepted world, without a language model.

The steps are the servers' own tools in the order of the gates; nothing here can do what a tool would refuse. A build
stops at the first step that says no, prints what to do next, and picks up there when it is called again: passes that
already succeeded for the same program and plan are answered from their evidence.
"""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import click

from worldkit.files import write_atomic

from .model import approval, imported
from .model.errors import GateError, JobError, WorldwrightError
from .model.evidence import PASSES
from .model.progress import Progress
from .model.run import Run, sha256_file


@dataclass(frozen=True)
class Options:
    """What the person at the command line allows the build to do on their behalf."""

    approve: bool = False
    """Approve the plan in their name."""
    auto: bool = False
    """Approve in auto mode: inferred values must be marked in the plan."""
    accept: bool = False
    """Review by measurement and stamp, when every objective is proved."""


class Stopped(Exception):  # noqa: N818 - an outcome, not an error: the build cannot go on by itself
    """The build stopped at a step that answered no."""

    def __init__(self, cause: str, next_move: str = "", details: str = "") -> None:
        super().__init__(cause)
        self.cause = cause
        self.next_move = next_move
        self.details = details


Step = tuple[str, Callable[[Progress], str]]


def steps(run: Run, options: Options) -> Iterator[Step]:
    """The build's steps in order: a name, and an action that returns one line about what it did."""
    yield "plan", lambda _: _check_plan(run)
    yield "place", lambda _: _place(run)
    yield "approve", lambda _: _approve(run, options)
    yield "draft", lambda _: _draft(run)
    yield "lint", lambda _: _lint(run)
    for stage in PASSES:
        yield stage, partial(_stage, run, stage)
    yield "scan", lambda _: _scan(run)
    yield "expect", lambda _: _expect(run)
    if options.accept:
        yield "causes", lambda progress: _causes(run, progress)
        yield "review", lambda _: _review(run)
        yield "accept", lambda _: _accept(run)


def _check_plan(run: Run) -> str:
    from .lint.tools import check_plan

    report = check_plan(run.plan)
    if not report.ok:
        raise Stopped("the plan has problems", f"edit {run.plan}, then build again", _lines(report.findings))
    return f"{report.rules} rules" + (f", {len(report.findings)} remarks" if report.findings else "")


def _place(run: Run) -> str:
    from .place.tools import check, resolve

    placed = resolve(run.plan)
    if not placed.ok:
        raise Stopped("the layout cannot be resolved", f"edit {run.plan}, then build again", _lines(placed.findings))
    checked = check(run.plan)
    if not checked.ok:
        raise Stopped("the layout does not hold", f"edit {run.plan}, then build again", _lines(checked.findings))
    return f"{len(placed.objects)} objects"


def _approve(run: Run, options: Options) -> str:
    from .stamp.tools import approve

    if approval.standing(run.entries(), sha256_file(run.plan), approval.model_hashes(run)) is not None:
        return "already approved"
    if not (options.approve or options.auto):
        raise Stopped(
            "the plan is not approved",
            f"read {run.plan}, then `worldwright stamp approve {run.folder}` (or build again with --approve)",
        )
    approve(str(run.folder), by="command line", auto=options.auto and not options.approve)
    return "approved at the command line"


def _draft(run: Run) -> str:
    from .draft.writing import write_program

    written = write_program(run)
    if written.outcome == "kept":
        return "kept simulation.py as its author left it"
    if written.outcome == "written" and written.open_places:
        raise Stopped(
            "the draft leaves places to its author",
            f"write what is marked AUTHOR in {run.program}, then build again",
            "\n".join(f"- {place}" for place in written.open_places),
        )
    return "unchanged" if written.outcome == "unchanged" else f"{written.lines} lines"


def _lint(run: Run) -> str:
    from .lint.tools import check_program

    report = check_program([run.program], plan=run.plan)
    if not report.ok:
        raise Stopped("the program has problems", f"edit {run.program}, then build again", _lines(report.findings))
    return f"{report.rules} rules" + (f", {len(report.findings)} remarks" if report.findings else "")


def _stage(run: Run, stage: Any, progress: Progress) -> str:
    from .stage.tools import start, wait

    began = time.monotonic()
    job = start(str(run.folder), stage=stage)
    while job.state in ("queued", "running"):
        job = wait(str(run.folder), job=job.job, timeout_s=30, progress=progress)
    if job.state != "succeeded":
        raise JobError(
            job.message or f"the {stage} pass {job.state}",
            code=job.code,
            place=job.place,
            next_move=job.next_move or f"worldwright stage log {run.folder}",
        )
    if job.cached:
        return "from its evidence"
    return f"{time.monotonic() - began:.1f} s"


def _scan(run: Run) -> str:
    from .scan.tools import scan

    report = scan(str(run.folder))
    if not report.ok:
        raise Stopped("the motion is not plausible", f"edit {run.program} or {run.plan}", _lines(report.anomalies))
    return f"{sum(c.status != 'skipped' for c in report.checks)} checks, {len(report.anomalies)} remarks"


def _expect(run: Run) -> str:
    from .scan.tools import expect

    report = expect(str(run.folder))
    proved = sum(o.status == "proved" for o in report.objectives)
    if any(o.status == "refuted" for o in report.objectives):
        details = "\n".join(
            f"- {o.claim}\n" + "\n".join(f"    {e.name}: {e.message}" for e in o.expectations if e.status != "holds")
            for o in report.objectives
            if o.status == "refuted"
        )
        raise Stopped("the world does not do what the plan claims", f"edit {run.program} or {run.plan}", details)
    return f"{proved} of {len(report.objectives)} objectives proved by measurement"


def _causes(run: Run, progress: Progress) -> str:
    from .scan.tools import scan
    from .stamp.tools import status

    step = next(s for s in status(str(run.folder)).steps if s.name == "causes")
    if not step.holds:
        while (report := scan(str(run.folder), causes=True, progress=progress)).pending:
            pass
        found = report.causes.anomalies if report.causes else ()
        if any(a.severity == "blocking" for a in found):
            raise Stopped("an effect does not come from its cause", f"edit {run.program} or {run.plan}", _lines(found))
        step = next(s for s in status(str(run.folder)).steps if s.name == "causes")
    return step.detail


def _review(run: Run) -> str:
    from .stamp import measured
    from .stamp.tools import describe, review

    describe(str(run.folder), measured.describe(run))
    verdict = measured.review(run)
    review(str(run.folder), verdict)
    if verdict.outcome != "pass":
        raise Stopped(
            f"measurement alone cannot accept this world: {verdict.repair or verdict.plan}",
            f"a person or an agent reviews it: `worldwright stamp review {run.folder} @verdict.json`",
        )
    return f"{len(verdict.objectives)} objectives met"


def _accept(run: Run) -> str:
    from .stamp.tools import accept

    if (run.accepted / "stamp.json").is_file():
        from .stamp.tools import status

        if status(str(run.folder)).state == "accepted":
            return "already accepted"
    accept(str(run.folder))
    return f"stamped in {run.accepted}"


def _lines(findings: Any) -> str:
    return "\n".join(str(finding) for finding in findings)


@contextmanager
def _listener() -> Iterator[Progress]:
    """A progress bar on a terminal, silence elsewhere."""
    from .model.progress import silent

    with ExitStack() as stack:
        if sys.stderr.isatty():
            from .report.progress import bar

            yield stack.enter_context(bar())
        else:
            yield silent


def build(run: Run, options: Options, say: Callable[[str, str, str], None]) -> bool:
    """Run every step, telling `say(step, outcome, detail)`; True when none said no. Always writes the report."""
    succeeded = True
    try:
        for name, action in steps(run, options):
            try:
                with _listener() as progress:
                    detail = action(progress)
            except Stopped as stop:
                say(name, "stopped", "\n".join(t for t in (stop.cause, stop.details, f"next: {stop.next_move}") if t))
                succeeded = False
                break
            except WorldwrightError as error:
                details = _lines(getattr(error, "findings", ()))
                say(name, "stopped", f"{details}\n{error}" if details else str(error))
                succeeded = False
                break
            say(name, "done", detail)
    finally:
        from .report import write

        say("report", "done", str(write(run)))
    return succeeded


@click.command("build")
@click.argument("plan", type=click.Path(path_type=Path))
@click.option("--run", "folder", type=click.Path(path_type=Path), help="Build here instead of beside the plan.")
@click.option("--approve", is_flag=True, help="You have read the plan: approve it.")
@click.option("--auto", is_flag=True, help="Approve in auto mode; every inferred value must be marked in the plan.")
@click.option("--accept", is_flag=True, help="Review by measurement and stamp the world if every objective is proved.")
def command(plan: Path, folder: Path | None, approve: bool, auto: bool, accept: bool) -> None:
    """Plan in, accepted world out: resolve, draft, lint, run, scan, review, stamp."""
    from rich.console import Console

    from .cli import report_errors

    console = Console(highlight=False, soft_wrap=True)

    def say(name: str, outcome: str, detail: str) -> None:
        mark = "[green]✓[/]" if outcome == "done" else "[red]✗[/]"
        head, *rest = detail.splitlines() or [""]
        console.print(f"{mark} {name:<8} ", end="")
        console.print(head, markup=False)
        for line in rest:
            console.print(f"           {line}", markup=False)

    def work() -> bool:
        run = Run.find(plan)
        if folder is not None and folder.resolve() != run.folder:
            run = _copy(run, folder)
        return build(run, Options(approve, auto, accept), say)

    sys.exit(0 if report_errors(work) else 1)


def _copy(source: Run, folder: Path) -> Run:
    """Start a run elsewhere from a plan, or go on with the one started from this plan; never overwrite another."""
    target = Run(folder)
    origin = sha256_file(source.plan)
    if target.plan.is_file():
        ours = {e.get("origin_sha256") for e in target.entries() if e.get("action") == "plan"}
        if origin in ours or sha256_file(target.plan) == origin:
            return target
        raise GateError(
            "this folder holds a run of another plan",
            place=str(target.plan),
            next_move=f"go on with that one (`worldwright build {target.plan}`), or name an empty folder",
        )
    target.folder.mkdir(parents=True, exist_ok=True)
    for path in (source.prompt, source.plan):
        if path.is_file():
            write_atomic(target.folder / path.name, path.read_bytes())
    for name, content in imported.beside(source.folder).items():
        write_atomic(target.folder / name, content)
    target.log("build", "plan", origin_sha256=origin)
    return target
