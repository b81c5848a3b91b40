"""Speeds beyond anything the scene can explain.

What it means: the integration diverges, bodies burst out of each other, or a force has the wrong unit.

Formula: v of each body against what the scene offers: the speed of falling through ten times its extent, and a hundred
times the median speed of the body itself. A body that starts fast (a bullet) is measured against its start.
A speed that doubles eight times, each time in the same while, is measured against the fall alone.
Threshold: ten times the larger of these, or the speed of light's thousandth whatever the scene; sustained over three rows.
Source: conservation of energy, v = sqrt(2 g h).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import STANDARD_GRAVITY, Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS129"
NEEDS = ("linvel",)
ABSURD_M_S = 3e5


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that run away."""
    rows = max(1, len(trajectory.t) // 10)
    start = trajectory.pos[:rows].reshape(-1, 3)
    extent = float(np.sqrt((np.ptp(start, axis=0) ** 2).sum())) + float(trajectory.size_m.max())
    g = float(np.sqrt((trajectory.gravity**2).sum())) or STANDARD_GRAVITY
    fall = np.sqrt(2 * g * 10 * extent)
    top = survey(trajectory).speed.max(axis=0)
    may = top > np.minimum(10 * fall, ABSURD_M_S)
    if not may.any():
        return
    usual = 100 * np.median(trajectory.speed, axis=0)
    first = 3 * trajectory.speed[:3].max(axis=0)
    limit = np.minimum(10 * np.maximum(np.maximum(fall, usual), first), ABSURD_M_S)
    limit = np.where(_exponential(trajectory), np.minimum(limit, 10 * fall), limit)
    for b in np.flatnonzero(top > limit):
        found = spans(trajectory.speed[:, b] > limit[b])
        lasting = found[np.diff(found, axis=1)[:, 0] >= min(3, len(trajectory.t))]
        if not len(lasting):
            continue
        begin, end = lasting[0]
        most = float(trajectory.speed[begin:end, b].max())
        name = trajectory.names[b]
        message = f"{name} reaches {most:.3g} m/s, more than this scene can give it"
        yield Sign(name, (trajectory.t[begin], trajectory.t[end - 1]), most, limit[b], "m/s", "blocking", message)


def _exponential(trajectory: Trajectory) -> np.ndarray:
    """(B,) bool: the speed doubled eight times in a row, each time in about the same while, as no thruster makes it."""
    found = np.zeros(len(trajectory.names), dtype=bool)
    for b in np.flatnonzero(trajectory.speed.max(axis=0) > 256 * np.median(trajectory.speed[:3], axis=0)):
        speed = trajectory.speed[:, b]
        top = int(np.argmax(speed))
        levels = speed[top] / 2.0 ** np.arange(8, -1, -1)
        rows = np.array([int(np.argmax(speed[: top + 1] >= level)) for level in levels])
        gaps = np.diff(trajectory.t[rows])
        found[b] = bool(rows[0] > 0 and gaps.min() > 0 and gaps.max() < 2.5 * gaps.min())
    return found


def _diverging() -> Case:
    still = analytic.resting()
    speed = still.linvel.copy()
    speed[:, 0, 0] = 1e-3 * np.exp(9 * still.t)
    pos = still.pos.copy()
    pos[:, 0, 0] = speed[:, 0, 0] / 9
    return Case("a speed that doubles all the time", replace(still, pos=pos, linvel=speed), severity="blocking")


GOOD = (
    lambda: Case("free fall", analytic.falling()),
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a fast shot", analytic.collision(speeds=(300.0, 0.0))),
)
BAD = (_diverging,)
