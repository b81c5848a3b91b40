"""A tendon, or the way between two bodies, keeps its length: a rod, an inextensible rope, a rigid link.

Measures the largest change |L - L0| / L0, with L0 the length at the start of the window. Source: the rigid-body
constraint.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.motions import orbiting
from ....known.structures import stretched
from ....measuring.channels import OfLength
from ....measuring.measured import Measured, Tolerance, UnknowableError, at_most, window

CODE = "WE223"
LASTING = True


class Given(OfLength):
    """The thing with a length, and the tolerance."""

    tolerance: Tolerance = Field(description="largest change of the length, relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest change."""
    channel = given.channel(trajectory)
    length = channel.values[window(trajectory, given.window_s)]
    if length[0] <= 0:
        raise UnknowableError(f"{channel.name} has no length at the start")
    change = float(np.abs(length / length[0] - 1).max())
    return at_most(change, given.tolerance, "1", f"{channel.name} keeps {length[0]:.4f} m within {change:.3%}")


GOOD = (
    (lambda: orbiting(eccentricity=0.0), {"bodies": ["sun", "body"], "tolerance": 1e-6}),
    (lambda: stretched(0.001), {"tendon": "rope", "tolerance": 0.002}),
)
BAD = (
    (lambda: stretched(0.1), {"tendon": "rope", "tolerance": 0.05}),
    (lambda: orbiting(eccentricity=0.3), {"bodies": ["sun", "body"], "tolerance": 0.1}),
)
