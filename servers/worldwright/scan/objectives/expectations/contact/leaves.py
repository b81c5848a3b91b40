"""A body that touched another lets go of it: lifts off, is released, comes loose.

Measures the longest time that the two are apart after they have touched, seconds. Source: the engine's contacts.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....anomalies.sign import spans
from ....known.analytic import bouncing, collision, falling, resting
from ....measuring.measured import Measured, OfPair, at_least, pair_rows, window

CODE = "WE144"
EVENT = True


class Given(OfPair):
    """The two bodies, and how long they must be apart."""

    for_s: float = Field(default=0.05, gt=0, description="least time apart, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the longest time apart."""
    rows = window(trajectory, given.window_s, 2)
    touching, t = pair_rows(trajectory, *given.bodies)[rows], trajectory.t[rows]
    pair = " and ".join(given.bodies)
    if not touching.any():
        return at_least(0.0, given.for_s, "s", f"{pair} never touch, so they cannot part")
    first = int(touching.argmax())
    gaps = spans(~touching[first:]) + first
    if not len(gaps):
        return at_least(0.0, given.for_s, "s", f"{pair} do not part")
    apart = t[np.minimum(gaps[:, 1], len(t) - 1)] - t[gaps[:, 0]]
    longest = int(apart.argmax())
    message = f"{pair} part at {t[gaps[longest, 0]]:.3f} s for {apart[longest]:.3f} s"
    return at_least(float(apart[longest]), given.for_s, "s", message)


GOOD = (
    (collision, {"bodies": ["a", "b"], "for_s": 0.4}),
    (lambda: bouncing(1.0, 0.8), {"bodies": ["ball", "ground"], "for_s": 0.7}),  # 2 e sqrt(2 h / g) = 0.72 s
)
BAD = (
    (resting, {"bodies": ["body", "ground"]}),
    (lambda: bouncing(1.0, 0.8), {"bodies": ["ball", "ground"], "for_s": 0.75}),
    (lambda: falling(touches=[]), {"bodies": ["body", "ground"]}),
)
