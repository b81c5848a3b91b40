"""Parts of the reports of the audits, each with the few repetitions that it rests on: simulated again, they must show what it says.

A kept recording of a repetition can be written by whoever writes the report (`reproduced` judges from those). Here nothing is
believed but what is simulated now, of a run whose physics pass was proved.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from ...model.evidence.audits import Acting, CausesReport, HelperResult, RefineReport, RobustReport, Trial
from ...model.evidence.run import Run
from ...model.frozen import Frozen
from ...model.plan.committed import Plan
from ...model.progress import Progress, silent
from ...model.recording.trajectory import Trajectory
from ..anomalies.sign import Context
from ..objectives import expecting
from . import acting, robustness
from .causes import Causes
from .refine import refine
from .reproduced import FINER, Report, apart
from .switches import Switches
from .trials import LIMITS, Trials, label_of

Rows = tuple[Any, Any]
"""What the report says, and what the repetitions show, as JSON has it."""


@dataclass(frozen=True)
class Part:
    """One part of a report."""

    name: str
    trials: Trials
    """The repetitions that it rests on, none of them made yet."""
    told: tuple[Trial, ...]
    """What the report says of them."""
    rows: Callable[[], Rows]
    """Compares, once they are made."""
    outcome: tuple[str, ...] = ()
    """The fields that must be the same elsewhere, too, where every number may be another; empty: all."""


def parts(
    run: Run, plan: Plan, trajectory: Trajectory, said: Mapping[str, Report], *, whole: bool = False
) -> list[Part]:
    """The parts of some reports, by what the plan asks for and not by what they tell, of a run with a recording.

    With `whole` they are all that the reports say. Else what rests on the repetitions of all causes (the triggers) is in none.
    """
    found: list[Part] = []
    for report in said.values():
        if isinstance(report, CausesReport):
            found += (
                _of_causes(run, plan, trajectory, report) if not whole else [_all_causes(run, plan, trajectory, report)]
            )
        elif isinstance(report, RobustReport):
            found += (
                _of_robust(run, plan, trajectory, report) if not whole else [_all_robust(run, plan, trajectory, report)]
            )
        elif report.refined_sha256:  # else it says itself that nothing was shown
            found.append(_of_refine(run, plan, trajectory, report))
    return found


def made(part: Part, memory: Path, timeout_s: float, progress: Progress = silent) -> bool:
    """Simulate the repetitions of a part; False when they need longer, and another call goes on."""
    part.trials.memory = memory
    part.trials.__post_init__()
    return part.trials.collect(timeout_s, progress)


def unlike(part: Part, *, exact: bool) -> str:
    """How what a report says differs from what its repetitions show now; empty when it does not.

    Args:
        part: whose repetitions were made.
        exact: this is the machine and the build that made the report: all must be the same, hashes too. Else the outcome.
    """
    before = {row.label: row for row in part.told}
    for row in part.trials.told():
        other = before.get(row.label)
        if other is None:
            return f"tells nothing of the repetition `{row.label}`"
        codes = [one.failed.partition(":")[0] for one in (other, row)]
        if codes[0] in LIMITS:  # a machine's limit kept it from being shown there: what follows from that must be said
            part.trials.made.pop(row.label, None)
            part.trials.failed[row.label] = other.failed
            part.trials.limited.add(row.label)
            continue
        if codes[0] != codes[1]:
            return f"says of `{row.label}`: {codes[0] or 'it ran'}, and here: {codes[1] or 'it ran'}"
        if row.failed:
            part.trials.failed[row.label] = other.failed  # in whatever words, and of whatever folder
        elif exact and other.trajectory_sha256 != row.trajectory_sha256:
            return f"says `{row.label}` moved as {other.trajectory_sha256[:16]}, and it moves as {row.trajectory_sha256[:16]}"
    said, shown = part.rows()
    if not exact:
        keys = part.outcome
        said, shown = ({key: row[key] for key in keys} if keys and row else row for row in (said, shown))
    return apart(said, shown)


def unmade(part: Part) -> str:
    """Why a repetition says nothing here, where the machine's room or somebody stopped it; empty when none was."""
    failed = part.trials.failed
    return next((f"`{label}`: {failed[label]}" for label in part.trials.limited if label in failed), "")


def _of_causes(run: Run, plan: Plan, trajectory: Trajectory, report: CausesReport) -> Iterator[Part]:
    acted = acting.report(trajectory, Context.of(plan), ()).acting
    for index, objective in enumerate(plan.objectives):
        for cause in objective.cause:
            causal = _fresh(run, plan, trajectory, acted, report)
            causal.ask(cause)
            said = next((c for c in report.causes if (c.objective, c.cause) == (index, cause)), None)
            rows = partial(_compared, said, partial(causal.cause, index, cause))
            yield Part(f"causes: {cause} of objective {index}", causal.trials, report.trials, rows, ("outcome",))
    for words, acts in _fresh(run, plan, trajectory, acted, report).switches.groups():
        causal = _fresh(run, plan, trajectory, acted, report)
        causal.trials.ask(*words)
        named = [(row.kind, row.target) for row in acts]
        told = [h for h in report.helpers if (h.kind, h.target) in named]
        helped = partial(_helped, told, partial(causal.helpers, words, acts))
        name = f"causes: without {', '.join(f'the {kind} on {target}' for kind, target in named)}"
        yield Part(name, causal.trials, report.trials, helped, ("needed_by",))


