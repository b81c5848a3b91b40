"""Bodies that grow as they warm: every length of a body is (1 + alpha (T - T0)) times that at the start, alike in all directions.

What stands in contact is pushed by the grown shape, so a rod that finds no room presses, and a ball that was a close fit is none any more.
Mass stays, and so do joints, whose places in a body do not move by what counts. Source: Ashcroft and Mermin, Solid State Physics, chapter
25: alpha of the temperature's range, a constant here.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ProgramError

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
PRIMITIVES = (2, 3, 4, 5, 6)
"""mjtGeom: sphere, capsule, ellipsoid, cylinder, box."""
MOST = 0.03
"""Of a length: what grows by more than that is drawn too small to be believed, for pictures show the sizes of the start."""


class Grown:
    """The shapes of bodies in a model, which follow their temperatures about the centre of mass.

    Args:
        model: the world at the start; its shapes are written from now on.
        bodies: (n,) numbers of bodies.
        expansion: (n,) 1/K, linear; 0 of a body that keeps its size.
        called: the names of all bodies of the model.

    Raises:
        ProgramError: a body that grows has a shape of a mesh, or a coefficient is below 0 or not finite.
    """

    def __init__(self, model: "mujoco.MjModel", bodies: Sequence[int], expansion: Array, called: Sequence[str]) -> None:
        self._model, self._expansion = model, expansion
        for row, body in enumerate(bodies):
            if not 0 <= expansion[row] < np.inf:
                cause = f"{called[body]!r} cannot grow: its expansion is {expansion[row]:g}"
                raise ProgramError(cause, "interventions", "give an expansion from 0, 1/K, linear")
        mine = [(row, geom) for row, body in enumerate(bodies) if expansion[row] for geom in _solid(model, body)]
        self._rows, self._geoms = np.array(mine, int).reshape(-1, 2).T
        for row, geom in mine:
            if int(model.geom_type[geom]) not in PRIMITIVES:
                cause = f"{called[bodies[row]]!r} cannot grow: its shape is that of a mesh"
                move = "make it a box, sphere, cylinder, capsule, ellipsoid, or a compound of these"
                raise ProgramError(cause, "interventions", move)
        middle = model.body_ipos[model.geom_bodyid[self._geoms]]
        self._middle, self._away = middle, model.geom_pos[self._geoms] - middle
        self._size, self._reach = model.geom_size[self._geoms].copy(), model.geom_rbound[self._geoms].copy()
        self._box = model.geom_aabb[self._geoms].copy()
        self._trees = []  # of each body that grows: its row, and the part of its boxes, about its own frame of inertia
        for row in sorted({row for row, _ in mine}):
            first, count = int(model.body_bvhadr[bodies[row]]), int(model.body_bvhnum[bodies[row]])
            own = slice(first, first + count)
            self._trees.append((row, own, model.bvh_aabb[own].copy()))

    def follow(self, warmer: Array) -> Array:
        """Grow by temperatures (n,) K above those of the start.

        Returns:
            (n,) length over that at the start, less one.

        Raises:
            ProgramError: a length has changed by more than `MOST`.
        """
        strain = np.asarray(self._expansion * warmer)
        if strain.size and (largest := float(np.abs(strain).max())) > MOST:
            cause = f"a body would change its lengths by {largest:.2g} of themselves, which nobody sees in a picture"
            raise ProgramError(cause, "interventions", f"keep it under {MOST:g}: a smaller expansion, or less heat")
        if len(self._geoms):
            factor = 1.0 + strain[self._rows][:, None]
            model = self._model
            model.geom_pos[self._geoms] = self._middle + self._away * factor
            model.geom_size[self._geoms] = self._size * factor
            model.geom_rbound[self._geoms] = self._reach * factor[:, 0]
            model.geom_aabb[self._geoms] = self._box * factor
            for row, own, boxes in self._trees:
                model.bvh_aabb[own] = boxes * (1.0 + strain[row])
        return strain


def _solid(model: "mujoco.MjModel", body: int) -> list[int]:
    """The geoms of a body that collide."""
    first, count = int(model.body_geomadr[body]), int(model.body_geomnum[body])
    return [g for g in range(first, first + count) if model.geom_contype[g] or model.geom_conaffinity[g]]
