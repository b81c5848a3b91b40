"""Two bodies move in opposite directions, after they have touched when `after_contact` is asked for.

Measures the cosine between their horizontal velocities just after they part (or over all rows): -1 is straight away
from each other. Both must be moving. Source: kinematics.
"""

import numpy as np

from ...model.trajectory import Trajectory
from ..analytic import collision
from ..measured import Measured, OfPair, body_index, pair_rows

CODE = "WE111"


class Given(OfPair):
    """after_contact: judge only after they have touched and parted; max_cosine: what still counts as opposite."""

    after_contact: bool = True
    max_cosine: float = -0.5


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The cosine between their velocities."""
    one, other = (body_index(trajectory, name) for name in given.bodies)
    row = len(trajectory.t) // 2
    if given.after_contact:
        touching = np.flatnonzero(pair_rows(trajectory, *given.bodies))
        if not len(touching):
            return Measured(1.0, "contact, then apart", -1.0, "1", f"{' and '.join(given.bodies)} never touch")
        gap = np.flatnonzero(np.diff(touching) > 1)
        row = min(int(touching[gap[0]] if len(gap) else touching[-1]) + 2, len(trajectory.t) - 1)
    a, b = trajectory.linvel[row, one, :2], trajectory.linvel[row, other, :2]
    speeds = float(np.linalg.norm(a)), float(np.linalg.norm(b))
    if min(speeds) < 1e-3:
        message = f"at {trajectory.t[row]:.3f} s one of them stands still ({speeds[0]:.3f} and {speeds[1]:.3f} m/s)"
        return Measured(0.0, f"cosine at most {given.max_cosine:g}", given.max_cosine, "1", message)
    cosine = float(a @ b / speeds[0] / speeds[1])
    message = f"at {trajectory.t[row]:.3f} s they move at {speeds[0]:.3f} and {speeds[1]:.3f} m/s, cosine {cosine:.3f}"
    return Measured(cosine, f"cosine at most {given.max_cosine:g}", given.max_cosine - cosine, "1", message)


GOOD = ((collision, {"bodies": ["a", "b"]}),)
BAD = ((lambda: collision(masses=(10.0, 1.0), speeds=(1.0, 0.0)), {"bodies": ["a", "b"]}),)
