"""The geoms of a world that matter may touch: what they are, where they are, whose they are, and which cell of the room sees them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ProgramError
from ..naming import names
from .transfer import MOST_PLANES
from .wall_cells import ON_ITS_WAY, SLACK, moved, sorted_in
from .wall_distance import HFIELD, MESH, look

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
MOST_FACES = 400
"""Of one hull; finer ones are thinned by leaving out faces that turn by less than `FLAT`."""
FLAT = 0.999
STILL = 0.07
"""Of the reach: a point that has moved less among geoms that have not keeps its walls."""
MOST_CELLS = 32_000
"""In which geoms are looked up."""


class Geoms:
    """What a law's bodies are made of.

    Args:
        model: the world.
        bodies: names; `world` is all that stands fast.
        cell: m, side of the cells in which geoms are looked up.

    Raises:
        ProgramError: a body is not there, or a mesh has no hull.
    """

    def __init__(self, model: "mujoco.MjModel", bodies: Sequence[str], cell: float) -> None:
        known, self.names = names(model, "body", model.nbody), names(model, "geom", model.ngeom)
        if lacking := [body for body in bodies if body not in known]:
            cause = f"the law acts on {lacking[0]!r}, which is no body of the world"
            raise ProgramError(cause, "worldkit.matter", f"name some of: {', '.join(known)}")
        self.bodies = np.array([known.index(body) for body in bodies])
        self._model, self._least, self.ids, owners = model, cell, [], []
        self._cell, self.poses = cell, np.zeros((0, 12))
        self._sorted: tuple[tuple[Array, Array], float, Array] | None = None
        """The room, the margin and the poses of which the lists are."""
        for row, body in enumerate(self.bodies):
            for geom in range(model.ngeom):
                owner = int(model.geom_bodyid[geom])
                mine = model.body_weldid[owner] == 0 if body == 0 else owner == body
                if mine and (model.geom_contype[geom] or model.geom_conaffinity[geom]):
                    self.ids.append(geom)
                    owners.append(row)
        self.owners = np.array(owners, np.int64)
        self._moves = np.array([model.body_weldid[model.geom_bodyid[geom]] != 0 for geom in self.ids], float)
        self.still = False
        """Whether all are where they were when they were placed before."""
        self.kinds = np.array([model.geom_type[geom] for geom in self.ids], np.int64)
        self.sizes = np.array([self._size(geom) for geom in self.ids]).reshape(-1, 3)
        count = len(self.ids)
        self._firsts, self._counts, self._rows, self._columns = np.zeros((4, count), np.int64)
        faces, heights = [np.zeros((0, 4))], [np.zeros(0)]
        for at, geom in enumerate(self.ids):
            if self.kinds[at] == MESH:
                self._firsts[at] = sum(map(len, faces))
                faces.append(self._hull(geom))
                self._counts[at] = len(faces[-1])
            if self.kinds[at] == HFIELD:
                field = model.geom_dataid[geom]
                rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
                first = int(model.hfield_adr[field])
                self._firsts[at], self._rows[at], self._columns[at] = sum(map(len, heights)), rows, columns
                heights.append(model.hfield_data[first : first + rows * columns] * model.hfield_size[field, 2])
        self._faces, self._heights = np.concatenate(faces), np.concatenate(heights).astype(float)
        self._boxes = np.array([model.geom_aabb[geom] for geom in self.ids]).reshape(-1, 6)

    def _size(self, geom: int) -> Array:
        if self._model.geom_type[geom] == HFIELD:
            return np.array(self._model.hfield_size[self._model.geom_dataid[geom], :3])
        return np.array(self._model.geom_size[geom])

    def _hull(self, geom: int) -> Array:
        """(f, 4) outward normals and offsets of a mesh's convex hull, in the geom's frame."""
        from scipy.spatial import ConvexHull, QhullError

        mesh = self._model.geom_dataid[geom]
        first = int(self._model.mesh_vertadr[mesh])
        corners = self._model.mesh_vert[first : first + int(self._model.mesh_vertnum[mesh])].astype(float)
        try:
            planes = ConvexHull(corners).equations
        except QhullError as error:
            cause = f"the mesh of the geom {self.names[geom]!r} has no convex hull"
            raise ProgramError(cause, "worldkit.matter", "give it thickness, or let it not collide") from error
        kept: list[Array] = []
        for plane in planes:
            if not kept or (np.array(kept)[:, :3] @ plane[:3]).max() < (FLAT if len(planes) > MOST_FACES else 1 - 1e-9):
                kept.append(plane)
        return np.array(kept) * (1, 1, 1, -1)

    def place(self, data: "mujoco.MjData") -> None:
        """Take the geoms' poses from the world's state."""
        at = np.array(self.ids, int)
        now = np.concatenate([data.geom_xpos[at], data.geom_xmat[at]], axis=1).reshape(-1, 12)
        self.still, self.poses = bool(np.array_equal(now, self.poses)), now

    def move(self, bodies: Array, seconds: float) -> None:
        """Carry the geoms on with their bodies (k, 9): middle at the start of the move, velocity and spin, for some seconds."""
        for row, body in enumerate(bodies):
            if not body[3:].any():
                continue
            spin, mine, self.still = body[6:] * seconds, self.owners == row, False
            angle = float(np.linalg.norm(spin))
            axis = spin / angle if angle > 1e-12 else np.zeros(3)
            k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
            turn = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
            self.poses[mine, :3] = body[:3] + seconds * body[3:6] + (self.poses[mine, :3] - body[:3]) @ turn.T
            self.poses[mine, 3:] = (turn @ self.poses[mine, 3:].reshape(-1, 3, 3)).reshape(-1, 9)

    def gone(self, since: Array, rows: Sequence[int]) -> float:
        """m: the most that any place of a geom of some bodies has moved since all had these poses, (g, 12)."""
        mine = np.isin(self.owners, rows)
        return moved(since[mine], self.poses[mine], self._boxes[mine])

    def sort(self, low: Array, high: Array, margin: float) -> None:
        """List, for each cell of the room from `low` to `high`, the geoms that come within `margin` of it, unless lists still stand."""
        low, high = np.asarray(low, float), np.asarray(high, float)
        slack, way = SLACK * self._least / 2, ON_ITS_WAY * self._least / 2
        if self._sorted is not None:
            at, had, poses = self._sorted
            fits = (low >= at[0]).all() and (high <= at[1]).all() and had == margin
            if fits and moved(poses, self.poses, self._boxes) <= slack:
                return
        self._low, high = low - self._least, high + self._least
        self._cell = max(self._least / 2, float(np.cbrt(np.prod(high - self._low) / MOST_CELLS)))
        self._cells = np.maximum(np.ceil((high - self._low) / self._cell).astype(np.int64), 1)
        count = int(self._cells.prod())
        self._starts = np.zeros(count + 1, np.int64)
        self._listed = sorted_in(
            self.kinds, self.sizes, self.poses, self._boxes, self._firsts, self._counts, self._faces, self._heights,
            self._rows, self._columns, self._low, self._cell, self._cells, margin + self._moves * (slack + way), self._starts,
            np.zeros(count, np.int64),
        )  # fmt: skip
        self._sorted = ((self._low, high), margin, self.poses.copy())

    def near(
        self, points: Array, count: int, reach: float, planes: Array, walls: Array, near: Array, seen: Array
    ) -> None:
        """Write the walls of the first `count` points, as `look`; where the geoms are still, those of points that have moved."""
        look(
            points, count, reach, self.kinds, self.sizes, self.poses, self._firsts, self._counts, self.owners,
            self._faces, self._heights, self._rows, self._columns, self._low, self._cell, self._cells, self._starts,
            self._listed, planes, walls, near, seen, STILL * reach if self.still else 0.0,
        )  # fmt: skip

    def gaps(self, points: Array) -> tuple[Array, Array]:
        """(n,) m to the nearest wall that is within two cells, infinite where there is none, and (n,) rows of its body."""
        many = len(points)
        planes, walls = np.zeros((many, MOST_PLANES, 4)), np.zeros((many, MOST_PLANES), np.int64)
        near = np.zeros(many, np.int64)
        margin = 2 * self._least
        self.sort(points.min(axis=0) - margin, points.max(axis=0) + margin, margin)
        self.near(np.ascontiguousarray(points), many, margin, planes, walls, near, np.full((many, 3), np.inf))
        gap = np.einsum("ij,ij->i", planes[:, 0, :3], points) - planes[:, 0, 3]
        return np.where(near > 0, gap, np.inf), walls[:, 0]
