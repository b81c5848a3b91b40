"""Choose how a plot shows a finding: the quantity, the stretch of time, and the threshold on its axis."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...model.errors import NotFoundError
from ...model.finding import Anomaly
from ...model.recording.trajectory import Trajectory
from ..anomalies.engine import CHECKS

BY_UNIT = {
    "m": "position", "rad": "tilt", "m/s": "speed", "m/s^2": "speed", "rad/s": "spin", "J": "energy", "N": "contact_force",
}  # fmt: skip
UNITS = {"speed": "m/s", "spin": "rad/s", "contact_force": "N", "energy": "J"}
LEAST_PAD_S = 0.25


@dataclass(frozen=True)
class Mark:
    """What a plot shows of a finding."""

    window_s: tuple[float, float]
    title: str
    note: str
    threshold: float | None
    """The threshold on the plot's own axis; None when the axis shows something else than the check measures."""
    quantity: str
    bodies: tuple[str, ...]
    view_s: tuple[float, float]
    """The stretch of time to show: the finding with its surroundings."""


def mark(trajectory: Trajectory, anomaly: Anomaly, quantity: str | None = None) -> Mark:
    """The mark of one anomaly, in the quantity asked for or in the one that shows it best."""
    start, end = anomaly.window_s
    pad = max(LEAST_PAD_S, end - start)
    shown = quantity or _best(trajectory, anomaly)
    parts = anomaly.body.replace(", ", " and ").split(" and ")
    return Mark(
        window_s=(start, end),
        title=f"{anomaly.code} {anomaly.name.replace('_', ' ')}: {anomaly.body}",
        note=f"measured {anomaly.measured:.4g} {anomaly.unit}, threshold {anomaly.threshold:.4g} {anomaly.unit}",
        threshold=_threshold_line(trajectory, anomaly, shown),
        quantity=shown,
        bodies=tuple(name for name in parts if name in trajectory.names),
        view_s=(max(float(trajectory.t[0]), start - pad), min(float(trajectory.t[-1]), end + pad)),
    )


def _check_attribute(anomaly: Anomaly, attribute: str) -> Any:
    """An attribute of the check that found an anomaly; None for a finding of an audit."""
    entry = CHECKS.entries.get(anomaly.code)
    return getattr(entry, attribute) if entry is not None else None


def _best(trajectory: Trajectory, anomaly: Anomaly) -> str:
    found = _check_attribute(anomaly, "SHOWN_AS") or BY_UNIT.get(anomaly.unit, "position")
    there = {
        "energy": trajectory.energy is not None,
        "contact_force": trajectory.contacts is not None or trajectory.contact_force_sum is not None,
        "penetration": trajectory.contacts is not None or trajectory.max_penetration is not None,
    }
    return found if there.get(found, True) else {"penetration": "height"}.get(found, "speed")


def _threshold_line(trajectory: Trajectory, anomaly: Anomaly, quantity: str) -> float | None:
    """The threshold on the axis of the quantity: lengths count from the body's place when the finding begins."""
    if UNITS.get(quantity) == anomaly.unit:
        return anomaly.threshold
    if anomaly.body not in trajectory.names:
        return None
    body, row = trajectory.names.index(anomaly.body), trajectory.rows(anomaly.window_s[0], None).start
    facts = trajectory.mechanics
    if quantity == "penetration" and anomaly.unit == "of the half-thickness":
        thin = facts.half_thickness()
        return None if thin is None or np.isnan(thin[body]) else float(anomaly.threshold * thin[body] * 1000)
    if anomaly.unit != "m" or quantity not in ("height", "position"):
        return None
    if _check_attribute(anomaly, "ABOVE_GROUND"):
        return None if facts.ground_z is None or quantity != "height" else facts.ground_z - anomaly.threshold
    if quantity == "height":
        return float(trajectory.pos[row, body, 2]) - anomaly.threshold
    away = float(np.linalg.norm(trajectory.pos[row, body] - trajectory.pos[0, body]))
    return anomaly.threshold + (0.0 if _check_attribute(anomaly, "FROM_THE_START") else away)


def choose(anomalies: tuple[Anomaly, ...], wanted: str) -> Anomaly:
    """The finding with a check's code or name, and `:BODY` behind it when several bodies have one."""
    kind, _, body = wanted.partition(":")
    found = [a for a in anomalies if kind in (a.code, a.name) and (not body or body == a.body)]
    if found:
        return found[0]
    known = ", ".join(f"{a.code}:{a.body}" for a in anomalies[:20]) or "none: the scan found nothing"
    raise NotFoundError(f"there is no finding '{wanted}' in this recording", next_move=f"findings: {known}")
