"""The tools of `scan`: plausibility, expectations, cross-check questions, plots, comparison."""

from collections import Counter
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

from pydantic import Field

from ..expose import reads, several, waits
from ..model.errors import NotFoundError
from ..model.evidence import environment
from ..model.evidence.audits import CausesReport, RefineReport, RobustReport
from ..model.evidence.reports import CheckRun, EvidenceKey, ExpectReport, ScanReport
from ..model.evidence.run import Run
from ..model.finding import Anomaly, AnomalySeverity, by_kind
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture
from ..model.progress import Progress, silent
from .comparing import Comparison, compare_reports
from .query.answered import Answer
from .repeating import begin_robust, repeat_part, trial_parts, unbalanced, unlike_part, without_causes

if TYPE_CHECKING:
    from ..model.plan.committed import Plan
    from ..model.recording.trajectory import Trajectory

__all__ = ["TOOLS", "begin_robust", "repeat_part", "trial_parts", "unbalanced", "unlike_part", "without_causes"]

RunName = Annotated[
    str, Field(description="A run folder or its name; or a recording: a trajectory folder or .npz file.")
]
MOST_TOLD = 20
MOST_MOMENTS = 8
STATUSES = ("proved", "refuted", "visual_only", "unproved")
Window = Annotated[str, Field(description="Seconds, as `START:END`; empty: all of it.")]


class Found(Frozen):
    """One anomaly, in the form that other programs read."""

    check: str
    severity: AnomalySeverity
    body: str
    t_start: float
    t_end: float
    value: float
    threshold: float
    unit: str
    code: str
    message: str


class Scanned(ScanReport):
    """A scan report with a readable text, and with the audits that were asked for."""

    file: str = ""
    """The scanned file or run, as the caller named it."""
    findings: tuple[Found, ...] = ()
    """Every anomaly, in a flat list."""
    skipped: tuple[CheckRun, ...] = ()
    """The checks that this recording could not answer, each with its reason."""
    anomalies: tuple[Anomaly, ...] = Field(default=(), exclude=True)
    code_sha256: str = Field(default="", exclude=True)

    acting: tuple[str, ...] = ()
    """What acted on the state besides the engine, one line each; `interventions.json` has all of it."""
    refine: RefineReport | None = None
    causes: CausesReport | None = None
    robust: RobustReport | None = None
    pending: tuple[str, ...] = ()
    """Repetitions of the physics pass that still run: call again with the same arguments."""

    @property
    def ok(self) -> bool:
        """Whether nothing blocks, and every audit asked for is finished and found nothing."""
        audits = [report.ok for report in (self.refine, self.causes) if report is not None]
        return super().ok and all(audits) and not self.pending

    def text(self) -> str:
        """The report: anomalies first, then what could not be checked."""
        looked = sum(check.status != "skipped" for check in self.checks)
        lines = by_kind(self.anomalies)
        lines += [f"skipped {c.code} {c.name}: {c.reason}" for c in self.checks if c.status == "skipped"]
        blocking = sum(a.severity == "blocking" for a in self.anomalies)
        verdict = "not plausible" if blocking else "plausible"
        lines.append(f"{looked} checks: {verdict}, {blocking} blocking, {len(self.anomalies) - blocking} other")
        lines += [f"acted: {row}" for row in self.acting]
        if self.refine is not None:
            lines += [str(anomaly) for anomaly in self.refine.anomalies]
            same = sum(not claim.artefact for claim in self.refine.claims)
            lines.append(f"at half the time step: {same} of {len(self.refine.claims)} expectations say the same")
        if self.causes is not None:
            lines += [str(anomaly) for anomaly in self.causes.anomalies]
            lines += [f"{c.outcome}: objective {c.objective}: {c.message}" for c in self.causes.causes]
            lines += [f"{t.outcome}: {t.message}" for t in self.causes.triggers]
            lines += dict.fromkeys(h.message for h in self.causes.helpers)  # one repetition speaks of many rows
        if self.robust is not None:
            lines.append(self.robust.text())
        if self.pending:
            lines.append(f"still running: {', '.join(self.pending)}; call again with the same arguments")
        return "\n".join(lines)


