"""A contact pushes a hundred times harder than the motion around it accounts for.

What it means: bodies were put inside each other, the contact is too stiff for the step, or a constraint fights it.
A real blow is as short and as hard, but then it changes the body's velocity; a spike does not, or throws the body away.

Formula: F, the sum of the contact forces on a body, against its usual value (the median while in contact) and its
weight. A spike has F > 100 times the larger, with nothing faster than sqrt(g r) / 2 in the 0.05 s before.
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
        for n in np.flatnonzero(column > limit):
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


def _pressed(force: float) -> Case:
    still = analytic.resting()
    push = np.full((len(still.t), 1), analytic.G)
    push[400] = force
    return Case("a push for one row", replace(still, contacts=None, contact_force_sum=push))


GOOD = (
    lambda: Case("a body at rest", analytic.resting()),
    lambda: _pressed(200.0),
)
BAD = (lambda: replace(_pressed(50_000.0), severity="blocking"),)
