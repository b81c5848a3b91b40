"""A contact pushes a hundred times harder than the motion around it accounts for.

What it means: bodies were put inside each other, the contact is too stiff for the step, or a constraint fights it.
A real blow is as short and as hard, but then it changes the body's velocity; a spike does not, or throws the body away. A load
that is put on, a boot on a twig, grows to what it is.

Formula: F, the sum of the contact forces on a body, against its usual value (the median while in contact) and its
weight. A spike has F > 100 times the larger, with nothing faster than sqrt(g r) / 2 in the 0.05 s before, and not within a load that grows, from less than half, for ten rows to its most.
Threshold: 100: a thing of a kilogram pressed with a tonne.
Source: the impulse-momentum theorem.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS127"
RELATIVE = True
NEEDS = ("linvel", "touching")
WHOLE = True
FACTOR = 100.0
BLOW_S = 0.05
GROWS_ROWS = 10


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the worst spike of each body."""
    force, most = forces(trajectory), (survey(trajectory).touches > 0).any(axis=0)
    mass, g = trajectory.mechanics.mass, float(np.sqrt((trajectory.gravity**2).sum()))
    for b in np.flatnonzero(most & trajectory.moves_freely):
        column = force[:, b]
        pressed = column[column > 0]
        if not len(pressed):
            continue
        usual = float(np.median(pressed))
        weight = 0.0 if mass is None else float(mass[b]) * g
        limit = FACTOR * max(usual, weight)
        if limit <= 0 or (mass is None and len(pressed) < 20):
            continue
        for n in _not_put_on(column, limit):
            if _struck(trajectory, int(n)):
                continue
            name = trajectory.names[b]
            message = f"a contact presses {name} with {force[n, b]:.3g} N, {force[n, b] / (limit / FACTOR):.0f} times the usual"
            severity = "warn" if mass is None else "blocking"  # neither its weight nor what pulls at it is known
            yield Sign(name, (trajectory.t[n], trajectory.t[n]), force[n, b], limit, "N", severity, message)
            break


def forces(trajectory: Trajectory) -> np.ndarray:
    """(T, B) N: the sum of the magnitudes of the contact forces on each body."""
    if trajectory.contact_force_sum is not None:
        return trajectory.contact_force_sum
    total = np.zeros((len(trajectory.t), len(trajectory.names)))
    if trajectory.contacts is not None:
        for body in (trajectory.contacts.body1, trajectory.contacts.body2):
            inside = body >= 0
            np.add.at(total, (trajectory.contacts.row[inside], body[inside]), trajectory.contacts.normal_force[inside])
    return total


def _struck(trajectory: Trajectory, n: int) -> bool:
    """Whether anything was fast enough shortly before row `n` to have struck a blow."""
    rows = max(3, round(BLOW_S / trajectory.interval_s))
    before = trajectory.speed[max(0, n - rows) : n + 1]
    return bool((before > 0.5 * trajectory.speed_scale).any())


def _not_put_on(column: np.ndarray, limit: float) -> np.ndarray:
    """The rows of a force (T,) above a limit, but for those of loads that begin with less than half and grow for rows to their most."""
    rows = np.flatnonzero(column > limit)
    if not len(rows):
        return rows
    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
    sudden = [r for r in runs if column[r].argmax() < GROWS_ROWS or column[r[0]] > column[r].max() / 2]
    return np.concatenate(sudden or [rows[:0]])


def _pressed(force: float, rows: int = 1) -> Case:
    still = analytic.resting()
    push = np.full((len(still.t), 1), analytic.G)
    push[400 - rows : 400, 0] += force * np.arange(1, rows + 1) / rows
    return Case(f"a push that grows for {rows} rows", replace(still, contacts=None, contact_force_sum=push))


GOOD = (
    lambda: Case("a body at rest", analytic.resting()),
    lambda: _pressed(200.0),
    lambda: _pressed(50_000.0, rows=200),
)
BAD = (
    lambda: replace(_pressed(50_000.0), severity="blocking"),
    lambda: replace(_pressed(50_000.0, rows=5), severity="blocking"),
)
