"""A body that cools by Newton's law beside the engine."""

from dataclasses import replace

import numpy as np

from ...model.recording.solver_channels import SolverChannels
from ...model.recording.trajectory import Trajectory
from .analytic import sliding


def cooling(warm: float = 360.0, around: float = 290.0, takes: float = 0.5, seconds: float = 2.0) -> Trajectory:
    """`body` is at T = around + (warm - around) exp(-t / takes), K, and `plate` as it began; `heat.lost` in J, 100 of them a kelvin."""
    found = sliding(1.0, seconds=seconds)
    own = around + (warm - around) * np.exp(-found.t / takes)
    told = {"heat.temperature": np.stack([own, np.full_like(own, warm)], axis=1), "heat.lost": 100.0 * (warm - own)}
    beside = SolverChannels(told, {"heat.temperature": "K", "heat.lost": "J"}, {"heat": ("body", "plate")})
    return replace(found, beside=beside)
