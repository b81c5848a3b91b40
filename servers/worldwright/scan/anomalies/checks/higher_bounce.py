"""A body leaves a bounce faster than it came, or rises higher than it was before.

What it means: a contact too stiff for the step feeds energy in, a restitution above one, a kick, a recording that runs
backwards, or a soft thing that springs.

Formula: a contact of at most 0.25 s between two flights of a body; e = (v_after^2 - v_before^2) / (2 g) plus the
difference of the heights, the energy gained per weight. Nothing else may have paid for it: no other body touches
anything in those rows while it moves, unless it gains as well, and what the body's own spin had is added to v_before^2.
Threshold: e > 0.1 of v_before^2 / (2 g) and 0.03 r, with v_before > 0.5 sqrt(g r). A warning; at two bounces in a row, too.
Source: Newton's law of restitution, e <= 1.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS139"
NEEDS = ("linvel", "touching")
WHOLE = True
LONGEST_S, GAIN, LEAST = 0.25, 0.1, 0.5
MOST = 40


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body's first bounce that gains."""
    touching, g = trajectory.touching, float(np.sqrt((trajectory.gravity**2).sum()))
    if touching is None or g == 0 or len(trajectory.t) < 6:
        return
    longest = max(2, round(LONGEST_S / trajectory.interval_s))
    look = survey(trajectory)
    loose = trajectory.mechanics.unforced
    for b in np.flatnonzero((look.takeoffs.sum(axis=0) > 0) & trajectory.moves_freely):
        if loose is not None and not loose[b]:
            continue
        for start, stop in spans(touching[:, b])[:MOST]:
            before, after = start - 1, stop
            if before < 1 or after > len(trajectory.t) - 2 or stop - start > longest:
                continue
            if touching[before - 1, b] or touching[after + 1, b]:
                continue
            gained, had = _gain(trajectory, int(b), before, after, g)
            limit = LEAST * trajectory.speed_scale[b]
            if had < limit**2 / (2 * g) or gained < max(GAIN * had, 0.03 * trajectory.size_m[b]):
                continue
            if _is_paid_for(trajectory, int(b), before, after):
                continue
            name = trajectory.names[b]
            message = f"{name} leaves a bounce with {gained:.3g} m of height more than the {had:.3g} m it came with"
            severity = "info" if context.acts_on(name, ("force", "velocity", "torque")) else "warn"
            window = (trajectory.t[before], trajectory.t[after])
            yield Sign(name, window, gained, GAIN * had, "m", severity, message)
            break


def _gain(trajectory: Trajectory, b: int, before: int, after: int, g: float) -> tuple[float, float]:
    """(height, m, that the energy of a bounce gains; height of the speed it came with): a sphere's spin may pay for it."""
    speed = trajectory.speed[[before, after], b] ** 2 / (2 * g)
    height = -(trajectory.pos[[before, after], b] @ trajectory.gravity) / g
    spin = 0.4 * (trajectory.spin[[before, after], b] * trajectory.size_m[b]) ** 2 / (2 * g)
    lent = max(0.0, float(spin[0] - spin[1]))
    return float(np.diff(speed + height)[0]) - lent, float(speed[0])


def _is_paid_for(trajectory: Trajectory, b: int, before: int, after: int) -> bool:
    """Whether something else paid for the gain: it moved and lost speed meanwhile, or it moves below."""
    touching = trajectory.touching
    assert touching is not None
    moving = trajectory.speed[before] + trajectory.spin[before] * trajectory.size_m
    later = trajectory.speed[after] + trajectory.spin[after] * trajectory.size_m
    involved = touching[before : after + 1].any(axis=0) & (np.maximum(moving, later) > 0.05 * trajectory.speed_scale)
    posed = trajectory.mechanics.mocap
    if posed is not None:
        involved |= posed & (np.ptp(trajectory.pos[before : after + 1], axis=0).max(axis=1) > 0)
    # A mat or a board that springs moves without being loose; what neither touches nor moves cannot have paid.
    involved |= (~trajectory.moves_freely) & (later + moving > 0.05 * trajectory.speed_scale)
    involved[b] = False
    return bool(involved.any())


def _bouncing(restitution: float) -> Trajectory:
    made = analytic.bouncing(restitution=restitution)
    return replace(made, mechanics=replace(made.mechanics, gravity=np.array([0.0, 0.0, -analytic.G])))


def _backwards() -> Trajectory:
    made = _bouncing(0.8)
    t = made.t[-1] - made.t[::-1]
    force = np.asarray(made.touching, dtype=float)[::-1].copy()
    return replace(
        made, t=t, pos=made.pos[::-1].copy(), linvel=-made.linvel[::-1], contacts=None, contact_force_sum=force
    )


GOOD = (
    lambda: Case("a bouncing ball", _bouncing(0.8)),
    lambda: Case("a ball that keeps its height", _bouncing(1.0)),
    lambda: Case("a body at rest", analytic.resting()),
)
BAD = (lambda: Case("a bouncing ball, backwards", _backwards(), severity="warn"),)
