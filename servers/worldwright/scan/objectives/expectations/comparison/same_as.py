"""Two bodies agree in what they do: the same period, the same fall, the same speed.

Measures the difference of a quantity relative to the larger of the two. Dropped together, a heavy and a light body land
together (Galileo); pendulums of equal length swing alike, whatever their mass. Source: the equivalence of inertial and
gravitational mass.
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, swinging
from ....known.motions import two
from ....measuring.measured import Measured, OfPair, Tolerance, at_most, body_index, window
from ...quantities import OUTCOMES

CODE = "WE283"


class Given(OfPair):
    """The two bodies, the quantity, and the tolerance."""

    of: Literal[
        "max_speed", "mean_speed", "final_speed", "max_spin", "max_height", "min_height", "final_height",
        "rise", "drop", "displacement", "path", "rest_time", "contact_time", "period",
    ] = Field(description="what is compared; times count from the start of the window")  # fmt: skip
    tolerance: Tolerance = Field(0.02, description="largest difference, relative to the larger")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative difference."""
    rows = window(trajectory, given.window_s)
    unit, of = OUTCOMES[given.of]
    one, other = (of(trajectory, body_index(trajectory, name), rows) for name in given.bodies)
    scale = max(abs(one), abs(other))
    share = abs(one - other) / scale if scale > 0 else 0.0
    message = f"{given.of.replace('_', ' ')}: {given.bodies[0]} {one:.4g} {unit}, {given.bodies[1]} {other:.4g} {unit}"
    return at_most(share, given.tolerance, "1", message)


def dropped_together() -> Trajectory:
    """A heavy and a light ball dropped from the same height."""
    return two(bouncing(1.0, 0.3, mass=1.0), bouncing(1.0, 0.3, mass=10.0))


GOOD = (
    (dropped_together, {"bodies": ["a", "b"], "of": "contact_time", "tolerance": 0.005}),
    (lambda: two(swinging(1.0), swinging(1.0, 10.0)), {"bodies": ["a", "b"], "of": "period"}),
)
BAD = (
    (lambda: two(bouncing(1.0, 0.3), bouncing(2.0, 0.3)), {"bodies": ["a", "b"], "of": "contact_time"}),
    (lambda: two(swinging(1.0), swinging(1.2)), {"bodies": ["a", "b"], "of": "period"}),
)
