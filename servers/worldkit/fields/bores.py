"""A straight tube, found in the corners of the meshes that a body is made of: what currents run round in, whoever made it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..turning import matrices

if TYPE_CHECKING:
    import mujoco

MESH = 7
"""mjtGeom."""
HOLLOW = 0.3
"""A tube's bore is at least this share of its width."""
THINNEST = 0.005
"""And its wall at least this share of its radius."""
ROUND = 0.05
"""Its corners lie on its two cylinders, and these end together, but for this share."""


class Bore(NamedTuple):
    """A tube, in its body's frame; metres."""

    inner: float
    outer: float
    length: float
    middle: np.ndarray
    """(3,)"""
    turn: np.ndarray
    """(3, 3) axes of its own frame, as columns; the third is the tube's."""


def solid(model: "mujoco.MjModel", body: int) -> list[int]:
    """The geoms of a body that a field takes for it: those that collide, or where none does, all."""
    geoms = [int(g) for g in np.flatnonzero(model.geom_bodyid == body)]
    return [g for g in geoms if model.geom_contype[g] or model.geom_conaffinity[g]] or geoms


def of_geoms(model: "mujoco.MjModel", geoms: Sequence[int]) -> Bore | None:
    """The tube that these geoms make; None where they are none, or are not all meshes."""
    if not len(geoms) or any(model.geom_type[g] != MESH for g in geoms):
        return None
    points = np.concatenate([_corners(model, g) for g in geoms])
    low, high = points.min(axis=0), points.max(axis=0)
    middle = (low + high) / 2
    for axis in range(3):
        order = [(axis + 1) % 3, (axis + 2) % 3, axis]
        if (radii := radii_of(points[:, order] - middle[order])) is not None:
            return Bore(*radii, float((high - low)[axis]), middle, np.eye(3)[:, order])
    return None


def radii_of(points: np.ndarray) -> tuple[float, float] | None:
    """Inner and outer radius, m, of a straight tube along z about the origin, whose corners (v, 3) these are; None of any other shape.

    Every corner lies on one of two cylinders, both of which reach from end to end, and none within the bore.
    """
    radius, half = np.hypot(*points[:, :2].T), np.abs(points[:, 2]).max()
    outer, inner = float(radius.max()), float(radius.min())
    if not HOLLOW * outer < inner < (1 - THINNEST) * outer:
        return None
    outside = radius > (inner + outer) / 2
    flat = all(np.ptp(radius[side]) < ROUND * outer for side in (outside, ~outside))
    ends = all(np.ptp(points[side, 2]) > 2 * (1 - ROUND) * half for side in (outside, ~outside))
    return (inner, outer) if flat and ends else None


def _corners(model: "mujoco.MjModel", geom: int) -> np.ndarray:
    """(v, 3) m: of a mesh, in its body's frame."""
    mesh = int(model.geom_dataid[geom])
    first = model.mesh_vertadr[mesh]
    own = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    return np.asarray(model.geom_pos[geom] + own @ matrices(model.geom_quat[geom]).T)
