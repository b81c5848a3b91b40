"""A body moves on a circle.

Fits a circle in the plane of the path (Kasa's algebraic fit) and measures the largest distance from it, relative to its
radius; the angle passed must reach `min_turns`, and the radius must agree when it is given. Source: uniform and
non-uniform circular motion; least-squares circle fit.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding, swinging
from ....known.motions import circling, orbiting
from ....measuring.curves import circle
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_least, at_most, body_index, close_to, window

CODE = "WE125"


class Given(OfBody):
    """The body, the tolerance, the turns to make, and the radius to expect."""

    tolerance: Tolerance = Field(description="largest deviation, as a share of the radius")
    min_turns: float = Field(default=0.5, gt=0, description="least angle passed, turns")
    radius_m: float | None = Field(None, gt=0, description="expected radius, m, within the same tolerance")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative deviation."""
    found = circle(trajectory.pos[window(trajectory, given.window_s, 5), body_index(trajectory, given.body)])
    share = found.deviation / found.radius if found.radius > 0 else 1.0
    turns = found.swept / (2 * np.pi)
    message = f"{given.body} is at most {share:.2%} off a circle of {found.radius:.4f} m, over {turns:.2f} turns"
    conditions = [at_most(share, given.tolerance, "1", message), at_least(turns, given.min_turns, "turns", message)]
    if given.radius_m:
        conditions.append(close_to(found.radius, given.radius_m, given.tolerance, "m", message))
    return all_of(*conditions)


GOOD = (
    (lambda: circling(1.0, 2.0, turns=2), {"body": "body", "tolerance": 0.01, "min_turns": 1.99, "radius_m": 1.0}),
    (lambda: swinging(amplitude_deg=60, seconds=1.0), {"body": "bob", "tolerance": 0.01, "min_turns": 0.3}),
)
BAD = (
    (lambda: circling(1.0, 2.0, turns=2), {"body": "body", "tolerance": 0.01, "radius_m": 1.2}),
    (lambda: circling(1.0, 2.0, turns=0.5), {"body": "body", "tolerance": 0.01, "min_turns": 1}),
    (lambda: orbiting(eccentricity=0.5), {"body": "body", "tolerance": 0.05}),
    (lambda: sliding(1.0), {"body": "body", "tolerance": 0.05}),
)
