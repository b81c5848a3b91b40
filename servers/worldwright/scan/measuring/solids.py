"""The surface of a soft body, or of a skin that a law moves, over time, and the volume inside it."""

from typing import Any

import numpy as np

from ...model.errors import NotFoundError
from ...model.recording.trajectory import Trajectory
from .measured import UnknowableError

Array = np.ndarray


def skin(trajectory: Trajectory, name: str, rows: Array) -> tuple[Array, Array]:
    """The vertices (R, V, 3), m, of a solid flex at these rows, and the triangles (F, 3) of its closed surface, outwards; or of
    a closed surface that an author's law moves.

    Of a flex that a lattice of bodies carries, a vertex lies where its cell's eight corners put it (trilinear).

    Raises:
        NotFoundError: there is no flex of this name; the message lists those there are.
        UnknowableError: the recording does not hold its surface: it is a cloth or a rod, or was recorded without.
    """
    flexes: list[dict[str, Any]] = [row for row in trajectory.meta.get("flexes") or () if isinstance(row, dict)]
    flex = next((row for row in flexes if row.get("name") == name), None)
    if flex is None:
        known = ", ".join(str(row.get("name")) for row in flexes) or "(none)"
        raise NotFoundError(f"there is no soft body '{name}' in this recording", next_move=f"name one of: {known}")
    if "faces" in flex and name in trajectory.media.names:
        triangles, lay = np.array(flex["faces"], dtype=int).reshape(-1, 3), trajectory.media.of(name)
        if not _closed(triangles):
            raise UnknowableError(
                f"'{name}' is open: it has no inside", next_move="measure its size, or what it covers"
            )
        return np.stack([lay.at(float(time)) for time in trajectory.t[rows]]), triangles
    if "shell" not in flex:
        raise UnknowableError(
            f"'{name}' has no recorded surface around a volume: it is a cloth, a rod or quadratic",
            next_move="measure its size or its sag, or run the physics pass again if it is a solid",
        )
    triangles = np.array(flex["shell"], dtype=int).reshape(-1, 3)
    pos = trajectory.pos[rows]
    if "owners" in flex:
        return pos[:, [trajectory.names.index(body) for body in flex["owners"]]], triangles
    lattice = flex["lattice"]
    nodes = pos[:, [trajectory.names.index(body) for body in lattice["nodes"]]]
    cells, at = np.array(lattice["cells"], dtype=int), np.array(lattice["at"], dtype=float)
    cell = np.clip(np.floor(at * cells).astype(int), 0, cells - 1)
    inner = at * cells - cell
    found = np.zeros((len(rows), len(at), 3))
    for corner in np.ndindex(2, 2, 2):
        weight = np.where(corner, inner, 1 - inner).prod(axis=1)
        x, y, z = (cell + corner).T
        found += weight[:, None] * nodes[:, (x * (cells[1] + 1) + y) * (cells[2] + 1) + z]
    return found, triangles


def _closed(triangles: Array) -> bool:
    """Whether each edge has a triangle on either side, with one winding."""
    edges = {(int(a), int(b)) for a, b, c in triangles for a, b in ((a, b), (b, c), (c, a))}
    return len(edges) == 3 * len(triangles) and all((b, a) in edges for a, b in edges)


def volume(vertices: Array, triangles: Array) -> Array:
    """(R,) m^3 inside a closed surface: the sum of the tetrahedra from one point to its triangles (divergence theorem)."""
    apart = vertices - vertices.mean(axis=1, keepdims=True)
    a, b, c = (apart[:, triangles[:, k]] for k in range(3))
    return np.einsum("rfi,rfi->r", a, np.cross(b, c)) / 6
