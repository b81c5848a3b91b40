"""A body has no weight: it rests or glides on in the air, with nothing under it and nothing holding it.

What it means: it is held by a hidden force, its gravity was switched off, its support is only drawn, its path is scripted,
or it was frozen.

Formula: for at least 0.3 s a loose body touches nothing in any row, and |dv/dt| < 0.05 g. A way of uniform motion that
short bounces interrupt does not count: each row's velocity must follow from the one before. Where the model is not known,
a body that fell freely before counts as loose.
Threshold: a body let go would have gained 3 m/s in that time. A warning where the weight went little by little in a
recording that names no forces (water, a thruster); blocking otherwise.
Source: Newton's second law; the facts on staging.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS124"
RELATIVE = True
REPAIR = "object_placement"
SHOWN_AS = "height"
NEEDS = ("linvel", "touching")
WHOLE = True
HELD_S = 0.3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that float."""
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    touching, loose = trajectory.touching, trajectory.mechanics.unforced
    if g == 0 or touching is None:
        return
    dt = np.diff(trajectory.t)[:, None]
    rows = max(3, round(HELD_S / trajectory.interval_s))
    for b in np.flatnonzero((survey(trajectory).weightless.sum(axis=0) >= rows) & trajectory.moves_freely):
        if loose is not None and not loose[b]:
            continue
        rate = np.diff(trajectory.com_velocity[:, b], axis=0) / dt
        even = np.sqrt((rate**2).sum(axis=1)) < 0.05 * g
        even &= ~(touching[1:, b] | touching[:-1, b])
        for start, stop in spans(even):
            if stop - start < rows or (loose is None and not _fell_before(trajectory, int(b), int(start))):
                continue
            if flight.sleeps_supported(trajectory, int(b), int(start + stop) // 2):
                continue
            name, seconds = trajectory.names[b], trajectory.t[stop] - trajectory.t[start]
            pull = np.sqrt((rate[max(0, start - 3) : start] ** 2).sum(axis=1))
            eased = len(pull) == 3 and bool(pull.max() < 0.5 * g)
            held = loose is None and not _at_once(trajectory, int(b), int(start))
            told = trajectory.interventions is not None or trajectory.every_step
            severity = (
                "info"
                if context.acts_on(name, flight.PUSHES)
                else "warn"
                if (eased and not told) or held
                else "blocking"
            )
            does = "hangs" if trajectory.speed[start:stop, b].max() < 0.1 * trajectory.speed_scale[b] else "glides"
            message = f"{name} {does} in the air for {seconds:.2g} s with nothing to hold it"
            yield Sign(name, (trajectory.t[start], trajectory.t[stop]), seconds, HELD_S, "s", severity, message)
            break


def _at_once(trajectory: Trajectory, b: int, row: int) -> bool:
    """Whether a free fall turned into hanging within three rows: a landing on something unseen takes longer."""
    dt = np.diff(trajectory.t[: row + 1])
    extra = np.diff(trajectory.linvel[: row + 1, b], axis=0) - trajectory.gravity * dt[:, None]
    free = np.flatnonzero(np.sqrt((extra**2).sum(axis=1)) < 0.3 * dt)
    return bool(len(free)) and row - int(free[-1]) <= 4


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
)
BAD = (_hanging, _stopped_falling)
