"""Measure how deep a body is under a level surface that the plan states."""

import numpy as np

from worldkit.turning import matrices

from ...model.recording.trajectory import Trajectory
from .measured import UnknowableError

Array = np.ndarray


def extent(trajectory: Trajectory, body: int, rows: slice) -> tuple[Array, Array]:
    """(R,) m each: heights of the lowest and highest points of a body's bounding box, or of its sphere if it is one."""
    facts = trajectory.mechanics
    if facts.half_extents is None or facts.center is None or np.isnan(facts.half_extents[body]).any():
        raise UnknowableError(f"the recording does not tell the size of {trajectory.names[body]}")
    turn = matrices(trajectory.quat[rows, body])
    middle = trajectory.pos[rows, body, 2] + turn[:, 2] @ facts.center[body]
    half = facts.half_extents[body]
    reach = np.full(len(middle), half.max()) if is_sphere(trajectory, body) else np.abs(turn[:, 2]) @ half
    return middle - reach, middle + reach


def submerged(trajectory: Trajectory, body: int, rows: slice, surface_m: float) -> Array:
    """(R,) share of the body's volume under the surface: exact for a sphere and for an upright box or cylinder."""
    low, high = extent(trajectory, body, rows)
    depth = np.clip((surface_m - low) / (high - low), 0.0, 1.0)
    return depth**2 * (3 - 2 * depth) if is_sphere(trajectory, body) else depth


def is_sphere(trajectory: Trajectory, body: int) -> bool:
    """Whether all geoms of the body are spheres."""
    facts = trajectory.mechanics
    if facts.geom_body is None or not facts.geom_type:
        return False
    own = [kind for kind, owner in zip(facts.geom_type, facts.geom_body, strict=False) if owner == body]
    return bool(own) and all(kind == "sphere" for kind in own)
