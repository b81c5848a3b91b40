"""`worldwright go RUN` takes a run as far as it comes without a decision, with `--accept` from a plan to an accepted world.

The walk is `stamp.going`, which is also the tool `stamp.go`; here the person at the command line may add their word to it. It
stops at the first group of steps that says no, tells all of it and what to do next, and goes on there when it is called again.
"""

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import click

from worldkit.files import write_atomic

from .model.errors import GateError
from .model.evidence import came
from .model.evidence.build_steps import StepName
from .model.evidence.run import Run, sha256_file
from .model.plan import taken_along
from .model.progress import Progress
from .stamp.going import FOR_EVER_S, GROUPS, Going, Say
from .stamp.halts import WrongError

STEPS = [name for group in GROUPS for name in group]


@dataclass(frozen=True)
class Options:
    """The decisions that the person at the command line gives in advance."""

    approve: bool = False
    """Approve the plan in their name."""
    auto: bool = False
    """Approve in auto mode: inferred values must be marked in the plan."""
    accept: bool = False
    """Review by measurement and stamp, when every objective is proved."""
    refine: bool = False
    """Also repeat the physics at half the time step."""
    until: StepName | None = None
    """End after the group of this step."""
    timeout_s: float = FOR_EVER_S
    """Return after about this long, s."""
    memory_mb: int = 4096
    """Resident memory limit of each pass that is started, MiB."""


class Accepting(Going):
    """A walk up to the stamp, which describes and reviews by measurement."""

    groups = (*GROUPS, ("describe",), ("review",), ("accept",))
    attended = False

    def describe(self) -> str:
        """Describe by counted pixels, in place of somebody who looks."""
        from .stamp import by_measurement
        from .stamp.tools import describe

        with came.entered(came.Came(how="automation")):
            description = by_measurement.describe(self.run)
            describe(self.name, description)
        return f"by {description.author}"

    def review(self) -> str:
        """Review: pass only if every objective is proved."""
        from .stamp import by_measurement
        from .stamp.tools import review

        with came.entered(came.Came(how="automation")):
            verdict = by_measurement.review(self.run)
            review(self.name, verdict)
        if verdict.outcome != "pass":
            raise WrongError(
                (
                    f"measurement alone cannot accept this world: {verdict.repair or verdict.plan}",
                    f"a person or an agent reviews it: `worldwright stamp review {self.run.folder} @verdict.json`",
                )
            )
        return f"{len(verdict.objectives)} objectives met"

    def accept(self) -> str:
        """Accept the run and write its stamp."""
        from .stamp.tools import accept

        if self.step("accept").holds:
            return "already accepted"
        while not accept(self.name, timeout_s=600).ok:
            pass
        return f"stamped in {self.run.accepted}"


def go(run: Run, options: Options, say: Say) -> bool:
    """Walk along a run and tell `say(step, outcome, detail)`; returns whether it ends well. The report is always written."""

    def grant() -> str:
        from .contract import harnesses
        from .stamp.tools import approve

        with came.entered(came.by_command(harnesses.around()) if options.approve else came.Came(how="automation")):
            approve(str(run.folder), by="command line", auto=options.auto and not options.approve)
        return "approved at the command line"

    from .stage.warm import kept_warm

    kept_warm.keep()
    walk = Accepting if options.accept else Going
    allowed = grant if options.approve or options.auto else None
    try:
        with _listener() as progress:
            gone = walk(
                run,
                timeout_s=options.timeout_s,
                refine=options.refine,
                until=options.until,
                approve=allowed,
                say=say,
                progress=progress,
                memory_mb=options.memory_mb,
            ).go()
        for running in gone.under_way:
            say("running", "waiting", running)
        if gone.under_way or (gone.ok and options.until):
            say("next", "waiting", gone.next_move)
        return gone.ok and (options.until or walk.groups[-1][-1]) in gone.held
    except KeyboardInterrupt:
        for line in _goes_on(run):
            say("running", "waiting", line)
        raise
    finally:
        from .report import write

        say("report", "done", str(write(run)))


