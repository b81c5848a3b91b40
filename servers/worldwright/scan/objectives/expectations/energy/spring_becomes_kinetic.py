"""The energy of a released spring becomes kinetic energy.

Measures the kinetic energy that the bodies gain, J, against the spring's: k x^2 / 2 from `stiffness_n_m` and
`compression_m`, or without them what the recorded potential energy loses beyond that of weight. What weight takes or
gives on the way is allowed for. Source: Hooke's law, conservation of energy: v = x sqrt(k / m).
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.closed_forms import spring_energy
from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....known.oscillation import springing
from ....known.release import released
from ....measuring.energetics import kinetic, potential
from ....measuring.measured import Measured, OfBodies, Tolerance, UnknowableError, at_least, close_to, masses, window

CODE = "WE202"
EVENT = True


class Given(OfBodies):
    """The spring, the bodies, and the tolerance."""

    stiffness_n_m: float | None = Field(
        None, gt=0, description="stiffness, N/m; without it the recorded energy is used"
    )
    compression_m: float | None = Field(None, gt=0, description="how far it was pressed or pulled, m")
    tolerance: Tolerance = Field(0.05, description="relative")

    @model_validator(mode="after")
    def _both(self) -> "Given":
        if (self.stiffness_n_m is None) != (self.compression_m is None):
            raise ValueError("give both stiffness_n_m and compression_m, or neither")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the kinetic energy gained."""
    rows = window(trajectory, given.window_s, 2)
    bodies = given.indices(trajectory)
    moving = kinetic(trajectory, rows, bodies).sum(axis=1)
    weight = potential(trajectory, rows, bodies).sum(axis=1)
    gained = moving - moving[0] + weight - weight[0]
    top = int(moving.argmax())
    if given.stiffness_n_m and given.compression_m:
        stored = spring_energy(given.stiffness_n_m, given.compression_m)
    else:
        stored = _released(trajectory, rows, top)
    names = ", ".join(given.names)
    if stored <= 0:
        return at_least(0.0, 1e-9, "J", f"no spring energy is released while {names} speed up")
    message = f"{names} gain {gained[top]:.4g} J of the spring's {stored:.4g} J"
    return close_to(float(gained[top]), stored, given.tolerance, "J", message)


def _released(trajectory: Trajectory, rows: slice, top: int) -> float:
    """The loss of recorded potential energy up to the row `top`, beyond that of weight, J."""
    masses(trajectory)
    if trajectory.energy is None:
        raise UnknowableError("no energy was recorded", next_move="give stiffness_n_m and compression_m")
    dynamic = trajectory.mechanics.dynamic
    everyone = np.flatnonzero(dynamic) if dynamic is not None else np.arange(len(trajectory.names))
    weight = potential(trajectory, rows, everyone.tolist()).sum(axis=1)
    spring = trajectory.energy[rows, 0] - weight
    return float(spring[0] - spring[top])


GOOD = (
    (released, {"body": "body", "stiffness_n_m": 200.0, "compression_m": 0.1, "tolerance": 0.01}),
    (released, {"body": "body", "tolerance": 0.01}),
    (springing, {"body": "body", "stiffness_n_m": 40.0, "compression_m": 0.1, "tolerance": 0.01}),
)
BAD = (
    (released, {"body": "body", "stiffness_n_m": 400.0, "compression_m": 0.1}),
    (lambda: released(lost=0.3), {"body": "body"}),
    (lambda: sliding(1.0), {"body": "body", "stiffness_n_m": 200.0, "compression_m": 0.1}),
)
