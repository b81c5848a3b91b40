"""A finding on a plot: which quantity shows it, which stretch of time, where its threshold lies on that axis."""

from dataclasses import dataclass

import numpy as np

from ...model.errors import NotFoundError
from ...model.finding import Anomaly
from ...model.trajectory import Trajectory

BY_CHECK = {
    "deep_penetration": "penetration", "below_ground": "height", "monotonic_sinking": "height", "floating": "height",
    "tunnelling": "position", "free_fall": "height", "dead_stop": "speed", "energy_gain": "energy",
    "contact_chatter": "speed", "flight_torque": "spin", "failure_to_settle": "speed", "broken_orientation": "tilt",
}  # fmt: skip
"""What shows a finding best, where its unit does not say so."""
BY_UNIT = {
    "m": "position", "rad": "tilt", "m/s": "speed", "m/s^2": "speed", "rad/s": "spin", "J": "energy", "N": "contact_force",
}  # fmt: skip
UNITS = {"speed": "m/s", "spin": "rad/s", "contact_force": "N", "energy": "J"}
FROM_THE_START = ("moves_unexpectedly", "should_move")
LEAST_PAD_S = 0.25


@dataclass(frozen=True)
class Mark:
    """What is drawn into the plot."""

    window_s: tuple[float, float]
    title: str
    note: str
    threshold: float | None
    """On the plot's own axis; None when the axis shows something else than the check measures."""
    quantity: str
    bodies: tuple[str, ...]
    view_s: tuple[float, float]
    """The stretch of time to show: the finding with its surroundings."""


def mark(trajectory: Trajectory, anomaly: Anomaly, quantity: str | None = None) -> Mark:
    """How one anomaly is shown, by the quantity asked for or by the one that shows it best."""
    start, end = anomaly.window_s
    pad = max(LEAST_PAD_S, end - start)
    shown = quantity or _best(trajectory, anomaly)
    parts = anomaly.body.replace(", ", " and ").split(" and ")
    return Mark(
        window_s=(start, end),
        title=f"{anomaly.code} {anomaly.name.replace('_', ' ')}: {anomaly.body}",
        note=f"measured {anomaly.measured:.4g} {anomaly.unit}, threshold {anomaly.threshold:.4g} {anomaly.unit}",
        threshold=_line(trajectory, anomaly, shown),
        quantity=shown,
        bodies=tuple(name for name in parts if name in trajectory.names),
        view_s=(max(float(trajectory.t[0]), start - pad), min(float(trajectory.t[-1]), end + pad)),
    )


def _best(trajectory: Trajectory, anomaly: Anomaly) -> str:
    found = BY_CHECK.get(anomaly.name) or BY_UNIT.get(anomaly.unit, "position")
    there = {
        "energy": trajectory.energy is not None,
        "contact_force": trajectory.contacts is not None or trajectory.contact_force_sum is not None,
        "penetration": trajectory.contacts is not None or trajectory.max_penetration is not None,
    }
    return found if there.get(found, True) else {"penetration": "height"}.get(found, "speed")


def _line(trajectory: Trajectory, anomaly: Anomaly, quantity: str) -> float | None:
    """The threshold on the axis of the quantity: lengths count from where the body was when the finding begins."""
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
    if anomaly.name == "below_ground":
        return None if facts.ground_z is None or quantity != "height" else facts.ground_z - anomaly.threshold
    if quantity == "height":
        return float(trajectory.pos[row, body, 2]) - anomaly.threshold
    away = float(np.linalg.norm(trajectory.pos[row, body] - trajectory.pos[0, body]))
    return anomaly.threshold + (0.0 if anomaly.name in FROM_THE_START else away)


def choose(anomalies: tuple[Anomaly, ...], wanted: str) -> Anomaly:
    """The finding meant by a check's code or name, with `:BODY` when several bodies have it."""
    kind, _, body = wanted.partition(":")
    found = [a for a in anomalies if kind in (a.code, a.name) and (not body or body == a.body)]
    if found:
        return found[0]
    known = ", ".join(f"{a.code}:{a.body}" for a in anomalies[:20]) or "none: the scan found nothing"
    raise NotFoundError(f"there is no finding '{wanted}' in this recording", next_move=f"findings: {known}")
