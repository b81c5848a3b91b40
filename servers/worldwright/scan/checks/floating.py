"""A body rests in the air: nothing under it, nothing holding it.

What it means: it is held by a hidden force, its gravity was switched off, its support is only drawn, or it was frozen.

Formula: for at least 0.3 s a loose body touches nothing, is within reach of nothing, keeps |v| < 0.02 sqrt(g r) and turns
slower than 0.02 sqrt(g / r). Where the model is not known, a body that fell freely before counts as loose.
Severity: a warning where it came to rest little by little in a recording that names no forces; blocking otherwise.
Threshold: a body let go would have gained 3 m/s in that time.
Source: Newton's first law; the facts on staging.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.trajectory import Trajectory
from .. import analytic, flight
from ..sign import Case, Context, Sign, spans

CODE = "WS124"
NEEDS = ("linvel", "touching")
HELD_S = 0.3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that float."""
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    touching, loose = trajectory.touching, trajectory.mechanics.unforced
    if g == 0 or touching is None:
        return
    still = trajectory.speed < 0.02 * trajectory.speed_scale
    still &= trajectory.spin * trajectory.size_m < 0.02 * trajectory.speed_scale
    rows = max(3, round(HELD_S / trajectory.interval_s))
    for b in np.flatnonzero((still & ~touching & trajectory.moves_freely).any(axis=0)):
        if loose is not None and not loose[b]:
            continue
        hanging = still[:, b] & ~touching[:, b] & ~flight.reachable(trajectory, int(b))
        for start, stop in spans(hanging):
            if stop - start < rows or (loose is None and not _fell_before(trajectory, int(b), int(start))):
                continue
            name, seconds = trajectory.names[b], trajectory.t[stop - 1] - trajectory.t[start]
            # What comes to rest little by little may lie in water, or on a force that a plan would name.
            eased = start > 2 and trajectory.speed[start - 2, b] < 0.1 * trajectory.speed_scale[b]
            told = trajectory.interventions is not None or trajectory.every_step
            severity = "info" if context.acts_on(name, flight.PUSHES) else "warn" if eased and not told else "blocking"
            message = f"{name} hangs in the air for {seconds:.2g} s with nothing to hold it"
            window = (trajectory.t[start], trajectory.t[stop - 1])
            yield Sign(name, window, seconds, HELD_S, "s", severity, message)
            break


def _fell_before(trajectory: Trajectory, b: int, row: int) -> bool:
    dt = np.diff(trajectory.t[: row + 1])
    extra = np.diff(trajectory.linvel[: row + 1, b], axis=0) - trajectory.gravity * dt[:, None]
    free = np.sqrt((extra**2).sum(axis=1)) < 0.3 * dt
    return bool(len(spans(free)) and np.diff(spans(free), axis=1).max() >= 6)


def _hanging() -> Case:
    t = analytic.clock(1.0)
    pos = np.tile((0.0, 0.0, 2.0), (len(t), 1))
    return Case("a cup hangs in the air", analytic.motion(t, pos, 0 * pos), severity="blocking")


def _stopped_falling() -> Case:
    fall = analytic.falling(seconds=1.0, height=8.0)
    pos, vel, late = fall.pos.copy(), fall.linvel.copy(), fall.t > 0.4
    pos[late], vel[late] = pos[late][0], 0.0
    bare = replace(fall, pos=pos, linvel=vel, mechanics=replace(fall.mechanics, unforced=None))
    return Case("a fall that ends in the air, model not known", bare, severity="blocking")


GOOD = (
    lambda: Case("a body at rest on the ground", analytic.resting()),
    lambda: Case("a ball at the top of its bounce", analytic.bouncing()),
    lambda: Case("a pendulum", analytic.swinging()),
    lambda: Case("no gravity", replace(analytic.collision(), contacts=analytic.contacts(()))),
)
BAD = (_hanging, _stopped_falling)
