"""When the bodies of a crowd, or the points of a medium, pass a plane of the world: what a stream's rate and its gaps are measured by."""

from typing import Literal

import numpy as np
from pydantic import Field

from ...model.recording.trajectory import Trajectory
from .channels import AXES, OfParts, group
from .measured import UnknowableError, masses


class OfStream(OfParts):
    """A crowd that passes a plane."""

    axis: Literal["x", "y", "z"] = Field("z", description="the plane lies at right angles to this axis of the world")
    at_m: float = Field(description="where the plane lies along it, m")


def passed(trajectory: Trajectory, given: OfStream, rows: slice) -> tuple[np.ndarray, np.ndarray]:
    """The moments, s, ascending, at which bodies first pass the plane within these rows, and which bodies those are, or which points.

    Both (N,); interpolated between rows, of points between the instants at which their law told them. What starts on the plane passes
    when it leaves it.
    """
    t, along, who = _along(trajectory, given, rows)
    side = along - given.at_m
    through = side[:-1] * side[1:] < 0
    through |= (side[:-1] == 0) & (side[1:] != 0)
    passing = np.flatnonzero(through.any(axis=0))
    first = through[:, passing].argmax(axis=0)
    before, after = side[first, passing], side[first + 1, passing]
    moments = t[first] + (t[first + 1] - t[first]) * before / (before - after)
    order = np.argsort(moments, kind="stable")
    return moments[order], who[passing[order]]


def weights(trajectory: Trajectory, given: OfStream) -> np.ndarray:
    """kg of each body, or of each point of the medium that is meant, which share its mass evenly.

    Raises:
        UnknowableError: the recording does not tell it.
    """
    if not _of_medium(trajectory, given):
        return np.asarray(masses(trajectory))
    number = trajectory.media.names.index(str(given.parts))  # laws come first, in the order of their sums
    if number >= len(trajectory.balances):
        raise UnknowableError(f"the recording does not tell the mass of '{given.parts}'")
    lay = trajectory.media.of(str(given.parts))
    count = len(lay.flat) // len(lay.t)
    return np.full(count, float(trajectory.balances[number].mass[-1]) / count)


def _of_medium(trajectory: Trajectory, given: OfStream) -> bool:
    return isinstance(given.parts, str) and given.parts in trajectory.media.names


def _along(trajectory: Trajectory, given: OfStream, rows: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Instants, (T,) s, where each was along the axis then, (T, n) m, and what they are called, (n,)."""
    axis = AXES[given.axis]
    if _of_medium(trajectory, given):
        lay, asked = trajectory.media.of(str(given.parts)), trajectory.t[rows]
        told = np.flatnonzero((lay.t >= asked[0] - 1e-9) & (lay.t <= asked[-1] + 1e-9))
        along = lay.flat.reshape(len(lay.t), -1, 3)[told, :, axis]
        return lay.t[told], np.asarray(along, dtype=float), np.arange(along.shape[1])
    bodies = np.array(group(trajectory, given.parts), dtype=int)
    return trajectory.t[rows], trajectory.pos[rows][:, bodies, axis], bodies
