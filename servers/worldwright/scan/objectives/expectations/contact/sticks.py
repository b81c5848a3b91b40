"""Two bodies meet and stay together.

From `settle_s` after their first touch on, measures how far the one moves in the frame of the other, metres; they must
also still be in contact at the end. Source: the engine's contacts; kinematics (perfectly inelastic contact).
"""

import numpy as np
from pydantic import Field

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, collision
from ....known.meetings import caught
from ....measuring.measured import Measured, OfPair, all_of, at_least, at_most, pair_rows, window

CODE = "WE142"
EVENT = True


class Given(OfPair):
    """The two bodies, and the shift that is allowed."""

    max_m: float = Field(default=0.005, gt=0, description="largest shift of one against the other, m")
    settle_s: float = Field(default=0.05, ge=0, description="time they may take to settle after the first touch, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the shift."""
    rows = window(trajectory, given.window_s, 2)
    touching = pair_rows(trajectory, *given.bodies)[rows]
    t, pair = trajectory.t[rows], " and ".join(given.bodies)
    if not touching.any():
        return at_most(1e3, given.max_m, "m", f"{pair} never touch")
    met = float(t[touching.argmax()])
    after = t >= met + given.settle_s
    if after.sum() < 2:
        return at_least(float(t[-1]) - met, given.settle_s + trajectory.interval_s, "s", f"{pair} have only just met")
    place = _seen_from_other(trajectory, given.bodies, rows)[after]
    change = float(np.linalg.norm(place - place[0], axis=1).max())
    message = f"{pair} meet at {met:.3f} s, then shift by {change * 1000:.2f} mm against each other"
    # A contact may flicker at rest: it counts whether they still touch in the last rows.
    late = touching[-max(3, len(touching) // 100) :]
    together = at_least(float(late.any()), 1.0, "1", f"{message}, and they are apart in the end")
    return all_of(at_most(change, given.max_m, "m", message), together)


def _seen_from_other(trajectory: Trajectory, names: tuple[str, str], rows: slice) -> np.ndarray:
    """(R, 3) m: the origin of one body in the frame of the other, which is the world when one of them is."""
    one, other = (trajectory.index(name) for name in names)
    one, other = (other, one) if one < 0 else (one, other)
    if other < 0:
        return trajectory.pos[rows, one]
    away = trajectory.pos[rows, one] - trajectory.pos[rows, other]
    return np.einsum("tji,tj->ti", matrices(trajectory.quat[rows, other]), away)


GOOD = ((lambda: caught(), {"bodies": ["ball", "box"]}),)
BAD = (
    (collision, {"bodies": ["a", "b"]}),
    (lambda: bouncing(1.0, 0.8, seconds=0.8), {"bodies": ["ball", "ground"]}),
    (lambda: caught(slips=0.05), {"bodies": ["ball", "box"]}),
)
