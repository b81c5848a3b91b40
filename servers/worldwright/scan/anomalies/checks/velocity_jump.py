"""A loose body's velocity changes from one row to the next although nothing is near enough to hit it.

What it means: a velocity was written, or an impulse applied that no contact, tie or declared force accounts for. The
momentum of a body alone in flight changes by gravity only.

Formula: |dv - g dt| over one or two rows of flight > 0.1 sqrt(g r) + 0.02 |v|, with nothing within reach of the body's
bounding sphere in those rows. Where the model is not known, flight is inferred: four rows of dv/dt = g before and
after, no contact in between, and a speed that grew (an unseen bounce can only lose speed).
Threshold: a tenth of the speed of falling by half one's own size.
Source: Newton's second law, momentum form.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS118"
NEEDS = ("linvel",)
WHOLE = True
ROWS = 4


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the first jump of each body."""
    found = _known_jumps(trajectory) if trajectory.mechanics.unforced is not None else _inferred_jumps(trajectory)
    seen = set()
    for b, start, stop, change in found:
        name = trajectory.names[b]
        if b in seen:
            continue
        seen.add(b)
        known = trajectory.mechanics.unforced is not None
        severity = "info" if context.acts_on(name, flight.PUSHES) else "blocking"
        if (
            severity == "blocking"
            and not known
            and (_recoils(trajectory, b, start) or _spun(trajectory, b, start, change))
        ):
            # It was touched between rows if something else changed its velocity then, or its own spin turned into speed.
            severity = "warn"
        limit = 0.1 * trajectory.speed_scale[b]
        message = f"{name} changes its velocity by {change:.3g} m/s in mid-air, from one row to the next"
        yield Sign(name, (trajectory.t[start], trajectory.t[stop]), change, limit, "m/s", severity, message)


def _known_jumps(trajectory: Trajectory) -> Iterator[tuple[int, int, int, float]]:
    if trajectory.interventions is not None or trajectory.every_step:
        return  # flight_force judges single steps there, against the ledger
    for push in flight.pushes(trajectory):
        if push.sudden:
            yield push.body, push.start, push.stop, push.change


def _inferred_jumps(trajectory: Trajectory) -> Iterator[tuple[int, int, int, float]]:
    touching = trajectory.touching
    if touching is None and trajectory.ncon is not None:
        touching = np.repeat(trajectory.ncon[:, None] > 0, len(trajectory.names), axis=1)
    if touching is None or len(trajectory.t) < 2 * ROWS + 2:
        return
    dt = np.diff(trajectory.t)[:, None]
    g = trajectory.gravity
    apart = ~(touching[1:] | touching[:-1])
    for b in np.flatnonzero(survey(trajectory).kicked.any(axis=0)):
        extra = np.sqrt(((np.diff(trajectory.linvel[:, b], axis=0) - g * dt) ** 2).sum(axis=1))
        ballistic = apart[:, b] & (extra < 0.03 * dt[:, 0] * max(1.0, float(np.abs(g).max())))
        squared = trajectory.speed[:, b] ** 2
        gain = np.diff(squared) - 2 * np.diff(trajectory.pos[:, b] @ g)
        limit = (0.1 * trajectory.speed_scale[b] + 0.02 * trajectory.speed[:-1, b]) ** 2
        for n in np.flatnonzero(apart[:, b] & (gain > limit) & (extra**2 > limit)):
            before, after = ballistic[max(0, n - ROWS) : n], ballistic[n + 1 : n + 1 + ROWS]
            if len(before) == len(after) == ROWS and before.all() and after.all():
                yield int(b), int(n), int(n) + 1, float(extra[n])


def _recoils(trajectory: Trajectory, b: int, row: int) -> bool:
    rows = slice(max(0, row - 1), row + 3)
    change = (
        np.diff(trajectory.linvel[rows], axis=0) - (trajectory.gravity * np.diff(trajectory.t[rows])[:, None])[:, None]
    )
    size = np.sqrt((change**2).sum(axis=2)).max(axis=0)
    turn = np.sqrt((np.diff(trajectory.angvel[rows], axis=0) ** 2).sum(axis=2)).max(axis=0) * trajectory.size_m
    moving = trajectory.speed[rows].max(axis=0) + trajectory.spin[rows].max(axis=0) * trajectory.size_m
    others = (np.maximum(size, turn) > 0.02 * trajectory.speed_scale) & (moving > 0.02 * trajectory.speed_scale)
    others[b] = False
    return bool(others.any())


def _spun(trajectory: Trajectory, b: int, row: int, change: float) -> bool:
    """Whether the spin changes with the velocity, as at a touch: a ball with backspin leaves it faster than it came."""
    spin = np.diff(trajectory.angvel[max(0, row - 1) : row + 3, b], axis=0)
    return bool(np.sqrt((spin**2).sum(axis=1)).max() * trajectory.size_m[b] > 0.1 * change)


def _kicked() -> Case:
    fall = analytic.falling(seconds=0.8)
    speed, pos, late = fall.linvel.copy(), fall.pos.copy(), fall.t >= 0.4
    speed[late, 0, 0] = 2.0
    pos[late, 0, 0] = 2.0 * (fall.t[late] - 0.4)
    empty = np.zeros_like(fall.speed)
    bare = replace(fall.mechanics, unforced=None)
    kicked = replace(fall, pos=pos, linvel=speed, contacts=None, contact_force_sum=empty, mechanics=bare, time_step=0.0)
    return Case("a kick in mid-air, of a body whose model is not known", kicked, severity="blocking")


def _sparse_kick() -> Case:
    case = _kicked().trajectory
    facts = replace(case.mechanics, unforced=np.ones(1, dtype=bool))
    rows = slice(None, None, 5)
    cut = {key: getattr(case, key)[rows] for key in ("t", "pos", "quat", "linvel", "angvel", "contact_force_sum")}
    return Case("a kick in mid-air, sampled at 100 Hz", replace(case, mechanics=facts, **cut), severity="blocking")


GOOD = (
    lambda: Case("free fall", analytic.falling()),
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a pendulum", analytic.swinging()),
)
BAD = (_kicked, _sparse_kick)
