"""What `scan` does for other servers, which reach it through `scan.tools`; none of it is a tool."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.evidence.run import Run
from ..model.progress import Progress, silent

if TYPE_CHECKING:
    from .audits.repeated import Part


def begin_robust(run: Run) -> str:
    """For the walk of another server: see `audits.unasked_audit.begin`; says in a line how it stands."""
    from ..model.evidence import environment
    from .audits import unasked_audit

    return unasked_audit.begin(run, run.evidence_key(environment.current().sha256()))


def without_causes(run: Run, pass_s: float, within_s: float, left_s: float, progress: Progress = silent) -> list[str]:
    """For the walk of another server: what blocks by the repetitions without each cause alone, one line each.

    They are made only if all of them, as long as the physics pass (`pass_s`, s), take about `within_s` s at most, and are found
    again by the whole audit. Nothing is told of those that are not there after `left_s` s: they go on, and another call finds them.
    """
    from ..model.evidence import drawn_stills, environment
    from ..model.plan.plan_text import read_plan
    from ..model.recording.trajectory_files import read_trajectory
    from ..model.storage import own
    from .anomalies.sign import Context
    from .audits import acting
    from .audits.causes import Causes
    from .audits.trials import AT_ONCE, Trials

    key = run.evidence_key(environment.current().sha256())
    plan, trajectory = read_plan(run.plan).plan, read_trajectory(run.evidence(key) / "physics" / "trajectory")
    stills = drawn_stills.read(run, run.evidence(key), trajectory.sha256)
    trajectory = replace(trajectory, stills=stills) if stills else trajectory
    trials = Trials(run, memory=own(run.folder, run.evidence(key)) / "trials.json")
    causal = Causes(trajectory, plan, acting.report(trajectory, Context.of(plan)).acting, trials)
    if not 0 < causal.ask_without() * pass_s <= AT_ONCE * within_s:
        return []
    return [str(a) for a in causal.wrong_without()] if trials.collect(min(2 * within_s, left_s), progress) else []


def trial_parts(run: Run, recording: Path, said: dict[str, Any], *, whole: bool) -> "list[Part]":
    """The parts of some reports of audits, by name, that can be made again in a run with this recording; see `audits.repeated`."""
    from ..model.plan.plan_text import read_plan
    from ..model.recording.trajectory_files import read_trajectory
    from .audits import repeated

    return repeated.parts(run, read_plan(run.plan).plan, read_trajectory(recording), said, whole=whole)


def repeat_part(part: "Part", memory: Path, timeout_s: float, progress: Progress = silent) -> bool:
    """Simulate the repetitions of a part; False when they need longer: call it again."""
    from .audits import repeated

    return repeated.made(part, memory, timeout_s, progress)


def unlike_part(part: "Part", *, exact: bool) -> tuple[str, str]:
    """How a part says otherwise than its repetitions show, and why they say nothing here; empty where neither is so."""
    from .audits import repeated

    why = repeated.unmade(part)
    return ("" if why else repeated.unlike(part, exact=exact)), why


def unbalanced(balances: tuple[Any, ...]) -> list[str]:
    """For lint (no tool): see `anomalies.checks.unbalanced_law.early`."""
    from .anomalies.checks import unbalanced_law as law

    return law.early(balances)
