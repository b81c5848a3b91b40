"""A tendon, or the way between two bodies, gets longer.

Measures the largest strain, (L - L0) / L0, with L0 the length at the start of the window. A spring of stiffness k under
a force F stretches by F / k. Source: Hooke's law; engineering strain.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import stretched
from ....measuring.channels import OfLength
from ....measuring.measured import Measured, UnknowableError, at_least, window

CODE = "WE221"
EVENT = True


class Given(OfLength):
    """The thing with a length, and the strain to reach."""

    min_strain: float = Field(gt=0, description="least increase of the length, relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest strain."""
    channel = given.channel(trajectory)
    length = channel.values[window(trajectory, given.window_s)]
    if length[0] <= 0:
        raise UnknowableError(f"{channel.name} has no length at the start")
    strain = float(length.max() / length[0] - 1)
    message = f"{channel.name} stretches from {length[0]:.4f} m by {strain:.2%}"
    return at_least(strain, given.min_strain, "1", message)


GOOD = (
    (stretched, {"tendon": "rope", "min_strain": 0.199}),
    (stretched, {"bodies": ["left", "right"], "min_strain": 0.199}),
)
BAD = (
    (stretched, {"tendon": "rope", "min_strain": 0.21}),
    (lambda: stretched(-0.2), {"bodies": ["left", "right"], "min_strain": 0.01}),
)
