"""A body is somewhere else one row later, although its velocity could not take it there.

What it means: somebody wrote a pose, or the solver threw the body. A collision changes a velocity in one step, never a
position, so a hard hit is not a teleport.

Formula: |x[n+1] - x[n]| - v dt > 0.1 r, with v the largest speed within two rows of the step (so that bounces between two
rows of a sparse recording are allowed, and 2 g dt^2 more) and r the body's bounding radius; likewise the angle between
orientations against w dt, by 0.25 rad. Where speeds were made up from the poses, the same jump shows as one displacement
that is eight times its neighbours' and more than half of r.
Threshold: a tenth of the body's own size in one step is visible at any scale, and rounding is 1e-10 of it.
Source: the reference paper's scanner; kinematics, |dx| <= integral of |v|.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import angles_between

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS102"
NEEDS = ("linvel",)
SIZE_FRACTION = 0.1
ANGLE_RAD = 0.25
NEIGHBOURS = 8.0


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the worst jump of each body."""
    if len(trajectory.t) < 2:
        return
    look, size = survey(trajectory), trajectory.size_m
    may = look.anywhere((look.excess > SIZE_FRACTION * size) | (look.lone > 0.5 * size) | (look.overturn > ANGLE_RAD))
    dt = np.diff(trajectory.t)
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    rounding = 1e-9 * float(np.abs((look.low, look.high)).max(initial=0.0))
    for b in np.flatnonzero(may & trajectory.moves_freely):
        step = np.diff(trajectory.pos[:, b], axis=0)
        moved = np.sqrt((step**2).sum(axis=1))
        limit = SIZE_FRACTION * size[b] + 2 * g * dt**2 + rounding
        isolated = _isolated(moved) & (moved > 0.5 * size[b])
        jumped = (moved - _fastest_nearby(trajectory.speed[:, b]) * dt > limit) | isolated
        if trajectory.mechanics.mocap is None and not trajectory.speed[:, b].any():
            # Without a model, a body that never has a velocity may be posed from outside: then only a lone jump counts.
            jumped &= isolated
        angle = angles_between(trajectory.quat[1:, b], trajectory.quat[:-1, b])
        spun = angle - 1.2 * _fastest_nearby(trajectory.spin[:, b]) * dt > ANGLE_RAD
        name = trajectory.names[b]
        declared = context.acts_on(name, ("pose",))
        severity = "info" if declared else "blocking"
        note = " (the plan declares that its pose is written)" if declared else ""
        if jumped.any():
            n = int(np.argmax(np.where(jumped, moved, 0.0)))
            message = f"{name} jumps {moved[n]:.3g} m in one step{_times(int(jumped.sum()))}{note}"
            yield Sign(name, (trajectory.t[n], trajectory.t[n + 1]), moved[n], limit[n], "m", severity, message)
        elif spun.any():
            n = int(np.argmax(np.where(spun, angle, 0.0)))
            message = f"{name} turns {np.degrees(angle[n]):.0f} degrees in one step{note}"
            yield Sign(name, (trajectory.t[n], trajectory.t[n + 1]), angle[n], ANGLE_RAD, "rad", severity, message)


def _fastest_nearby(speed: np.ndarray) -> np.ndarray:
    """(T-1,) m/s: the largest speed within two rows of each step."""
    best = np.maximum(speed[1:], speed[:-1])
    wide = best.copy()
    for shift in (1, 2):
        wide[shift:] = np.maximum(wide[shift:], best[:-shift])
        wide[:-shift] = np.maximum(wide[:-shift], best[shift:])
    return wide


def _isolated(moved: np.ndarray) -> np.ndarray:
    """(T-1,) bool: a large displacement between small ones."""
    near = np.zeros_like(moved)
    near[1:] += moved[:-1]
    near[:-1] += moved[1:]
    found = moved > NEIGHBOURS * near
    found[[0, -1]] = False
    return found


def _times(count: int) -> str:
    return f", the worst of {count} jumps" if count > 1 else ""


def _jump() -> Case:
    still = analytic.sliding()
    pos = still.pos.copy()
    pos[400:, 0, 0] += 0.3
    return Case("a sliding body skips 0.3 m", replace(still, pos=pos), severity="blocking")


def _consistent_jump() -> Case:
    still = analytic.resting()
    pos = still.pos.copy()
    pos[400:, 0, 1] += 0.2
    made = analytic.motion(still.t, pos, np.gradient(pos[:, 0], still.t, axis=0))
    return Case("velocities made up from the jump", made, severity="blocking")


def _flip() -> Case:
    still = analytic.resting()
    quat = still.quat.copy()
    quat[300:] = (0.0, 1.0, 0.0, 0.0)
    return Case("an orientation flips over", replace(still, quat=quat), severity="blocking")


GOOD = (
    lambda: Case("a ball hit at 20 m/s", analytic.collision(speeds=(0.0, -20.0))),
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a fast rolling ball", analytic.rolling(speed=8.0)),
)
BAD = (_jump, _consistent_jump, _flip)
