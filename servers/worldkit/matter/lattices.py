"""A lattice of hexahedra in a sculpted shape: its outer nodes lie on the shape's surface, and a finer skin rides on it.

Eight points in each cell carry strain (full integration of trilinear hexahedra). Source: Hughes, The Finite Element Method, section 3.3.
"""

from dataclasses import dataclass

import numpy as np

from ..errors import ProgramError
from ..sculpt.marching import evaluated, gradients
from ..sculpt.signed import Shape

Array = np.ndarray
CORNERS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
GAUSS = 0.5 + (2 * CORNERS - 1) / (2 * np.sqrt(3))
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Corners of a cell's six sides, anticlockwise from outside."""
FARTHEST = 0.6
"""Sides of a cell by which a node is brought to the surface; what is farther away stays."""
NEAR = 4
"""Cells that are tried for a corner of the skin."""
HALVED = 8
"""How often they go back by a half, before they stay on their cubes."""
MOST_IN_BOX = 2e5
"""Cells of the box around a shape, of which a lattice keeps those that lie in it."""
LEAST = 0.1
"""No point of a cell keeps less than this share of a cube's room: its corners go back until it does."""


@dataclass(frozen=True)
class Lattice:
    """Nodes (n, 3) m, cells (c, 8) of them; per point of strain slopes (c, 8, 8, 3) 1/m and room (c, 8) m^3."""

    nodes: Array
    cells: Array
    slopes: Array
    room: Array
    outer: Array
    """(m,) nodes of the surface."""
    area: Array
    """(m,) m^2 that each of them stands for."""
    cell: float


def weights(at: Array) -> Array:
    """(n, 8) shares of a cell's corners at (n, 3) places of 0 to 1 in it."""
    at = at[:, None]
    return np.asarray(np.prod(np.where(CORNERS[None] > 0, at, 1 - at), axis=2))


def _turned(at: Array) -> Array:
    """(n, 8, 3) how the shares change with the places (n, 3) in the cell."""
    one, sign = np.where(CORNERS > 0, at[:, None], 1 - at[:, None]), 2 * CORNERS - 1
    return np.stack([sign[:, a] * one[..., (a + 1) % 3] * one[..., (a + 2) % 3] for a in range(3)], axis=-1)


def filled(shape: Shape, cell: float, name: str) -> Lattice:
    """Fill a shape with cells of about this side, m.

    Raises:
        ProgramError: no cell fits, or too many do.
    """
    if (inside_box := float(np.prod(shape.size / cell))) > MOST_IN_BOX:
        enough = cell * (inside_box / MOST_IN_BOX) ** (1 / 3)
        cause = f"cells of {cell:g} m would be {inside_box:.3g} in the box of {name}, more than {MOST_IN_BOX:g}"
        raise ProgramError(cause, name, f"make them {enough * 1.02:.2g} m")
    counts = np.maximum(np.round(shape.size / cell), 1).astype(int)
    sides = shape.size / counts
    grid = np.stack(np.meshgrid(*(np.arange(n) for n in counts), indexing="ij"), -1).reshape(-1, 3)
    inside = evaluated(shape, shape.low + (grid + 0.5) * sides) < 0.0
    if not inside.any():
        cause = f"no cell of {cell:g} m lies in the shape of {name}"
        raise ProgramError(cause, name, "give it finer cells")
    first = grid[inside]
    corner = (first[:, None] + CORNERS[None].astype(int)).reshape(-1, 3)
    number = np.ravel_multi_index(tuple(corner.T), tuple(counts + 1))
    used, cells = np.unique(number, return_inverse=True)
    cells = cells.reshape(-1, 8)
    nodes = shape.low + np.stack(np.unravel_index(used, tuple(counts + 1)), -1) * sides
    quads = cells[:, np.array(FACES)].reshape(-1, 4)
    _, at, many = np.unique(np.sort(quads, axis=1), axis=0, return_index=True, return_counts=True)
    quads = quads[at[many == 1]]
    outer = np.unique(quads)
    nodes = _snapped(shape, nodes, cells, outer, float(sides.min()))
    slopes, room = _measured(nodes, cells)
    a, b, c, d = (nodes[quads[:, k]] for k in range(4))
    each = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1)
    area = np.bincount(quads.ravel(), np.repeat(each / 4, 4), len(nodes))[outer]
    return Lattice(nodes, cells, slopes, room, outer, area, float(sides.min()))


def _snapped(shape: Shape, nodes: Array, cells: Array, outer: Array, side: float) -> Array:
    """Bring outer nodes to the surface, as far as no cell is crushed by it."""
    away = evaluated(shape, nodes[outer])
    down = gradients(shape, nodes[outer], 0.05 * side)
    down /= np.maximum(np.linalg.norm(down, axis=1, keepdims=True), 1e-12)
    move = np.zeros_like(nodes)
    move[outer] = np.where(np.abs(away) < FARTHEST * side, -away, 0.0)[:, None] * down
    least = LEAST * side**3 / 8
    halved = 0
    while len(crushed := cells[(_measured(nodes + move, cells)[1] < least).any(axis=1)]):
        move[np.unique(crushed)] *= 0.5 if halved < HALVED else 0.0  # cubes are never crushed
        halved += 1
    return nodes + move


def _measured(nodes: Array, cells: Array) -> tuple[Array, Array]:
    """Slopes (c, 8, 8, 3), 1/m, of the corners' shares at each point of strain, and its room (c, 8), m^3."""
    here = _turned(GAUSS)
    jacobian = np.einsum("cka,qkb->cqab", nodes[cells], here)
    room = np.linalg.det(jacobian) / 8
    safe = np.where(np.abs(room)[..., None, None] > 1e-30, jacobian, np.eye(3))
    return np.einsum("qkb,cqba->cqka", here, np.linalg.inv(safe)), room


def ridden(lattice: Lattice, corners: Array) -> tuple[Array, Array]:
    """Nodes (n, 8) and shares (n, 8) by which corners (n, 3) m of a skin ride on the cell that holds them, or nearly does.

    Each is put where the cell has it at rest, by Newton's method; the least change of the shares mends what is left of that.
    """
    from scipy.spatial import cKDTree

    middles = lattice.nodes[lattice.cells].mean(axis=1)
    _, near = cKDTree(middles).query(corners, k=min(NEAR, len(middles)))
    best, mine, share = np.full(len(corners), np.inf), np.zeros((len(corners), 8), int), np.zeros((len(corners), 8))
    for one in np.asarray(near).reshape(len(corners), -1).T:
        nodes = lattice.cells[one]
        at = np.full((len(corners), 3), 0.5)
        for _ in range(6):
            off = np.einsum("nk,nka->na", weights(at), lattice.nodes[nodes]) - corners
            turn = np.einsum("nka,nkb->nab", lattice.nodes[nodes], _turned(at))
            at = np.clip(at - np.linalg.solve(turn, off[..., None])[..., 0], -0.7, 1.7)
        outside = np.abs(at - 0.5).max(axis=1)
        better = outside < best - 1e-9
        best[better], mine[better], share[better] = outside[better], nodes[better], weights(at)[better]
    rows = np.concatenate([np.ones((len(corners), 1, 8)), np.swapaxes(lattice.nodes[mine], 1, 2)], axis=1)
    left = np.concatenate([np.ones((len(corners), 1)), corners], axis=1) - np.einsum("nak,nk->na", rows, share)
    return mine, share + np.einsum("nka,na->nk", np.linalg.pinv(rows), left)
