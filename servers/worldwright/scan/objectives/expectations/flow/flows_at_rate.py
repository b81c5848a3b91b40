"""A stream of bodies, or of a law's points, passes a plane at a rate: grains of an hourglass, balls of a conveyor, drops of a tap.

Measures how many of them, or how much mass, first pass the plane within the window, per second of it. Source: the
definition of a flow; conservation of mass.
"""

from typing import Literal

from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.flow import stream
from ....known.own_laws import strewn
from ....measuring.crossings import OfStream, passed, weights
from ....measuring.measured import Measured, between, window

CODE = "WE268"


class Given(OfStream):
    """How fast."""

    of: Literal["count", "mass"] = Field("count", description="bodies per second, or kilograms per second")
    min_rate: float | None = Field(None, ge=0, description="least rate, 1/s or kg/s")
    max_rate: float | None = Field(None, gt=0, description="largest rate, 1/s or kg/s")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.min_rate is None and self.max_rate is None:
            raise ValueError("give min_rate, max_rate or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The rate."""
    rows = window(trajectory, given.window_s, 2)
    _, who = passed(trajectory, given, rows)
    seconds = float(trajectory.t[rows.stop - 1] - trajectory.t[rows.start])
    amount = float(weights(trajectory, given)[who].sum()) if given.of == "mass" else float(len(who))
    unit = "kg/s" if given.of == "mass" else "1/s"
    message = f"{len(who)} of {given.told()} pass {given.axis} = {given.at_m:g} m in {seconds:.3f} s"
    return between(amount / seconds, given.min_rate, given.max_rate, unit, message)


SNOW = {"parts": "snow", "axis": "z", "at_m": 0.0, "window_s": [0.2, 1.8]}
DROPS = {"parts": "drop_*", "axis": "z", "at_m": 0.0}
GOOD = (
    (stream, {**DROPS, "min_rate": 19.9, "max_rate": 20.1}),
    (stream, {**DROPS, "of": "mass", "min_rate": 0.199, "max_rate": 0.201}),
    (lambda: stream(pause_s=(1.0, 2.0)), {**DROPS, "min_rate": 19.9, "window_s": [0.0, 1.0]}),
    (strewn, {**SNOW, "min_rate": 19.3, "max_rate": 20.7}),
    (strewn, {**SNOW, "of": "mass", "min_rate": 0.193, "max_rate": 0.207}),
)
BAD = (
    (stream, {**DROPS, "min_rate": 21}),
    (stream, {**DROPS, "max_rate": 19}),
    (strewn, {**SNOW, "max_rate": 19}),
    (strewn, {**SNOW, "of": "mass", "min_rate": 0.21}),
    (lambda: stream(pause_s=(1.0, 2.0)), {**DROPS, "min_rate": 19}),
)
