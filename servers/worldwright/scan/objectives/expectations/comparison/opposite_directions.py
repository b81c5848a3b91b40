"""Two bodies move in opposite directions, after they have touched when `after_contact` is asked for.

Measures the cosine between their horizontal velocities just after they part (without `after_contact`: the mean over
the rows in which both move): -1 is straight away from each other. Both must be moving. Source: kinematics.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision
from ....measuring.measured import Measured, OfPair, at_most, body_index, pair_rows, window

CODE = "WE111"
EVENT = True
STILL_M_S = 1e-3


class Given(OfPair):
    """The two bodies, the contact to wait for, and the tolerance."""

    after_contact: bool = Field(default=True, description="judge only after they have touched and parted")
    max_cosine: float = Field(default=-0.5, ge=-1, lt=1, description="largest cosine that still counts as opposite")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the cosine between their velocities."""
    bodies = [body_index(trajectory, name) for name in given.bodies]
    part = window(trajectory, given.window_s)
    rows = np.arange(part.start, part.stop)
    if given.after_contact:
        touching = np.flatnonzero(pair_rows(trajectory, *given.bodies)[part]) + part.start
        if not len(touching):
            return at_most(1.0, given.max_cosine, "1", f"{' and '.join(given.bodies)} never touch")
        gap = np.flatnonzero(np.diff(touching) > 1)
        parted = int(touching[gap[0]] if len(gap) else touching[-1])
        if parted == part.stop - 1:
            return at_most(1.0, given.max_cosine, "1", f"{' and '.join(given.bodies)} still touch at the end")
        rows = np.array([min(parted + 2, part.stop - 1)])
    velocity = trajectory.linvel[rows][:, bodies, :2]
    speed = np.linalg.norm(velocity, axis=2)
    moving = speed.min(axis=1) >= STILL_M_S
    when = f"at {trajectory.t[rows[0]]:.3f} s" if len(rows) == 1 else "on average"
    if not moving.any():
        return at_most(1.0, given.max_cosine, "1", f"{when} one of them stands still")
    cosines = (velocity[:, 0] * velocity[:, 1]).sum(axis=1)[moving] / speed[moving].prod(axis=1)
    speeds = speed[moving].mean(axis=0)
    cosine = float(cosines.mean())
    message = f"{when} they move at {speeds[0]:.3f} and {speeds[1]:.3f} m/s, cosine {cosine:.3f}"
    return at_most(cosine, given.max_cosine, "1", message)


GOOD = ((collision, {"bodies": ["a", "b"]}), (collision, {"bodies": ["a", "b"], "after_contact": False}))
BAD = (
    (lambda: collision(masses=(10.0, 1.0), speeds=(1.0, 0.0)), {"bodies": ["a", "b"]}),
    (lambda: collision(speeds=(0.0, 0.0)), {"bodies": ["a", "b"], "max_cosine": 0.5}),
)
