"""Bodies that belong together stay so, as one rigid piece.

Measures the largest change of the distance between the origins of any two of them since the start of the window,
metres. Source: the rigid-body constraint.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.structures import beam, breaking
from ....measuring.channels import OfParts, group
from ....measuring.measured import Measured, UnknowableError, at_most, window

CODE = "WE244"
LASTING = True
MOST_ROWS = 400


class Given(OfParts):
    """The bodies, and the tolerance."""

    max_m: float = Field(gt=0, description="largest change of a distance between two parts, m")

    @model_validator(mode="after")
    def _several(self) -> "Given":
        if not isinstance(self.parts, str) and len(self.parts) < 2:
            raise ValueError("name at least two bodies")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest change of a distance."""
    rows = window(trajectory, given.window_s)
    bodies = group(trajectory, given.parts)
    if len(bodies) < 2:
        raise UnknowableError(f"'{given.parts}' is one body only", next_move="name at least two")
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    path = trajectory.pos[chosen][:, bodies]
    worst, pair = 0.0, (0, 1)
    for k in range(len(bodies) - 1):
        apart = np.linalg.norm(path[:, k + 1 :] - path[:, k : k + 1], axis=2)
        change = np.abs(apart - apart[0]).max(axis=0)
        if change.max() > worst:
            worst, pair = float(change.max()), (k, k + 1 + int(change.argmax()))
    names = " and ".join(trajectory.names[bodies[k]] for k in pair)
    return at_most(
        worst, given.max_m, "m", f"the distance of {names} changes by {worst * 1000:.2f} mm, the most of all"
    )


GOOD = (
    (lambda: breaking(None), {"parts": ["upper", "lower"], "max_m": 0.001}),
    (lambda: beam(sag=0.0, drift=2.0), {"parts": "beam_*", "max_m": 1e-6}),
)
BAD = (
    (breaking, {"parts": ["upper", "lower"], "max_m": 0.1}),
    (beam, {"parts": "beam_*", "max_m": 0.01}),
)
