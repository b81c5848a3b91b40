"""Run the shelf of checks over one recording."""

from types import FunctionType

import numpy as np

from ..model.evidence import CheckRun, ScanReport
from ..model.finding import Anomaly
from ..model.trajectory import Trajectory
from ..shelf import Entry, Shelf
from . import wholes
from .sign import Context, Sign, SkipError

CHECKS = Shelf("worldwright.scan.checks", {"NEEDS": tuple, "GOOD": tuple, "BAD": tuple, "check": FunctionType})
PER_CHECK = 12
"""Anomalies reported of one check; the rest are counted in the last one's message."""
ORDER = {"blocking": 0, "warn": 1, "info": 2}


def scan(trajectory: Trajectory, context: Context | None = None) -> ScanReport:
    """Every check's outcome and every anomaly, the gravest first.

    When the recording turns into nan, `nan` reports it and the other checks look at what came before.
    """
    context = context or Context()
    finite = _finite_part(trajectory)
    runs, anomalies = [], []
    for entry in CHECKS.values():
        run, found = run_check(entry, trajectory if entry.name == "nan" else finite, context)
        runs.append(run)
        anomalies += found
    anomalies.sort(key=lambda a: (ORDER[a.severity], a.code, a.window_s))
    return ScanReport(trajectory_sha256=trajectory.sha256, checks=tuple(runs), anomalies=tuple(anomalies))


def run_check(entry: Entry, trajectory: Trajectory, context: Context) -> tuple[CheckRun, list[Anomaly]]:
    """One check's outcome with its anomalies."""

    def outcome(status: str, reason: str = "") -> CheckRun:
        return CheckRun.model_validate({"code": entry.code, "name": entry.name, "status": status, "reason": reason})

    missing = [name for name in entry.NEEDS if trajectory.channel(name) is None]
    if missing:
        return outcome("skipped", f"the recording has no {', '.join(missing)}"), []
    try:
        if getattr(entry.module, "WHOLE", False):
            context, trajectory = wholes.asked_of_wholes(context, trajectory), wholes.assembled(trajectory)
        with np.errstate(all="ignore"):
            signs = list(entry.check(trajectory, context))
    except SkipError as reason:
        return outcome("skipped", str(reason)), []
    except Exception as defect:  # a defect of one check must neither end the scan nor pass for a clean motion
        message = f"the check itself failed ({type(defect).__name__}: {defect}); report it with this recording"
        whole = (float(trajectory.t[0]), float(trajectory.t[-1]))
        sign = Sign("world", whole, 1.0, 0.0, "failures", "warn", message)
        return outcome("skipped", message), [_anomaly(entry, sign)]
    signs.sort(key=lambda s: (ORDER[s.severity], s.window_s))
    kept = signs[:PER_CHECK]
    if len(signs) > len(kept):
        last = kept[-1]
        kept[-1] = last._replace(message=f"{last.message} (and {len(signs) - len(kept)} more bodies like it)")
    return outcome("found" if kept else "clean"), [_anomaly(entry, sign) for sign in kept]


def _anomaly(entry: Entry, sign: Sign) -> Anomaly:
    def number(value: float) -> float:
        # Reports are JSON, which has neither nan nor infinity.
        return float(np.nan_to_num(value, nan=0.0, posinf=1e300, neginf=-1e300))

    fields = sign._asdict()
    fields |= {key: number(fields[key]) for key in ("measured", "threshold")}
    fields["window_s"] = (float(sign.window_s[0]), float(sign.window_s[1]))
    return Anomaly(code=entry.code, name=entry.name, **fields)


def _finite_part(trajectory: Trajectory) -> Trajectory:
    if trajectory.finite:
        return trajectory
    rows = np.ones(len(trajectory.t), dtype=bool)
    for channel in (trajectory.pos, trajectory.quat, trajectory.linvel, trajectory.angvel):
        rows &= np.isfinite(channel).all(axis=(1, 2))
    if rows.all():
        return trajectory
    return trajectory.before(max(1, int(np.argmin(rows))))
