"""Two bodies in contact slide along each other.

Measures the slip: the relative speed of the two surfaces at the contact points, tangential to the contact, summed up
over the time in contact (hops of up to 20 ms included), metres. Rolling has none. Source: rigid-body kinematics, v + w x
r at the contact point.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, rolling, sliding
from ....measuring.measured import Measured, OfPair, UnknowableError, at_least, bridged, contacts_of, window

CODE = "WE143"
EVENT = True


class Given(OfPair):
    """The two bodies, and how far they slide."""

    min_m: float = Field(gt=0, description="least slip of the surfaces along each other, m")


def slip(trajectory: Trajectory, pair: tuple[str, str], rows: slice) -> np.ndarray:
    """(R,) m/s: the tangential speed between the surfaces, 0 without contact."""
    contacts = trajectory.contacts
    if contacts is None or contacts.position is None or contacts.normal is None:
        raise UnknowableError("no contact points were recorded")
    one, other = (trajectory.index(name) for name in pair)
    mine = contacts.live & contacts_of(trajectory, *pair) & (contacts.row >= rows.start) & (contacts.row < rows.stop)
    row, point, normal = contacts.row[mine], contacts.position[mine], contacts.normal[mine]

    def surface(body: int) -> np.ndarray:
        if body < 0:
            return np.zeros((len(row), 3))
        arm = point - trajectory.pos[row, body]
        return trajectory.linvel[row, body] + np.cross(trajectory.angvel[row, body], arm)

    relative = surface(one) - surface(other)
    along = relative - (relative * normal).sum(axis=1, keepdims=True) * normal
    found, count = np.zeros(rows.stop - rows.start), np.zeros(rows.stop - rows.start)
    np.add.at(found, row - rows.start, np.linalg.norm(along, axis=1))
    np.add.at(count, row - rows.start, 1)
    speed, touching = found / np.maximum(count, 1), count > 0
    if not touching.any():
        return speed
    rows_in = np.flatnonzero(touching)
    return np.where(bridged(trajectory, touching), np.interp(np.arange(len(speed)), rows_in, speed[rows_in]), 0.0)


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the slip in all."""
    rows = window(trajectory, given.window_s, 2)
    way = float((slip(trajectory, given.bodies, rows) * np.gradient(trajectory.t[rows])).sum())
    return at_least(way, given.min_m, "m", f"{' and '.join(given.bodies)} slide {way:.4f} m along each other")


GOOD = ((lambda: sliding(1.0, seconds=1.0), {"bodies": ["body", "ground"], "min_m": 0.99}),)
BAD = (
    (lambda: sliding(1.0, seconds=1.0), {"bodies": ["body", "ground"], "min_m": 1.1}),
    (lambda: rolling(1.0), {"bodies": ["ball", "ground"], "min_m": 0.001}),
    (lambda: falling(touches=[]), {"bodies": ["body", "ground"], "min_m": 0.001}),
)
