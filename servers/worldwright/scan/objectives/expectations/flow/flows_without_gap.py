"""A stream does not break off: bodies pass a plane one after the other without a long pause.

Measures the longest time between one passing the plane and the next, seconds; with a window also from its start to the
first and from the last to its end. Source: kinematics; the continuity of a flow.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd, stream
from ....measuring.crossings import OfStream, passed
from ....measuring.measured import Measured, at_most, window

CODE = "WE269"


class Given(OfStream):
    """How continuous."""

    max_gap_s: float = Field(gt=0, description="longest pause, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The longest pause."""
    rows = window(trajectory, given.window_s, 2)
    moments, _ = passed(trajectory, given, rows)
    ends = trajectory.t[[rows.start, rows.stop - 1]]
    told = f"{given.told()} through {given.axis} = {given.at_m:g} m"
    if len(moments) < 2:
        gap = max(float(ends[1] - ends[0]), given.max_gap_s * (1 + 1e-9))
        return at_most(gap, given.max_gap_s, "s", f"no stream of {told}: {len(moments)} pass")
    marks = moments if given.window_s is None else np.concatenate([ends[:1], moments, ends[1:]])
    gaps = np.diff(marks)
    longest = int(gaps.argmax())
    message = f"{len(moments)} of {told}; the longest pause is {gaps[longest]:.3f} s, from {marks[longest]:.3f} s on"
    return at_most(float(gaps[longest]), given.max_gap_s, "s", message)


DROPS = {"parts": "drop_*", "axis": "z", "at_m": 0.0}
GOOD = (
    (stream, {**DROPS, "max_gap_s": 0.051}),
    (lambda: stream(pause_s=(1.0, 2.0)), {**DROPS, "max_gap_s": 0.06, "window_s": [0.0, 1.0]}),
)
BAD = (
    (lambda: stream(pause_s=(0.5, 1.0)), {**DROPS, "max_gap_s": 0.3}),
    (lambda: stream(pause_s=(1.0, 2.0)), {**DROPS, "max_gap_s": 0.5, "window_s": [0.0, 2.0]}),
    (crowd, {"parts": "grain_*", "axis": "z", "at_m": 5.0, "max_gap_s": 0.5}),
)
