"""A moving body stops dead, and nothing stopped it.

What it means: its velocity was zeroed, it was frozen, or the picture goes on without the physics. Friction takes time,
and an obstacle shows as a contact.

Formula: one row's speed falls from v to less than 0.01 v, with v > 0.3 sqrt(g r). Nothing stopped it when no contact
began and no contact force of the body exceeds four times what it was before, in the rows around; beside gravity, a
sliding contact can take at most 2 g dt of speed in a row. A body that joints or ties could stop is not judged alone, but
that all moving bodies stop in the same row is. Where no model tells whether it has joints, it is a warning.
Threshold: friction of coefficient 2.
Source: Newton's second law.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS123"
SHOWN_AS = "speed"
NEEDS = ("linvel",)
WHOLE = True


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that stop for nothing."""
    if len(trajectory.t) < 4:
        return
    may = np.flatnonzero((survey(trajectory).halts > 0).any(axis=0) & trajectory.moves_freely)
    if not len(may):
        return
    scale, speed = trajectory.speed_scale[may], trajectory.speed[:, may]
    stopped = (speed[:-1] > 0.3 * scale) & (speed[1:] < 0.01 * speed[:-1])
    stopped[:-1] &= speed[2:] < 0.02 * speed[:-2]
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    stopped &= speed[:-1] > 3 * g * np.diff(trajectory.t)[:, None]
    free = trajectory.mechanics.unforced
    for column in np.flatnonzero(stopped.any(axis=0)):
        b = may[column]
        for n in np.flatnonzero(stopped[:, column]):
            alone = free is not None and bool(free[b])
            moving = trajectory.moves_freely & (trajectory.speed[n] > 0.3 * trajectory.speed_scale)
            crowd = int(stopped[n].sum()) >= max(2, int(moving.sum()))
            unknown = free is None and trajectory.touching is not None
            if (
                not (alone or crowd or unknown)
                or _was_hit(trajectory, int(b), int(n))
                or _passed_on(trajectory, int(b), int(n))
            ):
                continue
            name = trajectory.names[b]
            severity = "info" if context.acts_on(name, flight.PUSHES) else "blocking" if alone or crowd else "warn"
            message = f"{name} stops dead from {speed[n, column]:.3g} m/s, and nothing touches it that did not before"
            yield Sign(
                name,
                (trajectory.t[n], trajectory.t[n + 1]),
                speed[n, column],
                0.01 * speed[n, column],
                "m/s",
                severity,
                message,
            )
            break


def _passed_on(trajectory: Trajectory, b: int, n: int) -> bool:
    """Whether a body close by takes over the motion in the same step, by a blow that began and ended between two rows."""
    gained = np.sqrt(((trajectory.linvel[n + 1] - trajectory.linvel[n]) ** 2).sum(axis=1))
    away = np.sqrt(((trajectory.pos[n] - trajectory.pos[n, b]) ** 2).sum(axis=1))
    near = away < 2 * (trajectory.size_m + trajectory.size_m[b])
    near[b] = False
    return bool((near & (gained > 0.2 * trajectory.speed[n, b])).any())


def _was_hit(trajectory: Trajectory, b: int, n: int) -> bool:
    """Whether a contact began or grew around row `n`; True when contacts are not known."""
    rows = slice(max(0, n - 1), n + 3)
    early = slice(max(0, n - 6), max(1, n - 1))
    force = trajectory.contact_force_sum
    if force is None and trajectory.contacts is not None:
        force = np.zeros((len(trajectory.t), len(trajectory.names)))
        for body in (trajectory.contacts.body1, trajectory.contacts.body2):
            inside = body >= 0
            np.add.at(force, (trajectory.contacts.row[inside], body[inside]), trajectory.contacts.normal_force[inside])
    if force is not None:
        return bool(force[rows, b].max(initial=0.0) > 4 * max(force[early, b].max(initial=0.0), 1e-9))
    if trajectory.ncon is not None:
        return bool(trajectory.ncon[rows].max() > trajectory.ncon[early].max(initial=0))
    return True


def _between_rows() -> Trajectory:
    """A ball hits another between two rows: no row shows the contact."""
    made = analytic.collision(speeds=(1.0, 0.0))
    force = made.contact_force_sum
    return replace(made, contacts=None, contact_force_sum=None if force is None else np.full_like(force, force.min()))


def _frozen(base: Trajectory, title: str) -> Case:
    rows = base.t >= 0.4
    pos, vel = base.pos.copy(), base.linvel.copy()
    pos[rows], vel[rows] = pos[rows][0], 0.0
    return Case(title, replace(base, pos=pos, linvel=vel), severity="blocking")


GOOD = (
    lambda: Case("a body braked by friction", analytic.sliding(2.0, 5.0)),
    lambda: Case("a ball bouncing until it rests", analytic.bouncing(restitution=0.3)),
    lambda: Case("a ball stopped by an equal one", analytic.collision(speeds=(1.0, 0.0))),
    lambda: Case("stopped by an equal one between two rows", _between_rows()),
)
BAD = (
    lambda: _frozen(analytic.sliding(2.0), "a sliding body freezes"),
    lambda: _frozen(analytic.falling(seconds=0.8), "a falling body freezes"),
)
