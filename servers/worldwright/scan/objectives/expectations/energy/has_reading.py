"""What a solver beside the engine records reaches, or keeps to, a value: a temperature, a water's level, the heat of a brake.

Measures a channel of a solver over the window: its mean, largest, smallest or last value, or its change from the first to the
last row. Channels: `heat.temperature` (K), `heat.melted` (share) of a `body`, `heat.lost` (J), `magnets.energy`,
`magnets.heat` (J), `charges.energy` (J), `water.level` (m). Source: the law of each solver (`worldengine.solvers`).
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.warming import cooling
from ....measuring.measured import Measured, Name, Windowed, between, window

CODE = "WE206"


class Given(Windowed):
    """Which channel, which number of it, and its range."""

    channel: Name = Field(description="SOLVER.CHANNEL, e.g. heat.temperature")
    body: Name | None = Field(None, description="of which body, where the channel has one number of each")
    of: Literal["mean", "max", "min", "final", "change"] = Field("final", description="what of it over the window")
    least: float | None = Field(None, description="least value, in the channel's unit")
    most: float | None = Field(None, description="largest value, in the channel's unit")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.least is None and self.most is None:
            raise ValueError("give least, most or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The number."""
    channel, unit = trajectory.beside.one(given.channel, given.body)
    values = channel[window(trajectory, given.window_s)]
    by = {"mean": values.mean(), "max": values.max(), "min": values.min(), "change": values[-1] - values[0]}
    value = float(by.get(given.of, values[-1]))
    whose = f" of {given.body}" if given.body else ""
    message = f"{given.channel}{whose} is {value:.6g} {unit} ({given.of}, from {values[0]:.6g} to {values[-1]:.6g})"
    return between(value, given.least, given.most, unit or "1", message)


END = 290.0 + 70.0 * float(np.exp(-4.0))
_OF = {"channel": "heat.temperature", "body": "body"}
GOOD = (
    (cooling, {**_OF, "least": END - 0.1, "most": END + 0.1}),
    (cooling, {**_OF, "of": "change", "most": -68.0}),
    (cooling, {"channel": "heat.lost", "of": "max", "least": 6800.0}),
    (cooling, {**_OF, "body": "plate", "of": "min", "least": 359.9}),
)
BAD = (
    (cooling, {**_OF, "least": END + 0.1}),
    (cooling, {**_OF, "of": "max", "most": 350.0}),
    (cooling, {"channel": "heat.lost", "of": "change", "least": 7100.0}),
    (cooling, {**_OF, "body": "plate", "of": "min", "least": 361.0}),
)
