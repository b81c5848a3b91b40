"""Cells of a convex solid: each seed owns what lies nearer to it than to any other seed (Voronoi), clipped by the solid.

A cell is convex, a face between two cells is plane and lies in both, and the volumes add up to the solid's: what breaks along
these faces was whole before.

Source: Voronoi 1908; clipping of polygons by planes, Sutherland and Hodgman 1974.
"""

from typing import NamedTuple

import numpy as np

from ..turning import cross

Array = np.ndarray
OUTSIDE = -1
"""The neighbour of a face on the skin of the solid."""
NEAR = 1e-10
"""Points this close to a plane, as a share of the solid's extent, lie in it."""


class Face(NamedTuple):
    """One plane face of a cell."""

    corners: Array
    """(k, 3) m, counter-clockwise seen from outside the cell."""
    neighbour: int
    """The cell beyond it; `OUTSIDE` on the skin."""


class Cell(NamedTuple):
    """One convex piece."""

    faces: tuple[Face, ...]


def solid(corners: Array) -> Cell:
    """The hull of points (N, 3), m, as one cell, whose triangles of one plane are one face.

    Raises:
        ValueError: the points lie in a plane.
    """
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(corners)
    except (QhullError, ValueError) as error:
        raise ValueError("what breaks is a solid: its points lie in one plane, or are too few") from error
    _, plane = np.unique(np.round(hull.equations / (1, 1, 1, np.ptp(corners)), 7), axis=0, return_inverse=True)
    faces = []
    for one in range(plane.max() + 1):
        mine = np.flatnonzero(plane.ravel() == one)
        normal = hull.equations[mine[0], :3]
        faces.append(Face(_around(corners[np.unique(hull.simplices[mine])], normal), OUTSIDE))
    return Cell(tuple(faces))


def cells(whole: Cell, seeds: Array, gap: float = 0.0) -> list[Cell]:
    """The cell of each seed (n, 3), m, without faces where it owns nothing; each stands back by half a `gap`, m, from the next.

    Raises:
        ValueError: two seeds lie in one place.
    """
    corners = np.concatenate([face.corners for face in whole.faces])
    apart = np.linalg.norm(seeds[:, None] - seeds[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    if len(seeds) > 1 and apart.min() < 1e-9:
        one, other = np.unravel_index(int(apart.argmin()), apart.shape)
        raise ValueError(f"seeds {one} and {other} lie in one place: move one")
    squares = ((corners[:, None] - seeds[None]) ** 2).sum(axis=2)
    made = []
    for number, seed in enumerate(seeds):
        # (corners, seeds) m: how far beyond the plane to each other seed the solid reaches.
        beyond = (squares[:, [number]] - squares) / (2 * apart[number]) + gap / 2
        beyond[:, number] = -np.inf
        cell = Cell(()) if (beyond.min(axis=0) >= 0).any() else whole
        reach = np.inf
        for other in np.argsort(apart[number], kind="stable"):
            if not cell.faces or apart[number, other] > 2 * reach + gap:
                break
            if beyond[:, other].max() > 0:
                normal = (seeds[other] - seed) / apart[number, other]
                cell = clipped(cell, normal, float(normal @ (seeds[other] + seed)) / 2 - gap / 2, int(other))
                reach = (
                    max((float(((f.corners - seed) ** 2).sum(axis=1).max()) for f in cell.faces), default=0.0) ** 0.5
                )
        made.append(cell)
    return made


def clipped(cell: Cell, normal: Array, level: float, neighbour: int) -> Cell:
    """What is left of a cell where `normal` · x <= `level`; the cut is its face to `neighbour`."""
    counts = [len(face.corners) for face in cell.faces]
    corners = np.concatenate([face.corners for face in cell.faces])
    near = NEAR * float(np.ptp(corners, axis=0).max())
    whole = corners @ normal - level
    if whole.max() <= near:
        return cell
    if whole.min() >= -near:
        return Cell(())
    heights = np.split(whole, np.cumsum(counts)[:-1])
    kept, cut = [], []
    for face, height in zip(cell.faces, heights, strict=True):
        if height.max() < -near:
            kept.append(face)
            continue
        points = []
        for here in range(len(height)):
            there = (here + 1) % len(height)
            if height[here] <= near:
                points.append(face.corners[here])
                if height[here] >= -near:
                    cut.append(face.corners[here])
            if (height[here] > near and height[there] < -near) or (height[there] > near and height[here] < -near):
                share = height[here] / (height[here] - height[there])
                points.append(face.corners[here] + share * (face.corners[there] - face.corners[here]))
                cut.append(points[-1])
        if len(points) > 2 and height.min() < -near:
            kept.append(face._replace(corners=np.array(points)))
    if len(cut) > 2 and kept:
        ring = _around(np.array(cut), normal)
        if len(ring) > 2:
            kept.append(Face(ring, neighbour))
    return Cell(tuple(kept))


def _around(points: Array, normal: Array) -> Array:
    """The corners of a convex polygon in the order that is counter-clockwise seen from where `normal` points; each once."""
    side = cross(normal, np.eye(3)[np.abs(normal).argmin()])
    flat = (points - points.mean(axis=0)) @ np.stack([side, cross(normal, side)], axis=1)
    ordered = points[np.argsort(np.arctan2(flat[:, 1], flat[:, 0]), kind="stable")]
    way = ordered - ordered[np.arange(len(ordered)) - 1]
    return ordered[(way**2).sum(axis=1) > 1e-18]
