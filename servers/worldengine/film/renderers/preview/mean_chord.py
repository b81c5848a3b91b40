"""How thick a mesh is on average, which decides how deep the colour of what is clear is, and how far it bends what is behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

LEAST_M = 1e-4


def of_capsule(radius_m: float, half_m: float) -> float:
    """The same of a capsule of a radius and half a length, m, whose ends are beyond that length."""
    return radius_m * (1.5 * half_m + radius_m) / (half_m + radius_m)


def radius(model: mujoco.MjModel, mesh: int) -> float:
    """The radius, m, of the ball that light crosses on ways as long, on the mean, as through a mesh: 3 V / A.

    The mean chord of a convex body is 4 V / A (Cauchy), and so it is of a vessel's walls, taken one by one.
    """
    start, count = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    first = int(model.mesh_vertadr[mesh])
    corners = model.mesh_vert[first + model.mesh_face[start : start + count].astype(np.int64)].astype(float)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = 0.5 * np.linalg.norm(across, axis=1).sum()
    volume = abs(float(np.einsum("fi,fi->", corners[:, 0], across))) / 6.0
    return max(3.0 * volume / max(float(area), 1e-12), LEAST_M)
