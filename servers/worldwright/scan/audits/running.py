"""Run the audits of one run as far as one call's time allows; each is kept as evidence when it is complete."""

import time

from ...model.evidence.audits import CausesReport, InterventionReport, RefineReport, RobustReport
from ...model.evidence.reports import EvidenceKey, ScanReport
from ...model.evidence.run import Run
from ...model.frozen import Frozen
from ...model.plan.committed import Plan
from ...model.progress import Progress, silent
from ...model.recording.trajectory import Trajectory
from ...model.storage import own
from ..anomalies.sign import Context
from . import acting, robustness
from .causes import Causes
from .refine import FACTOR, refine
from .trials import Trials


class Audited(Frozen):
    """What the audits found so far."""

    refine: RefineReport | None = None
    causes: CausesReport | None = None
    robust: RobustReport | None = None
    pending: tuple[str, ...] = ()
    """Repetitions of the physics pass that still run; another call goes on with them."""


def audit(
    run: Run,
    key: EvidenceKey,
    plan: Plan,
    trajectory: Trajectory,
    interventions: InterventionReport,
    *,
    refined: bool,
    causes: bool,
    robust: bool = False,
    timeout_s: float,
    progress: Progress = silent,
) -> Audited:
    """Run the audits asked for; what is not done after `timeout_s` goes on by itself and is named as `pending`."""
    deadline = time.monotonic() + timeout_s
    trials = Trials(run, memory=own(run.folder, run.evidence(key)) / "trials.json")
    finer = trials.ask("--time-step-factor", f"{FACTOR:g}") if refined else ""
    causal = Causes(trajectory, plan, interventions.acting, trials) if causes else None
    if causal is not None:
        causal.plan_trials()
    if robust:
        robustness.ask(trials)
    if not trials.collect(deadline - time.monotonic(), progress):
        return Audited(pending=trials.pending)
    found = Audited(
        refine=refine(
            trajectory, trials.made.get(finer), plan, trials.failed.get(finer, ""), untested=finer in trials.limited
        )
        if refined
        else None,
        causes=None if causal is None else causal.report(),
        robust=robustness.report(trajectory, plan, trials) if robust else None,
    )
    for name, report in (("refine", found.refine), ("causes", found.causes)):
        if report is not None:
            run.keep(key, name, report)
            run.log("scan", name, key=key.key, ok=report.ok)
    if found.robust is not None:
        keep_robust(run, key, found.robust)
    return found


def keep_robust(run: Run, key: EvidenceKey, report: RobustReport) -> None:
    """Keep how robust the claims are. The journal vouches for it first: acceptance may look at any moment meanwhile."""
    run.keep_vouched(key, "robust", report, "scan", everywhere=report.everywhere, claims=len(report.claims))


def interventions(
    run: Run, key: EvidenceKey, plan: Plan, trajectory: Trajectory, report: ScanReport
) -> InterventionReport:
    """The ledger's tables, kept as evidence."""
    found = acting.report(trajectory, Context.of(plan), report.anomalies)
    run.keep(key, "interventions", found)
    return found
