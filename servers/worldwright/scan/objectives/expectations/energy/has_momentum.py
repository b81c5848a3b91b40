"""A body, or several together, has so much momentum, or gains so much.

Measures p = sum of m v over their centres of mass, kg m/s, along `direction` or in size: its mean or largest over the
window, at its end, or its change from the first to the last row of it. Source: Newton's second law; a change of momentum
is an impulse.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, falling, sliding
from ....measuring.measured import Measured, OfBodies, Point, between, masses, window

CODE = "WE205"


class Given(OfBodies):
    """Which number, and its range."""

    of: Literal["mean", "max", "final", "change"] = Field("mean", description="what of it over the window")
    min_kg_m_s: float | None = Field(None, description="least momentum, kg m/s")
    max_kg_m_s: float | None = Field(None, description="largest momentum, kg m/s")
    direction: Point | None = Field(None, description="direction of the world [x, y, z]; without it the size counts")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.min_kg_m_s is None and self.max_kg_m_s is None:
            raise ValueError("give min_kg_m_s, max_kg_m_s or both")
        if self.direction is not None and not any(self.direction):
            raise ValueError("a direction needs a length: [0, 0, 0] points nowhere")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The momentum."""
    bodies = given.indices(trajectory)
    rows = window(trajectory, given.window_s)
    p = np.einsum("b,tbi->ti", masses(trajectory)[bodies], trajectory.com_velocity[rows][:, bodies])
    if given.of == "change":
        p = p[-1:] - p[:1]
    if given.direction is None:
        along = np.linalg.norm(p, axis=1)
    else:
        along = p @ np.array(given.direction) / np.linalg.norm(given.direction)
    value = float({"mean": along.mean(), "max": along.max()}.get(given.of, along[-1]))
    message = f"the momentum of {' and '.join(given.names)} is {value:.4g} kg m/s ({given.of})"
    return between(value, given.min_kg_m_s, given.max_kg_m_s, "kg m/s", message)


GOOD = (
    (lambda: sliding(2.0), {"body": "body", "min_kg_m_s": 1.99, "max_kg_m_s": 2.01}),
    (
        lambda: falling(seconds=0.5),
        {"body": "body", "of": "change", "direction": [0, 0, -1], "min_kg_m_s": 0.49 * G, "max_kg_m_s": 0.51 * G},
    ),
)
BAD = (
    (lambda: sliding(2.0), {"body": "body", "min_kg_m_s": 2.1}),
    (lambda: falling(seconds=0.5), {"body": "body", "of": "change", "max_kg_m_s": 0.4 * G}),
    (lambda: falling(seconds=0.5), {"body": "body", "of": "final", "direction": [0, 0, 1], "min_kg_m_s": 0.1}),
)
