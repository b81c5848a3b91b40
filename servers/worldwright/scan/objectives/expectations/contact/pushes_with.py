"""Two bodies push on each other with a force in a given range.

Measures the sum of the normal forces between them, newtons: the largest of all rows, or the mean over the rows in
contact (hops of up to 20 ms included). A body at rest on level ground pushes with its weight, m g. Source: the engine's
contact forces; statics.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, falling, resting
from ....measuring.measured import Measured, OfPair, UnknowableError, between, bridged, contacts_of, window

CODE = "WE146"


class Given(OfPair):
    """The two bodies, and the range of the force."""

    of: Literal["max", "mean"] = Field("max", description="the largest force, or the mean while in contact")
    min_n: float | None = Field(None, ge=0, description="least force, N")
    max_n: float | None = Field(None, gt=0, description="largest force, N")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.min_n is None and self.max_n is None:
            raise ValueError("give min_n, max_n or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the force."""
    contacts = trajectory.contacts
    if contacts is None:
        raise UnknowableError("no contact forces were recorded")
    rows = window(trajectory, given.window_s)
    force = np.zeros(len(trajectory.t))
    mine = contacts_of(trajectory, *given.bodies)
    np.add.at(force, contacts.row[mine], contacts.normal_force[mine])
    force = force[rows]
    pushing = bridged(trajectory, force > 0)
    value = float(force.max() if given.of == "max" else force[pushing].mean() if pushing.any() else 0.0)
    message = f"{' and '.join(given.bodies)} push with {value:.4g} N ({given.of})"
    return between(value, given.min_n, given.max_n, "N", message)


GOOD = ((resting, {"bodies": ["body", "ground"], "of": "mean", "min_n": 0.99 * G, "max_n": 1.01 * G}),)
BAD = (
    (resting, {"bodies": ["body", "ground"], "min_n": 1.1 * G}),
    (resting, {"bodies": ["body", "ground"], "max_n": 0.9 * G}),
    (lambda: falling(touches=[]), {"bodies": ["body", "ground"], "min_n": 1}),
)