def _goes_on(run: Run) -> Iterator[str]:
    """What a walk that was interrupted leaves at work: jobs outlive whoever asked for them, so that nothing is paid twice."""
    from .stage.job import Job

    still = [job for job in Job.all(run) if not job.read().ended]
    for job in still:
        yield f"{job.read().text().splitlines()[0]}\nit goes on; `worldwright stage cancel {run.folder} --job {job.folder.name}` ends it"


@contextmanager
def _listener() -> Iterator[Progress]:
    """A progress bar on a terminal, silence elsewhere."""
    from .model.progress import silent

    with ExitStack() as stack:
        if sys.stderr.isatty():
            from .report.bar import bar

            yield stack.enter_context(bar())
        else:
            yield silent


@click.command("go")
@click.argument("run", type=click.Path(path_type=Path))
@click.option("--run", "folder", type=click.Path(path_type=Path), help="Go there instead of beside the plan.")
@click.option("--approve", is_flag=True, help="You have read the plan: approve it.")
@click.option("--auto", is_flag=True, help="Approve in auto mode; every inferred value must be marked in the plan.")
@click.option("--accept", is_flag=True, help="Review by measurement and stamp the world if every objective is proved.")
@click.option("--refine", is_flag=True, help="Also repeat the physics at half the time step.")
@click.option("--until", type=click.Choice(STEPS), help="End after this step's group: `expect` draws no film yet.")
@click.option(
    "--timeout-s",
    type=click.FloatRange(min=0.0),
    default=FOR_EVER_S,
    show_default="none",
    help="Return after about so many seconds; the work goes on, call again.",
)
@click.option(
    "--memory-mb",
    type=click.IntRange(min=64),
    default=4096,
    show_default=True,
    help="Resident memory limit of each pass.",
)
def command(
    run: Path,
    folder: Path | None,
    approve: bool,
    auto: bool,
    accept: bool,
    refine: bool,
    until: StepName | None,
    timeout_s: float,
    memory_mb: int,
) -> None:
    """Advance a run (its folder, or a plan.md) as far as it goes without a decision; tell all that is wrong together."""
    from rich.console import Console

    from .cli import report_errors

    console = Console(highlight=False, soft_wrap=True)
    marks = {"done": "[green]✓[/]", "waiting": "[yellow]·[/]"}

    def say(name: str, outcome: str, detail: str) -> None:
        head, *rest = detail.splitlines() or [""]
        console.print(f"{marks.get(outcome, '[red]✗[/]')} {name:<8} ", end="")
        console.print(head, markup=False)
        for line in rest:
            console.print(f"           {line}", markup=False)

    def work() -> bool:
        found = Run.find(run)
        if folder is not None and folder.resolve() != found.folder:
            found = started_from(found, folder)
        return go(found, Options(approve, auto, accept, refine, until, timeout_s, memory_mb), say)

    sys.exit(0 if report_errors(work) else 1)


def started_from(source: Run, folder: Path) -> Run:
    """Start a run elsewhere from a plan, or continue the one started from it; another run is never overwritten."""
    target = Run(folder)
    origin = sha256_file(source.plan)
    if target.plan.is_file():
        ours = {e.get("origin_sha256") for e in target.entries() if e.get("action") == "plan"}
        if origin in ours or sha256_file(target.plan) == origin:
            return target
        raise GateError(
            "this folder holds a run of another plan",
            place=str(target.plan),
            next_move=f"go on with that one (`worldwright go {target.plan}`), or name an empty folder",
        )
    target.folder.mkdir(parents=True, exist_ok=True)
    for path in (source.prompt, source.plan):
        if path.is_file():
            write_atomic(target.folder / path.name, path.read_bytes())
    for name, content in taken_along.of(source.folder).items():
        write_atomic(target.folder / name, content)
    target.log("build", "plan", origin_sha256=origin)
    return target
