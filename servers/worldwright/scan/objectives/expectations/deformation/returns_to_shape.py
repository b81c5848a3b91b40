"""Something is deformed and returns to its shape: elastic.

Measures the deformation left at the end of the window (the mean of its last `for_s`), relative to the size; before, it
must have been deformed by at least `min_strain`. Parts are compared after the best rigid motion, so that moving and
turning as a whole is no deformation. Source: elasticity; Kabsch's alignment.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import beam, stretched
from ....measuring.measured import Measured, Tolerance, all_of, at_least, at_most, window
from ...shapes import OfShape, strain

CODE = "WE224"
EVENT = True


class Given(OfShape):
    """The thing deformed, the strain to reach, and what may be left of it."""

    min_strain: float = Field(gt=0, description="least deformation on the way, relative to the size")
    tolerance: Tolerance = Field(description="largest deformation left, as a share of the largest on the way")
    for_s: float = Field(default=0.05, gt=0, description="the time at the end that is judged, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the deformation left."""
    rows = window(trajectory, given.window_s, 3)
    chosen, channel = strain(trajectory, given, rows)
    t = trajectory.t[chosen]
    most = float(channel.values.max())
    left = float(channel.values[t >= t[-1] - given.for_s].mean())
    share = left / most if most > 0 else 0.0
    message = f"{channel.name} is deformed by {most:.2%} and keeps {left:.2%} of its size in the end"
    return all_of(at_least(most, given.min_strain, "1", message), at_most(share, given.tolerance, "1", message))


GOOD = (
    (lambda: beam("returns"), {"parts": "beam_*", "min_strain": 0.05, "tolerance": 0.03}),
    (lambda: beam("returns", drift=2.0), {"parts": "beam_*", "min_strain": 0.05, "tolerance": 0.03}),
    (lambda: stretched(0.2, "returns"), {"tendon": "rope", "min_strain": 0.19, "tolerance": 0.05}),
)
BAD = (
    (lambda: beam("keeps"), {"parts": "beam_*", "min_strain": 0.05, "tolerance": 0.5}),
    (lambda: beam("returns", sag=0.0, drift=2.0), {"parts": "beam_*", "min_strain": 0.01, "tolerance": 0.5}),
    (lambda: stretched(0.2, "keeps"), {"bodies": ["left", "right"], "min_strain": 0.1, "tolerance": 0.5}),
)
