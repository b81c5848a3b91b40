"""Bodies as small lumps of their geoms' volume, so that what is under a wavy surface can be summed at any lean.

A lump is under water from its lower end to its upper one by degrees: the share s of it, whose integral over the height is what
buoyancy's energy needs. Its forces and its energy agree, however the surface lies.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from worldkit.errors import ProgramError
from worldkit.naming import names

from ..variants.removal import taken_away

if TYPE_CHECKING:
    import mujoco

LUMPS = 360
"""Of one geom, about."""
DRAG = {2: 0.47, 3: 0.9, 4: 0.6, 5: 0.9, 6: 1.05, 7: 0.9}
"""mjtGeom: drag coefficients of spheres, capsules, ellipsoids, cylinders, boxes, meshes (Hoerner, Fluid-Dynamic Drag, chapter 3)."""
NEXT_TO_NOTHING = 1e-9
"""Of its volume has a body that a trial of causes took away: water does not rise for it."""
Array = np.ndarray


class Hulls:
    """The lumps of some bodies, L of them.

    Args:
        model: the world.
        bodies: numbers of n bodies.

    Raises:
        ProgramError: a body has nothing solid.
    """

    def __init__(self, model: "mujoco.MjModel", bodies: Sequence[int]) -> None:
        solid = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
        none = np.zeros(0)  # water may be there for itself
        places, volumes, owners = [np.zeros((0, 3))], [none], [np.zeros(0, int)]
        rises, sizes, drags = [none], [none], [none]
        for order, body in enumerate(bodies):
            own = model.geom_bodyid == body
            gone = not (own & solid).any() and taken_away(model, body)
            mine = np.flatnonzero(own if gone else own & solid)
            if not len(mine):
                name = names(model, "body", model.nbody)[body]
                cause = f"water cannot tell how much of {name!r} is under it: nothing of it is solid"
                raise ProgramError(cause, "interventions", "name bodies that collide")
            for geom in map(int, mine):
                points, volume = _lumps(model, geom)
                volume *= NEXT_TO_NOTHING if gone else 1.0
                turn = np.zeros(9)
                _rotation(model.geom_quat[geom], turn)
                places.append(points @ turn.reshape(3, 3).T + model.geom_pos[geom])
                volumes.append(np.full(len(points), volume / len(points)))
                owners.append(np.full(len(points), order))
                rises.append(np.full(len(points), (volume / len(points)) ** (1 / 3)))
                half = np.sort(model.geom_aabb[geom, 3:])
                sizes.append(np.full(len(points), float(half[1])))
                across = _face(int(model.geom_type[geom]), model.geom_size[geom], half)
                drags.append(np.full(len(points), DRAG.get(int(model.geom_type[geom]), 1.0) * across / volume))
        self.bodies = np.array(bodies, int)
        self.place, self.volume, self.owner = (np.concatenate(part) for part in (places, volumes, owners))
        """(L, 3) m in the body's frame, (L,) m^3, (L,) which of the n bodies."""
        self.rise, self.size, self.drag = (np.concatenate(part) for part in (rises, sizes, drags))
        """(L,) m: how high a lump is; half the middle width of its geom, m; 1/m: drag coefficient and face for each volume."""
        self._whose = (self.owner == np.arange(len(bodies))[:, None]).astype(float)
        self.whole = self.summed(self.volume)
        """(n,) m^3."""

    def at(self, data: "mujoco.MjData") -> Array:
        """(L, 3) m: where they are, world frame."""
        turn = data.xmat[self.bodies].reshape(-1, 3, 3)[self.owner]
        return np.asarray(np.einsum("lij,lj->li", turn, self.place) + data.xpos[self.bodies][self.owner])

    def under(self, above: Array) -> "tuple[Array, Array]":
        """(share under water, its integral over the height, m) of each lump, by how far the surface is above its middle, m."""
        s = np.clip(above / self.rise + 0.5, 0.0, 1.0)
        return s, self.rise * (s * s / 2 + np.maximum(above / self.rise - 0.5, 0.0))

    def summed(self, values: Array) -> Array:
        """(n, …) of each body, of values (L, …)."""
        return np.asarray(self._whose @ values)


def cross(a: Array, b: Array) -> Array:
    """(n, 3) vector products, without what makes numpy's slow for few."""
    x, y, z, u, v, w = a[:, 0], a[:, 1], a[:, 2], b[:, 0], b[:, 1], b[:, 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=1)


def _lumps(model: "mujoco.MjModel", geom: int) -> "tuple[Array, float]":
    """Points (L, 3) evenly within a geom, m in its frame, and its volume, m^3."""
    kind, size = int(model.geom_type[geom]), model.geom_size[geom]
    middle, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    filled = {2: 0.52, 4: 0.52, 5: 0.785, 3: 0.7, 6: 1.0}.get(kind, 0.5)
    cell = float(8 * half.prod() * filled / LUMPS) ** (1 / 3)
    counts = np.clip(np.round(2 * half / cell), 3, 60).astype(int)
    axes = [middle[i] + half[i] * ((2 * np.arange(counts[i]) + 1) / counts[i] - 1) for i in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    if kind == 6:
        return points, float(8 * half.prod())
    if kind in (2, 4):
        radii = np.full(3, size[0]) if kind == 2 else size
        within = ((points / radii) ** 2).sum(axis=1) <= 1
        return points[within], float(4 / 3 * np.pi * np.prod(radii))
    if kind in (3, 5):
        beyond = np.maximum(np.abs(points[:, 2]) - size[1], 0.0) if kind == 3 else 0.0
        within = (points[:, :2] ** 2).sum(axis=1) + beyond**2 <= size[0] ** 2
        ends = 4 / 3 * np.pi * size[0] ** 3 if kind == 3 else 0.0
        return points[within], float(2 * np.pi * size[0] ** 2 * size[1] + ends)
    if kind == 7:
        from scipy.spatial import ConvexHull

        first, count = (
            int(model.mesh_vertadr[model.geom_dataid[geom]]),
            int(model.mesh_vertnum[model.geom_dataid[geom]]),
        )
        hull = ConvexHull(model.mesh_vert[first : first + count].astype(float))
        within = (points @ hull.equations[:, :3].T + hull.equations[:, 3]).max(axis=1) <= 0
        return (points[within] if within.any() else points), float(hull.volume)
    name = names(model, "geom", model.ngeom)[geom]
    raise ProgramError(f"water cannot tell how much of {name!r} is under it", "interventions", "use solid shapes")


def _face(kind: int, size: Array, half: Array) -> float:
    """The area that a geom shows to what it moves through, m^2, on the mean."""
    if kind == 2:
        return float(np.pi * size[0] ** 2)
    full = 2 * half
    box = float((full[0] * full[1] + full[1] * full[2] + full[0] * full[2]) / 3)
    return box if kind == 6 else 0.8 * box


def _rotation(quat: Array, out: Array) -> None:
    import mujoco

    mujoco.mju_quat2Mat(out, quat)
