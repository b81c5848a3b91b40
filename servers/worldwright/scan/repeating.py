"""What `scan` does for other servers, which reach it through `scan.tools`; none of it is a tool."""

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
