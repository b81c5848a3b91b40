"""A body travels, but its recorded velocity does not say so (or says otherwise).

What it means: its pose is written a little at each step, so that it glides without being pushed: a kinematic fake of a
dynamic body. Each step is too small to be a teleport; over a quarter of a second the sum is not.

Formula: |x(b) - x(a) - integral of v dt| over 0.25 s, against 0.2 r + 0.2 (path length of v) + 2 dt max|v|, with r
the bounding radius. The last two terms cover the quadrature of impacts between two rows.
Threshold: a fifth of the body's own size; engine recordings agree to about dt max|v|, a thousandth of that.
Source: the definition of velocity; the facts on staging ("state written between steps").
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum, spans
from ..survey import survey

CODE = "WS103"
NEEDS = ("linvel",)
WINDOW_S = 0.25


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies whose positions are not the integral of their velocities."""
    rows = min(len(trajectory.t) - 1, max(2, round(WINDOW_S / trajectory.interval_s)))
    candidates = np.flatnonzero(trajectory.moves_freely)
    if rows < 2 or not len(candidates):
        return
    dt = np.diff(trajectory.t)[:, None]
    size, look = trajectory.size_m, survey(trajectory)
    least = 0.2 * size + 2 * trajectory.interval_s * look.speed.max(axis=0)
    may = look.astray_over(rows) > least
    for b in candidates[may[candidates]]:
        speed = trajectory.speed[:, b]
        steps = (trajectory.linvel[1:, b] + trajectory.linvel[:-1, b]) / 2 * dt
        off = trajectory.pos[rows:, b] - trajectory.pos[:-rows, b] - sliding_sum(steps, rows)
        gap = np.sqrt(np.einsum("ti,ti->t", off, off))
        if gap.max() < 0.2 * size[b]:
            continue
        path = sliding_sum((speed[1:] + speed[:-1]) / 2 * dt[:, 0], rows)
        limit = 0.2 * size[b] + 0.2 * path + 2 * trajectory.interval_s * speed.max()
        found = spans(gap > limit, bridge=rows)
        if not len(found):
            continue
        start, stop = found[0]
        worst = start + int(np.argmax(gap[start:stop] - limit[start:stop]))
        name = trajectory.names[b]
        declared = context.acts_on(name, ("pose",))
        # A body that is posed from outside has no velocity at all; only a model could tell whether this is one.
        posed = trajectory.mechanics.mocap is None and not speed.any()
        yield Sign(
            name,
            (trajectory.t[start], trajectory.t[min(stop + rows - 1, len(trajectory.t) - 1)]),
            gap[worst],
            limit[worst],
            "m",
            "info" if declared else "warn" if posed else "blocking",
            f"{name} moves {gap[worst]:.3g} m further in {WINDOW_S} s than its own velocity takes it"
            + (" (the plan declares that its pose is written)" if declared else ""),
        )


def _glide() -> Case:
    still = analytic.resting()
    pos = still.pos.copy()
    pos[:, 0, 0] += 0.4 * still.t
    return Case("a glide with zero velocity", replace(still, pos=pos), severity="blocking")


GOOD = (
    lambda: Case("a swinging pendulum", analytic.swinging()),
    lambda: Case("a collision", analytic.collision()),
    lambda: Case("a bouncing ball", analytic.bouncing()),
)
BAD = (_glide,)
