"""A body moves along a straight line.

Fits the line through its path by total least squares, and measures the largest distance of the path from it, relative
to the length of the path along it. A body that hardly moves is on no line. Source: principal component analysis;
Newton's first law.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....known.motions import circling
from ....measuring.curves import line
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_least, at_most, body_index, window

CODE = "WE123"
LASTING = True


class Given(OfBody):
    """The body, the tolerance, and the least length."""

    tolerance: Tolerance = Field(description="largest deviation, as a share of the length")
    min_m: float = Field(default=0.01, gt=0, description="least length of the path, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative deviation."""
    path = trajectory.pos[window(trajectory, given.window_s, 3), body_index(trajectory, given.body)]
    found = line(path)
    share = found.deviation / found.length if found.length > 0 else 1.0
    message = f"{given.body} is at most {found.deviation * 1000:.2f} mm off a line of {found.length:.3f} m"
    return all_of(at_most(share, given.tolerance, "1", message), at_least(found.length, given.min_m, "m", message))


GOOD = ((lambda: sliding(1.0), {"body": "body", "tolerance": 0.001}),)
BAD = (
    (lambda: circling(1.0, 1.0, turns=0.25), {"body": "body", "tolerance": 0.1}),
    (resting, {"body": "body", "tolerance": 0.1}),
)