def _helped(said: list[HelperResult], show: Callable[[], tuple[HelperResult, ...]]) -> Rows:
    """The rows that one repetition speaks of, and which claims need each."""
    found = [{"rows": [_json(h) for h in rows], "needed_by": [h.needed_by for h in rows]} for rows in (said, show())]
    return found[0], found[1]


def _compared(said: Frozen | None, show: Callable[[], Frozen]) -> Rows:
    return (None if said is None else _json(said)), _json(show())


def _all_causes(run: Run, plan: Plan, trajectory: Trajectory, report: CausesReport) -> Part:
    causal = _fresh(run, plan, trajectory, acting.report(trajectory, Context.of(plan), ()).acting, report)
    if label_of(FINER) in {row.label for row in report.trials}:  # asked for in the same call, and listed with them
        causal.trials.ask(*FINER)
    causal.plan_trials()

    def rows() -> Rows:
        said, shown = _json(report), _json(causal.report())
        for row in (said, shown):
            row["outcomes"] = [(c["objective"], c["cause"], c["outcome"]) for c in row["causes"]]
            row.pop("trials")  # compared by themselves
        return said, shown

    return Part("causes", causal.trials, report.trials, rows, ("outcomes",))


def _fresh(run: Run, plan: Plan, trajectory: Trajectory, acted: tuple[Acting, ...], report: CausesReport) -> Causes:
    singly = Switches(trajectory, plan, acted).made_singly(row.label for row in report.trials)
    return Causes(trajectory, plan, acted, Trials(run), singly)


def _of_robust(run: Run, plan: Plan, trajectory: Trajectory, report: RobustReport) -> Iterator[Part]:
    for words in robustness.WORLDS:
        trials = Trials(run)
        rows = partial(_one_world, plan, trajectory, report, trials, trials.ask(*words))
        yield Part(f"robust: {label_of(words)}", trials, report.worlds, rows, ("worlds", "held"))


def _one_world(plan: Plan, trajectory: Trajectory, report: RobustReport, trials: Trials, label: str) -> Rows:
    """With what one world shows, and every count as it follows from what the report lists of the others."""
    failed = trials.failed.get(label, "")
    there = {label: expecting.expect(trials.made[label], plan)} if label in trials.made else {}
    lost = {label: failed} if failed.startswith(robustness.DIVERGED) else {}
    diverged = [w.label for w in report.worlds if w.failed.startswith(robustness.DIVERGED)]
    known = [w.label for w in report.worlds if not w.failed] + diverged  # in the order of `not_in`
    claims = []
    for number, here in enumerate(robustness.claims(expecting.expect(trajectory, plan), there, lost)):
        told = report.claims[number] if number < len(report.claims) else here
        unlike = tuple(one for one in known if one in (here if one == label else told).not_in)
        message = "" if not unlike else here.message if unlike[0] == label else told.message
        counted = {"of": len(known), "holds": len(known) - len(unlike), "not_in": unlike}
        claims.append(here.model_copy(update={**counted, "message": message}))
    worlds = tuple(Trial(label=label_of(words)) for words in robustness.WORLDS)
    return _held(report, RobustReport(trajectory_sha256=trajectory.sha256, worlds=worlds, claims=tuple(claims)))


def _all_robust(run: Run, plan: Plan, trajectory: Trajectory, report: RobustReport) -> Part:
    trials = Trials(run)
    robustness.ask(trials)

    def rows() -> Rows:
        return _held(report, robustness.report(trajectory, plan, trials))

    return Part("robust", trials, report.worlds, rows, ("worlds", "held"))


def _held(*reports: RobustReport) -> Rows:
    said, shown = (_json(report) for report in reports)
    for row in (said, shown):
        row["worlds"] = [world["label"] for world in row["worlds"]]  # what became of them is compared by itself
        row["held"] = [(c["objective"], c["name"], c["holds"], c["of"], c["not_in"]) for c in row["claims"]]
    return said, shown


def _of_refine(run: Run, plan: Plan, trajectory: Trajectory, report: RefineReport) -> Part:
    trials = Trials(run)
    finer = trials.ask(*FINER)

    def rows() -> Rows:
        now = refine(trajectory, trials.made.get(finer), plan, trials.failed.get(finer, ""))
        said, shown = _json(report), _json(now)
        for row in (said, shown):
            row["held"] = [(c["objective"], c["name"], c["at_step"], c["at_finer"]) for c in row["claims"]]
        return said, shown

    return Part("refine", trials, (Trial(label=finer, trajectory_sha256=report.refined_sha256),), rows, ("held",))


def _json(row: Frozen) -> Any:
    return row.model_dump(mode="json")
