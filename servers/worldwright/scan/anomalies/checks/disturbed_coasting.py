"""A body that was on its own, falling or coasting, is suddenly pushed, braked or turned, and nothing touches it.

What it means: a velocity was written, a force switched on in mid-flight, a clock or a gravity changed. From poses alone a
rope, a motor or a joint could do the same; so it is a remark for a reader, and with a model beside the recording others say it.

Formula: for 0.15 s and eight rows the acceleration of a body is the earth's gravity, or nothing, within 0.3 m/s^2, with
no contact; from one row to the next it is another one by more than 2 m/s^2 (or its speed by more than 0.2 sqrt(g r)),
still without contact. Likewise a spin that is steady within a hundredth of sqrt(g / r) and then changes at more than 0.3
g / r.
Threshold: as said. A warning.
Source: Newton's first law.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.mechanics import Mechanics
from ....model.recording.trajectory import STANDARD_GRAVITY, Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS142"
NEEDS = ("linvel", "touching")
HELD_S, ROWS, EVEN, CHANGED = 0.15, 8, 0.3, 2.0
AFTER = 4
"""So many steps from the push on are without contact: a landing between two rows shows as a touch soon after."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that something unseen gets hold of."""
    touching = trajectory.touching
    if trajectory.mechanics.unforced is not None or touching is None or len(trajectory.t) < 2 * ROWS:
        return
    dt = np.diff(trajectory.t)[:, None]
    apart = ~(touching[1:] | touching[:-1])
    rows = max(ROWS, round(HELD_S / trajectory.interval_s))
    look = survey(trajectory)
    moving = (look.speed.max(axis=0) > 0.05 * trajectory.speed_scale) | (look.spin.max(axis=0) > 0.1)
    scales = STANDARD_GRAVITY / trajectory.size_m
    turned = (
        look.spin.max(axis=0) > 0.01 * scales * dt.min()
    )  # otherwise it never turns fast enough to have been turned
    moving &= look.off_gravity.any(axis=0) | turned
    for b in np.flatnonzero(moving & (apart.sum(axis=0) > rows)):
        rate = np.diff(np.ascontiguousarray(trajectory.linvel[:, b]), axis=0) / dt
        drift = trajectory.speed[:-1, b] > 0.05 * trajectory.speed_scale[b]
        level = rate[:, 0] ** 2 + rate[:, 1] ** 2
        falling, coasting = (np.sqrt(level + (rate[:, 2] - base) ** 2) for base in (-STANDARD_GRAVITY, 0.0))
        fall, coast = falling < EVEN, (coasting < EVEN / 3) & drift
        kick = 0.2 * trajectory.speed_scale[b] / dt[:, 0]
        for free, extra in ((fall, falling), (coast, coasting)):
            lasting = extra > CHANGED
            lasting[:-1] &= extra[1:] > 0.5 * CHANGED
            n = _after(free & apart[:, b], lasting | (extra > kick), apart[:, b], rows)
            if n is not None:
                yield _sign(trajectory, int(b), n, float(extra[n]), CHANGED, "m/s^2", "pushed")
                break
        else:
            if not turned[b]:
                continue
            scale = scales[b]
            turn = np.sqrt((np.diff(trajectory.angvel[:, b], axis=0) ** 2).sum(axis=1)) / dt[:, 0]
            quiet = (turn < 0.01 * np.sqrt(scale)) & (trajectory.spin[:-1, b] < 0.05 * np.sqrt(scale))
            n = _after(quiet & apart[:, b] & (fall | coast), turn > 0.02 * scale, apart[:, b], rows)
            if n is not None:
                yield _sign(trajectory, int(b), n, float(turn[n]), 0.02 * scale, "rad/s^2", "turned")


def _after(free: np.ndarray, off: np.ndarray, alone: np.ndarray, rows: int) -> int | None:
    """The first row that is off right after so many free ones."""
    for start, n in spans(free):
        if n - start >= rows and n < len(free) and off[n] and alone[n : n + AFTER].all():
            return int(n)
    return None


def _sign(trajectory: Trajectory, b: int, n: int, size: float, limit: float, unit: str, what: str) -> Sign:
    name = trajectory.names[b]
    message = f"{name} is on its own and is suddenly {what} with {size:.3g} {unit}; nothing touches it"
    return Sign(name, (trajectory.t[n], trajectory.t[n + 1]), size, limit, unit, "warn", message)


def _pushed(gain: float) -> Trajectory:
    fall = analytic.falling(seconds=0.8)
    late = np.maximum(fall.t - 0.4, 0.0)
    pos, vel = fall.pos.copy(), fall.linvel.copy()
    pos[:, 0, 0] += gain * late**2 / 2
    vel[:, 0, 0] += gain * late
    return replace(
        fall, pos=pos, linvel=vel, contacts=None, contact_force_sum=np.zeros_like(fall.speed), mechanics=Mechanics()
    )


GOOD = (
    lambda: Case("a fall, poses alone", _pushed(0.0)),
    lambda: Case("a bouncing ball, poses alone", replace(analytic.bouncing(), mechanics=Mechanics())),
)
BAD = (lambda: Case("pushed in mid-air, poses alone", _pushed(40.0), severity="warn"),)