class Expected(ExpectReport):
    """An expectation report with a readable text."""

    code_sha256: str = Field(default="", exclude=True)

    def text(self) -> str:
        """The report, one paragraph per objective, with what was measured."""
        lines = []
        for objective in self.objectives:
            lines.append(f"{objective.status.replace('_', ' '):<11} {objective.index}. {objective.claim}")
            for result in objective.expectations:
                unit = "" if result.unit == "1" else f" {result.unit}"
                margin = f" (margin {result.margin:+.3g}{unit})" if result.margin is not None else ""
                lines.append(f"            {result.status:<7} {result.name}: {result.message}{margin}")
            if objective.status in ("visual_only", "unproved"):
                lines.append(f"            {objective.reason}")
        count = Counter(objective.status for objective in self.objectives)
        lines.append(", ".join(f"{count[status]} {status.replace('_', ' ')}" for status in STATUSES if count[status]))
        if count["unproved"]:
            lines.append("unproved blocks acceptance: supply what is missing, or give the claim a `visual_only` reason")
        return "\n".join(lines)


class PlotFacts(Frozen):
    """What a plot shows."""

    quantity: str
    bodies: tuple[str, ...]
    window_s: tuple[float, float] | None
    finding: str = ""
    """The finding that is marked."""

    def text(self) -> str:
        """One line."""
        marked = f", with {self.finding} marked" if self.finding else ""
        return f"{self.quantity} of {', '.join(self.bodies) or 'the bodies that move most'}{marked}"


@several("run")
@waits("timeout_s")
def scan(
    run: RunName,
    refine: Annotated[bool, Field(description="Also repeat the physics at half the time step.")] = False,
    causes: Annotated[bool, Field(description="Also take each declared cause away, and weaken it.")] = False,
    robust: Annotated[bool, Field(description="Also vary friction, masses, start and step a little.")] = False,
    timeout_s: Annotated[float, Field(description="Return after so many seconds.", ge=0, le=42)] = 40,
    progress: Progress = silent,
) -> Scanned:
    """Look for motion that cannot be: jumps, sinking, energy from nowhere, undeclared pushes, bodies that never settle.

    Keeps the report of the current recording as evidence, with the ledger of what acted. Each anomaly names its body,
    its window, what was measured and the threshold; `blocking` ones stand in the way of acceptance. `refine` reports
    claims that the time step decides, `causes` effects that come without their cause or by the clock, `robust` (a remark)
    in how many worlds each claim holds; all repeat the physics pass: while any is `pending`, call again.
    """
    from .anomalies import engine
    from .anomalies.sign import Context

    folder, key, plan, trajectory = _subject(run)
    report = engine.scan(trajectory, Context.of(plan))
    if folder is None or key is None or plan is None:
        if refine or causes or robust:
            raise NotFoundError(
                "a lone recording has no program to repeat", place=run, next_move="name a run folder instead"
            )
        return _scanned(run, report)
    from .audits import running

    report = report.model_copy(update={"code_sha256": environment.checks()})
    folder.keep(key, "scan", report)
    acted = running.interventions(folder, key, plan, trajectory, report)
    folder.log("scan", "scan", key=key.key, ok=report.ok, anomalies=len(report.anomalies))
    audited = running.Audited()
    if refine or causes or robust:
        audited = running.audit(
            folder, key, plan, trajectory, acted,
            refined=refine, causes=causes, robust=robust, timeout_s=timeout_s, progress=progress,
        )  # fmt: skip
    told = (*(row.text for row in acted.standing), *(row.text for row in acted.acting))
    return _scanned(run, report, **audited.model_dump(), acting=told[:MOST_TOLD])


