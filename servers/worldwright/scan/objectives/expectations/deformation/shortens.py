"""A tendon, or the way between two bodies, gets shorter: a spring is pressed, a muscle pulls, a bumper gives.

Measures the largest shortening, (L0 - L) / L0, with L0 the length at the start of the window.
Source: Hooke's law; engineering strain.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import stretched
from ....measuring.channels import OfLength
from ....measuring.measured import Measured, UnknowableError, at_least, window

CODE = "WE222"
EVENT = True


class Given(OfLength):
    """The thing with a length, and the share to shorten by."""

    min_strain: float = Field(gt=0, lt=1, description="least decrease of the length, relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest shortening."""
    channel = given.channel(trajectory)
    length = channel.values[window(trajectory, given.window_s)]
    if length[0] <= 0:
        raise UnknowableError(f"{channel.name} has no length at the start")
    strain = float(1 - length.min() / length[0])
    message = f"{channel.name} shortens from {length[0]:.4f} m by {strain:.2%}"
    return at_least(strain, given.min_strain, "1", message)


GOOD = ((lambda: stretched(-0.2), {"tendon": "rope", "min_strain": 0.199}),)
BAD = (
    (lambda: stretched(-0.2), {"bodies": ["left", "right"], "min_strain": 0.21}),
    (stretched, {"tendon": "rope", "min_strain": 0.01}),
)
