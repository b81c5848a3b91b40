"""The refinement audit: repeat the world at half the time step. What holds at only one of the two steps is numerical.

A finer step changes nothing that physics decides. Claims and blocking findings that differ are artefacts of the step: of
contacts that are too stiff for it, of integration errors, or of a program that counts steps instead of seconds.
"""

from collections.abc import Iterator

import numpy as np

from ...model.evidence.audits import Claim, Drift, RefineReport
from ...model.evidence.reports import ScanReport
from ...model.finding import Anomaly, AnomalySeverity
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory
from ..anomalies import engine
from ..anomalies.sign import Context
from ..objectives import expecting

FACTOR = 0.5
MOST_DRIFTS = 12


def refine(
    trajectory: Trajectory, finer: Trajectory | None, plan: Plan, failed: str = "", *, untested: bool = False
) -> RefineReport:
    """Compare the recording with its repetition at a finer step.

    `failed` says why there is no repetition; `untested` that a limit of time or memory stopped it, no fault of the world.
    """
    window = (float(trajectory.t[0]), float(trajectory.t[-1]))
    step = trajectory.time_step
    if finer is None:
        message = f"the world cannot be simulated at half its time step: {failed}"
        anomaly = _anomaly("world", window, "warn" if untested else "blocking", message)
        return RefineReport(
            trajectory_sha256=trajectory.sha256,
            refined_sha256="",
            time_step=step,
            refined_time_step=step * FACTOR,
            anomalies=(anomaly,),
        )
    claims = tuple(_claims(trajectory, finer, plan))
    anomalies = [
        _anomaly(
            c.name,
            window,
            "blocking",
            f"objective {c.objective}, {c.name}: {c.at_step} at {step:g} s, {c.at_finer} at {finer.time_step:g} s "
            f"({c.message}); it is decided by the time step, not by the physics",
        )
        for c in claims
        if c.artefact
    ]
    context = Context.of(plan)
    anomalies += _findings(engine.scan(trajectory, context), engine.scan(finer, context))
    return RefineReport(
        trajectory_sha256=trajectory.sha256,
        refined_sha256=finer.sha256,
        time_step=step,
        refined_time_step=finer.time_step,
        claims=claims,
        drift=tuple(drifts(trajectory, finer)),
        anomalies=tuple(anomalies),
    )


def _claims(trajectory: Trajectory, finer: Trajectory, plan: Plan) -> Iterator[Claim]:
    reports = expecting.expect(trajectory, plan), expecting.expect(finer, plan)
    for one, other in zip(*(report.objectives for report in reports), strict=True):
        for first, second in zip(one.expectations, other.expectations, strict=True):
            if first.needs_stills or second.needs_stills:
                continue  # no pictures are drawn of a repetition
            told = first.message if first.status == second.status else f"{first.message}; then: {second.message}"
            yield Claim(
                objective=one.index,
                name=first.name,
                at_step=first.status,
                at_finer=second.status,
                measured=first.measured,
                measured_finer=second.measured,
                unit=first.unit,
                message=told,
            )


def _findings(one: ScanReport, other: ScanReport) -> Iterator[Anomaly]:
    """Blocking findings that appear at one step only."""

    def blocking(report: ScanReport) -> dict[tuple[str, str], Anomaly]:
        return {(a.code, a.body): a for a in report.anomalies if a.severity == "blocking"}

    coarse, fine = blocking(one), blocking(other)
    for key in sorted(coarse.keys() ^ fine.keys()):
        found, where = (coarse[key], "the planned") if key in coarse else (fine[key], "half the")
        message = f"{found.code} {found.name} appears only at {where} time step: {found.message}"
        yield _anomaly(found.body, found.window_s, "warn", message)


def drifts(trajectory: Trajectory, finer: Trajectory) -> Iterator[Drift]:
    """How far bodies and energy of the two recordings part, the largest first."""
    rows = min(len(trajectory.t), len(finer.t))
    t = trajectory.t[:rows]
    found = []
    if trajectory.names == finer.names:
        apart = np.sqrt(((trajectory.pos[:rows] - finer.pos[:rows]) ** 2).sum(axis=2))
        travelled = np.ptp(trajectory.pos[:rows], axis=0)
        extent = np.sqrt((travelled**2).sum(axis=1))
        for b in np.flatnonzero(apart.max(axis=0) > 0):
            at = int(apart[:, b].argmax())
            value = float(apart[at, b])
            relative = value / max(float(extent[b]), float(trajectory.size_m[b]))
            found.append(("position", trajectory.names[b], value, float(t[at]), "m", relative))
    found.sort(key=lambda row: -row[-1])
    if trajectory.energy is not None and finer.energy is not None:
        one, other = trajectory.energy[:rows].sum(axis=1), finer.energy[:rows].sum(axis=1)
        at = int(np.abs(one - other).argmax())
        value = float(abs(one[at] - other[at]))
        scale = float(max(np.ptp(trajectory.energy[:rows], axis=0).max(), 1e-12))
        found.insert(0, ("energy", "world", value, float(t[at]), "J", value / scale))
    for quantity, body, value, at_s, unit, relative in found[:MOST_DRIFTS]:
        yield Drift(quantity=quantity, body=body, value=value, at_s=at_s, unit=unit, relative=relative)


def _anomaly(body: str, window: tuple[float, float], severity: AnomalySeverity, message: str) -> Anomaly:
    return Anomaly(
        code="WS311",
        name="numerical_artefact",
        severity=severity,
        body=body,
        window_s=window,
        measured=1.0,
        threshold=0.0,
        unit="differences",
        message=message,
    )