def expect(
    run: RunName,
    plan: Annotated[str, Field(description="For a lone recording: the plan.md whose objectives are measured.")] = "",
) -> Expected:
    """Measure every objective of the plan on the recording: proved, refuted, visual only, or unproved.

    Each expectation reports what was measured, what was expected and the signed margin between them. The report is
    kept as evidence of the current program and plan. A lone recording is measured against the `plan` that is named.
    """
    from .objectives import expecting

    folder, key, own, trajectory = _subject(run)
    if folder is None or key is None or own is None:
        if not plan:
            raise NotFoundError(
                "there is no plan beside this recording",
                place=run,
                next_move="name a plan.md as `plan`, or a run folder instead of the recording",
            )
        from ..model.plan.plan_text import read_plan

        return Expected.model_validate(expecting.expect(trajectory, read_plan(Path(plan)).plan).model_dump())
    if plan:
        raise NotFoundError(
            "a run is measured against its own plan", place=plan, next_move="leave `plan` out, or name the recording"
        )
    report = expecting.expect(trajectory, own).model_copy(update={"code_sha256": environment.checks()})
    folder.keep(key, "expect", report)
    folder.log("scan", "expect", key=key.key, ok=report.ok)
    return Expected.model_validate(report.model_dump())


def _scanned(run: str, report: ScanReport, **more: Any) -> Scanned:
    found = tuple(
        Found(
            check=a.name, severity=a.severity, body=a.body, t_start=a.window_s[0], t_end=a.window_s[1],
            value=a.measured, threshold=a.threshold, unit=a.unit, code=a.code, message=a.message,
        )
        for a in report.anomalies
    )  # fmt: skip
    skipped = [c.model_dump() for c in report.checks if c.status == "skipped"]
    return Scanned.model_validate({**report.model_dump(), **more, "file": run, "findings": found, "skipped": skipped})


@reads
def query(
    run: RunName,
    body: Annotated[str, Field(description="A body's name; `ground` is the world.")],
    window: Window = "",
) -> Answer:
    """Ask what one body did: how far and how fast it moved, when it came to rest, what it touched and with which force.

    Use it to test a visual claim ("the scene is frozen", "the ball went through the wall") against the numbers.
    """
    from .query.questions import answer

    return answer(_subject(run)[3], body, _window(window))


@reads
def plot(
    run: RunName,
    quantity: Annotated[
        Literal["auto", "height", "speed", "spin", "tilt", "position", "energy", "contact_force", "penetration"],
        Field(description="What to plot over time; `auto`: what shows the finding, else the height."),
    ] = "auto",
    bodies: Annotated[list[str], Field(description="Bodies; empty: the finding's, else those that move most.")] = [],  # noqa: B006
    window: Window = "",
    finding: Annotated[
        str, Field(description="A finding of the scan to mark: code or name, `WS105` or `WS105:BODY`.")
    ] = "",
) -> Illustrated:
    """Plot a quantity over time as a picture, with the beginnings of contacts marked.

    With `finding`, its stretch of time and its threshold are marked, and its bodies and surroundings are shown.
    """
    from . import plots
    from .anomalies import engine
    from .anomalies.sign import Context

    _, _, plan, trajectory = _subject(run)
    chosen, shown = None if quantity == "auto" else quantity, _window(window)
    mark = None
    if finding:
        anomaly = plots.choose(engine.scan(trajectory, Context.of(plan)).anomalies, finding)
        mark = plots.mark(trajectory, anomaly, chosen)
        chosen, shown = cast(plots.Quantity, mark.quantity), shown or mark.view_s
    named = tuple(bodies) or (mark.bodies if mark else ())
    picture = plots.draw(trajectory, chosen or "height", named, shown, mark)
    facts = PlotFacts(quantity=chosen or "height", bodies=named, window_s=shown, finding=mark.title if mark else "")
    caption = f"{facts.quantity} over time" + (f"; {mark.title}, {mark.note}" if mark else "")
    return Illustrated(facts, (Picture(picture, caption),))


@reads
def compare(
    run: Annotated[str, Field(description="The run folder or its name.")],
    first: Annotated[str, Field(description="Evidence key of one iteration.")],
    second: Annotated[str, Field(description="Evidence key of the other.")],
) -> Comparison:
    """Say which of two iterations is better, and what got better or worse.

    Fewer blocking anomalies decide first, then objectives, then the margins of the expectations.
    """
    return compare_reports(Run.find(run), first, second)


def argument_problem(name: str, arguments: object) -> tuple[str, str] | None:
    """What is wrong with an expectation's arguments, and the fix; None when they are right or the name is unknown."""
    from .objectives.expecting import argument_problem as judge

    return judge(name, arguments)


