"""When the bodies of a crowd pass a plane of the world: what a stream's rate and its gaps are measured by."""

from typing import Literal

import numpy as np
from pydantic import Field

from ...model.recording.trajectory import Trajectory
from .channels import AXES, OfParts, group


class OfStream(OfParts):
    """A crowd that passes a plane."""

    axis: Literal["x", "y", "z"] = Field("z", description="the plane lies at right angles to this axis of the world")
    at_m: float = Field(description="where the plane lies along it, m")


def passed(trajectory: Trajectory, given: OfStream, rows: slice) -> tuple[np.ndarray, np.ndarray]:
    """The moments, s, ascending, at which bodies first pass the plane within these rows, and which bodies those are.

    Both (N,); interpolated between rows. What starts on the plane passes when it leaves it.
    """
    bodies = np.array(group(trajectory, given.parts), dtype=int)
    side = trajectory.pos[rows][:, bodies, AXES[given.axis]] - given.at_m
    through = side[:-1] * side[1:] < 0
    through |= (side[:-1] == 0) & (side[1:] != 0)
    who = np.flatnonzero(through.any(axis=0))
    first = through[:, who].argmax(axis=0)
    before, after = side[first, who], side[first + 1, who]
    t = trajectory.t[rows]
    moments = t[first] + (t[first + 1] - t[first]) * before / (before - after)
    order = np.argsort(moments, kind="stable")
    return moments[order], bodies[who[order]]
