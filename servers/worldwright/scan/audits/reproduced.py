"""Whether the report of an audit is what its repetitions show: judged again from their kept recordings; nothing is simulated.

A report is a file, and the line of the journal that vouches for it can be written by whoever writes the file. Its repetitions
lie beside it as passes of the same key (`physics@<variant>/`).
"""

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from ...model.evidence.audits import CausesReport, RefineReport, RobustReport, Trial
from ...model.evidence.run import Run
from ...model.frozen import Frozen
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory
from ...model.recording.trajectory_files import read_trajectory
from ..anomalies.sign import Context
from . import acting, robustness
from .causes import Causes
from .refine import FACTOR, refine
from .switches import Switches
from .trials import LIMITS, Trials, label_of, variant_name

FINER = ("--time-step-factor", f"{FACTOR:g}")
CLOSE = 1e-6
"""Relative difference of numbers that another machine's last digits may leave."""
_NUMBER = re.compile(r"[-+]?\d[\d.e+-]*")
Report = CausesReport | RobustReport | RefineReport


def unlike(run: Run, plan: Plan | None, trajectory: Trajectory, said: Mapping[str, Report]) -> Iterator[str]:
    """A sentence for each report, by its name, that the recording and its kept repetitions do not show."""
    for name, report in said.items():
        if plan is None or report.trajectory_sha256 != trajectory.sha256:
            yield f"{name}.json is of another recording"
        elif why := _why(run, plan, trajectory, report):
            yield f"{name}.json {why}"


def _why(run: Run, plan: Plan, trajectory: Trajectory, report: Report) -> str:
    trials = Trials(run)
    if isinstance(report, RefineReport):
        finer = trials.ask(*FINER)
        if not report.refined_sha256:  # it says itself that nothing was shown
            return ""
        if missing := _fill(trials, ()):
            return missing
        return _apart(report, refine(trajectory, trials.made[finer], plan, ""))
    if isinstance(report, RobustReport):
        robustness.ask(trials)
        return _fill(trials, report.worlds) or _apart(report, robustness.report(trajectory, plan, trials))
    if label_of(FINER) in {row.label for row in report.trials}:  # asked for in the same call, and listed with them
        trials.ask(*FINER)
    acted = acting.report(trajectory, Context.of(plan), ()).acting
    singly = Switches(trajectory, plan, acted).made_singly(row.label for row in report.trials)
    causal = Causes(trajectory, plan, acted, trials, singly)
    causal.plan_trials()
    return _fill(trials, report.trials) or _apart(report, causal.report())


def _fill(trials: Trials, told: tuple[Trial, ...]) -> str:
    """Lay the kept recordings into `trials`; which one is missing, of those that the report does not call failed."""
    from ...stage.tools import variant_folder

    failed = {row.label: row.failed for row in told if row.failed}
    for label in trials.words:
        folder = variant_folder(trials.run, variant_name(label))
        if folder is not None:
            trials.made[label] = read_trajectory(folder / "trajectory")
        elif label in failed:
            trials.failed[label] = failed[label]
            if failed[label].partition(":")[0] in LIMITS:
                trials.limited.add(label)
        else:
            return f"is told, not shown: of the repetition `{label}` there is no recording of this key"
    return ""


def _apart(said: Frozen, shown: Frozen) -> str:
    return apart(said.model_dump(mode="json"), shown.model_dump(mode="json"))


def apart(said: Any, shown: Any) -> str:
    """The first place where two reports, as JSON has them, differ by more than another machine's last digits, as a clause."""
    for place, one, other in _differences(said, shown, ""):
        return f"says {place or 'this'} is {str(one)[:80]}, and its repetitions show {str(other)[:80]}"
    return ""


def _differences(said: Any, shown: Any, place: str) -> Iterator[tuple[str, Any, Any]]:
    """Where two reports differ: numbers by more than `CLOSE`, and texts by more than the numbers in them."""
    if isinstance(said, dict) and isinstance(shown, dict) and said.keys() == shown.keys():
        for key in said:
            yield from _differences(said[key], shown[key], f"{place}.{key}".lstrip("."))
    elif isinstance(said, list) and isinstance(shown, list) and len(said) == len(shown):
        for number, (one, other) in enumerate(zip(said, shown, strict=True)):
            yield from _differences(one, other, f"{place}[{number}]")
    elif not _alike(said, shown):
        yield place, said, shown


def _alike(said: Any, shown: Any) -> bool:
    if isinstance(said, float) and isinstance(shown, int | float):
        return math.isclose(said, shown, rel_tol=CLOSE, abs_tol=CLOSE)
    if isinstance(said, str) and isinstance(shown, str):
        return said == shown or (" " in said and _NUMBER.sub("#", said) == _NUMBER.sub("#", shown))
    return bool(said == shown)
