"""Something is deformed and keeps its new shape: plastic.

Measures the deformation at the end of the window, relative to the size; over its last `for_s` it may not change by more
than `tolerance` of that. Parts are compared after the best rigid motion. Source: plasticity; Kabsch's alignment.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import beam, stretched
from ....measuring.measured import Measured, Tolerance, all_of, at_least, at_most, window
from ...shapes import OfShape, strain

CODE = "WE225"
EVENT = True


class Given(OfShape):
    """The thing deformed, the strain to keep, and how steadily."""

    min_strain: float = Field(gt=0, description="least deformation in the end, relative to the size")
    tolerance: Tolerance = Field(0.1, description="largest change in the last `for_s`, as a share of the deformation")
    for_s: float = Field(default=0.2, gt=0, description="the time at the end in which the shape must not change, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the deformation in the end."""
    rows = window(trajectory, given.window_s, 3)
    chosen, channel = strain(trajectory, given, rows)
    t = trajectory.t[chosen]
    late = channel.values[t >= t[-1] - given.for_s]
    left = float(late[-1])
    change = float(np.ptp(late) / left) if left > 0 else 0.0
    message = f"{channel.name} is deformed by {left:.2%} in the end, which changes by {change:.1%} of that"
    return all_of(at_least(left, given.min_strain, "1", message), at_most(change, given.tolerance, "1", message))


GOOD = (
    (lambda: beam("keeps"), {"parts": "beam_*", "min_strain": 0.05}),
    (lambda: stretched(0.2, "keeps"), {"tendon": "rope", "min_strain": 0.199}),
)
BAD = (
    (lambda: beam("returns"), {"parts": "beam_*", "min_strain": 0.05}),
    (lambda: beam("rings"), {"parts": "beam_*", "min_strain": 0.001}),
    (lambda: stretched(0.2, "keeps"), {"tendon": "rope", "min_strain": 0.3}),
)
