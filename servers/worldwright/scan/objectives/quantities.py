"""Numbers that compare bodies: how fast, how high, how far, how soon; and what their laws depend on."""

from collections.abc import Callable

import numpy as np

from ...model.recording.trajectory import Trajectory
from ..measuring.channels import coordinate
from ..measuring.curves import swings
from ..measuring.measured import UnknowableError, masses

Quantity = tuple[str, Callable[[Trajectory, int, slice], float]]
REST_M_S = 0.02


def _height(trajectory: Trajectory, body: int, rows: slice) -> np.ndarray:
    return trajectory.pos[rows, body, 2]


def _away(trajectory: Trajectory, body: int, rows: slice) -> float:
    path = trajectory.pos[rows, body]
    return float(np.linalg.norm(path - path[0], axis=1).max())


def _way(trajectory: Trajectory, body: int, rows: slice) -> float:
    return float(np.linalg.norm(np.diff(trajectory.pos[rows, body], axis=0), axis=1).sum())


def _drop(trajectory: Trajectory, body: int, rows: slice) -> float:
    z = _height(trajectory, body, rows)
    return float((np.maximum.accumulate(z) - z).max())


def _rise(trajectory: Trajectory, body: int, rows: slice) -> float:
    z = _height(trajectory, body, rows)
    return float((z - np.minimum.accumulate(z)).max())


def _rest(trajectory: Trajectory, body: int, rows: slice) -> float:
    moving = np.flatnonzero(trajectory.speed[rows, body] > REST_M_S)
    t = trajectory.t[rows]
    if len(moving) and moving[-1] == len(t) - 1:
        raise UnknowableError(f"{trajectory.names[body]} does not come to rest")
    return float(t[moving[-1] + 1] - t[0]) if len(moving) else 0.0


def _touch(trajectory: Trajectory, body: int, rows: slice) -> float:
    if trajectory.touching is None:
        raise UnknowableError("no contacts were recorded")
    touching = trajectory.touching[rows, body]
    if not touching.any():
        raise UnknowableError(f"{trajectory.names[body]} touches nothing")
    return float(trajectory.t[rows][touching.argmax()] - trajectory.t[rows][0])


def _period(trajectory: Trajectory, body: int, rows: slice) -> float:
    name = trajectory.names[body]
    period, _ = swings(trajectory.t[rows], coordinate(trajectory, name, "principal", rows).values)
    if period is None:
        raise UnknowableError(f"{name} does not swing")
    return period


SPEEDS: dict[str, Quantity] = {
    "max_speed": ("m/s", lambda t, b, r: float(t.speed[r, b].max())),
    "mean_speed": ("m/s", lambda t, b, r: float(t.speed[r, b].mean())),
    "final_speed": ("m/s", lambda t, b, r: float(t.speed[r, b][-1])),
    "max_spin": ("rad/s", lambda t, b, r: float(t.spin[r, b].max())),
}
HEIGHTS: dict[str, Quantity] = {
    "max_height": ("m", lambda t, b, r: float(_height(t, b, r).max())),
    "min_height": ("m", lambda t, b, r: float(_height(t, b, r).min())),
    "final_height": ("m", lambda t, b, r: float(_height(t, b, r)[-1])),
    "rise": ("m", _rise),
    "drop": ("m", _drop),
}
WAYS: dict[str, Quantity] = {"displacement": ("m", _away), "path": ("m", _way)}
TIMES: dict[str, Quantity] = {"rest_time": ("s", _rest), "contact_time": ("s", _touch), "period": ("s", _period)}
OUTCOMES: dict[str, Quantity] = {**SPEEDS, **HEIGHTS, **WAYS, **TIMES}
"""Quantities that are outcomes of a motion."""

CONDITIONS: dict[str, Quantity] = {
    "mass": ("kg", lambda t, b, _: float(masses(t)[b])),
    "size": ("m", lambda t, b, _: float(t.size_m[b])),
    "start_height": ("m", lambda t, b, r: float(_height(t, b, r)[0])),
    "start_speed": ("m/s", lambda t, b, r: float(t.speed[r, b][0])),
    "start_spin": ("rad/s", lambda t, b, r: float(t.spin[r, b][0])),
}
"""Quantities on which an outcome may depend."""