def moments(run: Run) -> tuple[tuple[float, str], ...]:
    """(instant in s, name) of each of the plan's expectations that came true, in order; for the storyboard, no tool."""
    from .measuring.measured import UnknowableError
    from .objectives import events
    from .objectives.claims import EXPECTATIONS

    _, _, plan, trajectory = _subject(str(run.folder))
    found: dict[float, str] = {}
    for objective in plan.objectives if plan else ():
        for name, arguments in ((name, given) for row in objective.expect for name, given in row.items()):
            entry = EXPECTATIONS.get(name)
            made_of_events = entry and events.MADE_OF_EVENTS & set(entry.Given.model_fields)
            if entry is None or not entry.EVENT or made_of_events or len(found) >= MOST_MOMENTS:
                continue
            with suppress(UnknowableError):
                if (at := events.moment_s(trajectory, {name: arguments})) is not None:
                    found.setdefault(at, name.replace("_", " "))
    return tuple(sorted(found.items()))


def smallest(run: Run) -> str:
    """What the plan speaks of and is smallest where it is seen largest, over the motion; empty where that is not known.

    For other servers, no tool.
    """
    from ..model.plan.in_view import told
    from .anomalies.in_picture import largest

    _, _, plan, trajectory = _subject(str(run.folder))
    least = min(largest(trajectory, plan), key=lambda seen: seen.pixels, default=None) if plan else None
    return told(least.name, least.pixels, least.camera, plan.recording_mode.size[0]) if plan and least else ""


def finish_robust(run: Run) -> bool:
    """For the process that does it (no tool): see `audits.unasked_audit.finish`; whether anything was done."""
    from .audits import unasked_audit

    _, key, plan, trajectory = _subject(str(run.folder))
    return key is not None and plan is not None and unasked_audit.finish(run, key, plan, trajectory) is not None


def unlike_trials(run: Run, said: dict[str, Any]) -> list[str]:
    """For acceptance (no tool): see `audits.reproduced.unlike`."""
    from .audits import reproduced

    return list(reproduced.unlike(run, *_subject(str(run.folder))[2:], said))


def repair_target(code: str) -> str:
    """What a repair changes where the anomaly check of this code finds something; for other servers, no tool."""
    from .anomalies.engine import CHECKS

    return str(CHECKS[code].REPAIR)


def of_claim(code: str) -> bool:
    """Whether the anomaly check of this code finds fault with what the plan claims as often as with the world; no tool."""
    from .anomalies.engine import CHECKS

    return code in CHECKS and bool(CHECKS[code].OF_CLAIM)


def _subject(run: str) -> "tuple[Run | None, EvidenceKey | None, Plan | None, Trajectory]":
    """The named recording, with the run, key and plan that it belongs to, if any."""
    from ..model.recording.trajectory_files import read_trajectory

    path = Path(run)
    if path.suffix == ".npz" or (path / "meta.json").is_file():
        return None, None, None, read_trajectory(path)
    from ..model.evidence import drawn_stills
    from ..model.plan.plan_text import read_plan

    folder = Run.find(run)
    key = folder.evidence_key(environment.current().sha256())
    recording = folder.evidence(key) / "physics" / "trajectory"
    if not recording.is_dir():
        raise NotFoundError(
            "there is no recording of this program and plan",
            place=str(recording.parent),
            next_move=f"worldwright stage start {folder.folder} --stage physics",
        )
    trajectory = read_trajectory(recording)
    stills = drawn_stills.read(folder, folder.evidence(key), trajectory.sha256)
    return folder, key, read_plan(folder.plan).plan, replace(trajectory, stills=stills) if stills else trajectory


def _window(text: str) -> tuple[float, float] | None:
    if not text.strip():
        return None
    try:
        start, end = (float(part) for part in text.split(":"))
    except ValueError:
        raise NotFoundError(
            f"'{text}' is no window", next_move="write it as START:END in seconds, e.g. 0.5:1.2"
        ) from None
    return start, end


TOOLS = (scan, expect, query, plot, compare)
