"""A body rebounds with a given coefficient of restitution at its first impact with another.

Measures e = - (speed of parting) / (speed of approach), along the contact normal, from the rows just before they touch
and just after they part. e = 1 is elastic, 0 dead; a ball dropped from h rebounds to e^2 h.
Source: Newton's law of restitution.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, collision, resting
from ....measuring.measured import Measured, OfPair, Tolerance, contacts_of, pair_rows, window

CODE = "WE140"
EVENT = True


class Given(OfPair):
    """The two bodies, and the restitution to expect."""

    restitution: float = Field(ge=0, le=1, description="expected speed of parting over speed of approach")
    tolerance: Tolerance = Field(0.05, description="allowed difference, absolute")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the coefficient of restitution."""
    rows = window(trajectory, given.window_s)
    touching = np.flatnonzero(pair_rows(trajectory, *given.bodies)[rows]) + rows.start
    pair = " and ".join(given.bodies)
    expected = f"{given.restitution:g} within {given.tolerance:g}"

    def not_so(message: str) -> Measured:
        return Measured(0.0, expected, -max(given.restitution, given.tolerance), "1", message)

    if not len(touching):
        return not_so(f"{pair} never touch")
    gaps = np.flatnonzero(np.diff(touching) > 1)
    last = int(touching[gaps[0]] if len(gaps) else touching[-1])
    first = int(touching[0])
    if first == rows.start or last == rows.stop - 1:
        return not_so(f"{pair} touch from the start" if first == rows.start else f"{pair} do not part again")
    before, after = (_closing(trajectory, given.bodies, row, first) for row in (first - 1, last + 1))
    if before <= 0:
        return not_so(f"{pair} do not approach each other before they touch")
    e = -after / before
    message = f"{pair} meet at {before:.3f} m/s and part at {-after:.3f} m/s at {trajectory.t[last]:.3f} s: e = {e:.3f}"
    return Measured(e, expected, given.tolerance - abs(e - given.restitution), "1", message)


def _closing(trajectory: Trajectory, names: tuple[str, str], row: int, touch: int) -> float:
    """The speed at which two bodies approach along the normal of their first contact, m/s."""
    one, other = (trajectory.index(name) for name in names)
    normal, contacts = np.array([0.0, 0.0, 1.0]), trajectory.contacts
    if contacts is not None and contacts.normal is not None:
        mine = np.flatnonzero((contacts.row == touch) & contacts_of(trajectory, *names))
        if len(mine):
            normal = contacts.normal[mine].mean(axis=0) * (1.0 if contacts.body1[mine[0]] == one else -1.0)
    velocity = [trajectory.com_velocity[row, b] if b >= 0 else np.zeros(3) for b in (one, other)]
    return float((velocity[0] - velocity[1]) @ normal)


GOOD = (
    (lambda: bouncing(1.0, 0.8), {"bodies": ["ball", "ground"], "restitution": 0.8, "tolerance": 0.01}),
    (lambda: collision(restitution=0.5), {"bodies": ["a", "b"], "restitution": 0.5, "tolerance": 0.01}),
)
BAD = (
    (lambda: bouncing(1.0, 0.8), {"bodies": ["ball", "ground"], "restitution": 0.6}),
    (lambda: collision(restitution=0.5), {"bodies": ["a", "b"], "restitution": 1.0}),
    (resting, {"bodies": ["body", "ground"], "restitution": 0.5}),
)
