"""Run the shelf of checks over one recording."""

from functools import partial

import numpy as np

from ...model.evidence.reports import CheckRun, ScanReport
from ...model.finding import Anomaly, AnomalySeverity
from ...model.recording.trajectory import Trajectory
from ...shelf import Attribute, Entry, Function, Shelf, failed
from . import relevance, wholes
from .sign import Context, Sign, SkipError

CHECKS = Shelf(
    "worldwright.scan.anomalies.checks",
    {
        "NEEDS": Attribute(tuple, "channels of the recording, dotted; where one is missing the check is skipped"),
        "GOOD": Attribute(tuple, "functions that make a `Case` in which it must find nothing"),
        "BAD": Attribute(tuple, "functions that make a `Case` in which it must find something"),
        "check": Attribute(Function, "(Trajectory, Context) -> the signs that it sees"),
        "WHOLE": Attribute(bool, "it is given each rigid assembly as one body (`scan.anomalies.wholes`)", False),
        "UNCUT": Attribute(bool, "it is given all rows, also those after the recording turned into nan", False),
        "SHOWN_AS": Attribute(str, "the quantity whose plot shows a finding best; empty: the one of its unit", ""),
        "FROM_THE_START": Attribute(bool, "its threshold counts from where a body was at the start", False),
        "RELATIVE": Attribute(bool, "it blocks only where a claim rests on it or a viewer can see it", False),
        "REPAIR": Attribute(str, "what a repair changes where it finds something", "solver_or_time_step"),
        "OF_CLAIM": Attribute(
            bool, "what it finds fault with is as often what the plan claims as what the world does", False
        ),
        "STAGING": Attribute(bool, "it tells of staging: the tables of what acted repeat it", False),
        "ABOVE_GROUND": Attribute(bool, "its threshold is a depth below the ground", False),
    },
)
PER_CHECK = 12
"""One check reports so many anomalies; the last one's message counts the rest."""
ORDER = {"blocking": 0, "warn": 1, "info": 2}


def scan(trajectory: Trajectory, context: Context | None = None) -> ScanReport:
    """Every check's outcome and every anomaly, the gravest first.

    When the recording turns into nan, `nan` reports it and the other checks look at what came before; where nothing came
    before, they are skipped.
    """
    context = (context or Context()).of_recording(trajectory)
    finite = _finite_part(trajectory)
    runs, anomalies = [], []
    for entry in CHECKS.values():
        if finite is None and not entry.UNCUT:
            runs.append(_outcome(entry, "skipped", "the first row of the recording is not finite"))
            continue
        run, found = run_check(entry, trajectory if entry.UNCUT or finite is None else finite, context)
        runs.append(run)
        weigh = entry.RELATIVE and context.plan and finite is not None
        anomalies += relevance.weighed(found, finite, context.plan) if weigh else found
    anomalies.sort(key=lambda a: (ORDER[a.severity], a.code, a.window_s))
    return ScanReport(trajectory_sha256=trajectory.sha256, checks=tuple(runs), anomalies=tuple(anomalies))


def run_check(entry: Entry, trajectory: Trajectory, context: Context) -> tuple[CheckRun, list[Anomaly]]:
    """One check's outcome with its anomalies."""
    outcome = partial(_outcome, entry)
    missing = [name for name in entry.NEEDS if trajectory.channel(name) is None]
    if missing:
        return outcome("skipped", f"the recording has no {', '.join(missing)}"), []
    try:
        if entry.WHOLE:
            context, trajectory = wholes.asked_of_wholes(context, trajectory), wholes.assembled(trajectory)
        with np.errstate(all="ignore"):
            signs = sorted(entry.check(trajectory, context), key=lambda s: (ORDER[s.severity], s.window_s))
    except SkipError as reason:
        return outcome("skipped", str(reason)), []
    except Exception as defect:  # a defect of one check must neither end the scan nor pass for a clean motion
        message = f"the check {failed(entry, defect)}"
        whole = (float(trajectory.t[0]), float(trajectory.t[-1]))
        grave: AnomalySeverity = (
            "blocking" if entry.STAGING else "warn"
        )  # else a world could stage what fails its check
        sign = Sign("world", whole, 1.0, 0.0, "failures", grave, message)
        return outcome("skipped", message), [_anomaly(entry, sign)]
    signs = [*_world_signs(trajectory, signs), *signs]
    kept = signs[:PER_CHECK]
    if len(signs) > len(kept):
        last = kept[-1]
        kept[-1] = last._replace(message=f"{last.message} (and {len(signs) - len(kept)} more bodies like it)")
    return outcome("found" if kept else "clean"), [_anomaly(entry, sign) for sign in kept]


def _outcome(entry: Entry, status: str, reason: str = "") -> CheckRun:
    return CheckRun.model_validate({"code": entry.code, "name": entry.name, "status": status, "reason": reason})


def _world_signs(trajectory: Trajectory, signs: list[Sign]) -> list[Sign]:
    """A sign of the world, where all that moves shows the same at once: lost rows, a wrong clock, another gravity."""
    moves = trajectory.moves_freely & (np.ptp(trajectory.pos, axis=0).max(axis=1) > 0)
    grave = [s for s in signs if s.severity != "info"]
    names = {trajectory.names[b] for b in np.flatnonzero(moves)}
    if len(names) < 2 or not grave or not names <= {s.body for s in grave}:
        return []
    each = {s.body: s.window_s for s in reversed(grave) if s.body in names}
    if max(start for start, _ in each.values()) > min(end for _, end in each.values()):
        return []  # what happens to one after the other is no fault of the world
    window = (min(s.window_s[0] for s in grave), max(s.window_s[1] for s in grave))
    return [grave[0]._replace(body="world", window_s=window, message=f"all that moves does so: {grave[0].message}")]


def _anomaly(entry: Entry, sign: Sign) -> Anomaly:
    def number(value: float) -> float:
        # Reports are JSON, which has neither nan nor infinity.
        return float(np.nan_to_num(value, nan=0.0, posinf=1e300, neginf=-1e300))

    fields = sign._asdict()
    fields |= {key: number(fields[key]) for key in ("measured", "threshold")}
    fields["window_s"] = (float(sign.window_s[0]), float(sign.window_s[1]))
    return Anomaly(code=entry.code, name=entry.name, **fields)


def _finite_part(trajectory: Trajectory) -> Trajectory | None:
    """The rows before the first that is not finite; None where that is the first of all."""
    if trajectory.finite:
        return trajectory
    rows = np.ones(len(trajectory.t), dtype=bool)
    for channel in (trajectory.pos, trajectory.quat, trajectory.linvel, trajectory.angvel):
        rows &= np.isfinite(channel).all(axis=(1, 2))
    if rows.all():
        return trajectory
    return trajectory.before(int(np.argmin(rows))) if rows[0] else None
