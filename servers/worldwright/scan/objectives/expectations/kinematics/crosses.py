"""A body passes a plane: a finish line, the edge of a table, the rim of a cup.

Measures how far its origin gets beyond the plane `axis` = `at_m` in the given sense, after it was before it, metres
(negative: it stays short). Source: kinematics.
"""

from typing import Literal

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, sliding
from ....measuring.channels import AXES
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE131"
EVENT = True
HAIR_M = 1e-9


class Given(OfBody):
    """The body, the plane, and the sense of the crossing."""

    axis: Literal["x", "y", "z"] = Field(description="the axis across the plane")
    at_m: float = Field(description="where the plane is on that axis, m")
    sense: Literal["up", "down"] = Field("up", description="towards larger coordinates (up) or smaller ones (down)")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure how far beyond the plane it gets."""
    rows = window(trajectory, given.window_s)
    sign = 1.0 if given.sense == "up" else -1.0
    ahead = sign * (trajectory.pos[rows, body_index(trajectory, given.body), AXES[given.axis]] - given.at_m)
    before = ahead < 0
    plane = f"{given.axis} = {given.at_m:g} m"
    if not before.any():
        return at_least(-float(ahead.min()) - HAIR_M, 0.0, "m", f"{given.body} is beyond {plane} from the start")
    start = int(before.argmax())
    beyond = float(ahead[start:].max())
    if beyond < 0:
        return at_least(beyond, 0.0, "m", f"{given.body} stays {-beyond:.4f} m short of {plane}")
    when = trajectory.t[rows][start + int(np.argmax(ahead[start:] >= 0))]
    return at_least(beyond, 0.0, "m", f"{given.body} crosses {plane} at {when:.3f} s and gets {beyond:.4f} m beyond")


GOOD = (
    (lambda: sliding(1.0, seconds=2.0), {"body": "body", "axis": "x", "at_m": 1.5}),
    (lambda: falling(5.0), {"body": "body", "axis": "z", "at_m": 4.0, "sense": "down"}),
)
BAD = (
    (lambda: sliding(1.0, seconds=2.0), {"body": "body", "axis": "x", "at_m": 2.5}),
    (lambda: falling(5.0), {"body": "body", "axis": "z", "at_m": 4.0, "sense": "up"}),
)
