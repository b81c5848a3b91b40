"""The audit of robustness, made by itself beside other work, once a walk has come to its pictures.

It takes seven more physics passes, and nothing waits for them. So a process of its own makes them one at a time, with the
lowest priority; what a claim rests on (the causes, acceptance's own proof) is never repeated for it, nor it for them. What is
there already costs nothing: `robust.json` is not made twice, and a walk that is taken up again joins what is under way.
"""

import hashlib
import os
from contextlib import suppress

from pydantic import ValidationError

from ...model import work_beside
from ...model.errors import GateError, RecordingError
from ...model.evidence.audits import RobustReport
from ...model.evidence.journal import Journal
from ...model.evidence.reports import EvidenceKey, ExpectReport
from ...model.evidence.run import Run
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory
from ...model.recording.trajectory_files import read_trajectory
from ...model.storage import own, writing
from . import robustness, running
from .trials import Trials

MODULE = "worldwright.robust_beside"
"""What the process runs; it stands at the top of the house, since it writes the run's report anew at its end."""
LOWEST = 19
STILL_S = 3600.0
"""With the lowest priority beside much other work, a pass may advance as slowly as this."""


def begin(run: Run, key: EvidenceKey) -> str:
    """Begin the audit of the recording of this key, unless it is done or under way.

    Returns:
        What there is to say of it, one line; empty where no measured claim holds, or nothing may go on unasked.
    """
    folder = run.evidence(key)
    if (done := _kept(run, key)) is not None:
        return done.text().splitlines()[-1]
    if not work_beside.allowed() or not _holds(run, key):
        return ""
    with writing("the audit of robustness", folder):
        work_beside.begin(MODULE, run.folder, own(run.folder, folder))
    return "robust: the worlds a little otherwise are simulated beside, one by one; the report will tell"


def finish(run: Run, key: EvidenceKey, plan: Plan, trajectory: Trajectory) -> RobustReport | None:
    """Make the audit to its end; None where it is there already. Lowers the priority of the calling process for good.

    Raises:
        GateError: the program, the plan, or what they use was changed meanwhile: what was simulated is of no one world.
    """

    def unchanged() -> None:
        with suppress(OSError):  # a file that is gone is a change, too
            if run.evidence_key(key.environment_sha256) == key:
                return
        raise GateError(
            "the world was changed while the audit of robustness was made beside",
            place=str(run.folder),
            next_move="nothing needs doing: it begins anew with the next walk",
        )

    if _kept(run, key) is not None:
        return None
    with suppress(OSError):
        os.nice(LOWEST)
    trials = Trials(run, at_once=1, still_s=STILL_S, before_start=unchanged)
    robustness.ask(trials)
    trials.collect(float("inf"))
    report = robustness.report(trajectory, plan, trials)
    unchanged()
    running.keep_robust(run, key, report)
    return report


def _kept(run: Run, key: EvidenceKey) -> RobustReport | None:
    """The report of this key; None where there is none that can be read, that the journal vouches for, and that is of the
    recording that there is now."""
    folder = run.evidence(key)
    with suppress(OSError, ValidationError, RecordingError):
        said = (folder / "robust.json").read_bytes()
        report = RobustReport.model_validate_json(said)
        vouched = Journal(run.journal).vouched(key.key).get("robust") == hashlib.sha256(said).hexdigest()
        if vouched and report.trajectory_sha256 == read_trajectory(folder / "physics" / "trajectory").sha256:
            return report
    return None


def _holds(run: Run, key: EvidenceKey) -> bool:
    """Whether any claim was measured and holds."""
    with suppress(OSError, ValidationError):
        report = ExpectReport.model_validate_json((run.evidence(key) / "expect.json").read_bytes())
        return any(e.status == "holds" and not e.needs_stills for o in report.objectives for e in o.expectations)
    return False
