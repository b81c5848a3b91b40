"""The audits of one run, as far as one call's time takes them; each is kept as evidence when it is whole."""

import time

from ...model.audits import CausesReport, InterventionReport, RefineReport
from ...model.evidence import EvidenceKey, ScanReport
from ...model.frozen import Frozen
from ...model.plan import Plan
from ...model.progress import Progress, silent
from ...model.run import Run
from ...model.trajectory import Trajectory
from ..sign import Context
from . import ledger
from .causes import Causes
from .refine import FACTOR, refine
from .trials import Trials, patience_s


class Audited(Frozen):
    """What the audits found so far."""

    refine: RefineReport | None = None
    causes: CausesReport | None = None
    pending: tuple[str, ...] = ()
    """Repetitions of the physics pass that are still running: call again."""


def audit(
    run: Run,
    key: EvidenceKey,
    plan: Plan,
    trajectory: Trajectory,
    interventions: InterventionReport,
    *,
    refined: bool,
    causes: bool,
    timeout_s: float,
    progress: Progress = silent,
) -> Audited:
    """Run the audits asked for; what is missing after `timeout_s` goes on by itself and is named as `pending`."""
    deadline = time.monotonic() + timeout_s
    trials = Trials(run, wall_s=patience_s(run, key), memory=run.evidence(key) / "trials.json")
    finer = trials.ask("--time-step-factor", f"{FACTOR:g}") if refined else ""
    causal = Causes(trajectory, plan, interventions.acting, trials) if causes else None
    if causal is not None:
        causal.plan_trials()
    if not trials.collect(deadline - time.monotonic(), progress):
        return Audited(pending=trials.pending)
    found = Audited(
        refine=refine(
            trajectory, trials.made.get(finer), plan, trials.failed.get(finer, ""), untested=finer in trials.limited
        )
        if refined
        else None,
        causes=None if causal is None else causal.report(),
    )
    for name, report in (("refine", found.refine), ("causes", found.causes)):
        if report is not None:
            run.keep(key, name, report)
            run.log("scan", name, key=key.key, ok=report.ok)
    return found


def interventions(
    run: Run, key: EvidenceKey, plan: Plan, trajectory: Trajectory, report: ScanReport
) -> InterventionReport:
    """The ledger's tables, kept as evidence."""
    found = ledger.report(trajectory, Context.of(plan), report.anomalies)
    run.keep(key, "interventions", found)
    return found
