"""From a distance function to triangles: marching cubes where the surface is, normals from the gradient, a stated budget."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from .signed import Array, Shape

CELLS, TRIANGLES = 64, 12_000
"""Cells along the longest side, and triangles that are kept, where nothing else is asked for."""
MOST_CELLS = 400
BLOCK = 4
"""Cells along a side of the blocks that are looked at first."""
SAFE = 1.4
"""Blocks are looked into when their centre is nearer to the surface than this times half their diagonal."""
CHUNK = 32_768


@dataclass(frozen=True)
class Skin:
    """A closed surface of triangles: vertices (V, 3), m, unit normals (V, 3), faces (F, 3), counter-clockwise from outside."""

    vertices: Array
    normals: Array
    faces: Array


def surface(shape: Shape, cells: int = CELLS) -> Skin:
    """The surface of a shape at so many cells along its longest side, watertight.

    Source: W. Lorensen, H. Cline, "Marching cubes" (1987), in the variant of T. Lewiner, as scikit-image has it.

    Raises:
        ValueError: cells out of 8 to 400, or the shape has no surface in its box.
    """
    vertices, faces, step = bare(shape, cells)
    return Skin(vertices, gradients(shape, vertices, step), faces)


def bare(shape: Shape, cells: int) -> tuple[Array, Array, float]:
    """The vertices (V, 3), m, and faces (F, 3) of `surface`, and the side of a cell, m: without normals, which take half the time."""
    from skimage.measure import marching_cubes

    if not 8 <= cells <= MOST_CELLS:
        raise ValueError(f"cells: give 8 to {MOST_CELLS} along the longest side, not {cells}")
    step = float(shape.size.max()) / cells
    # Whole blocks, with two cells of air on each side.
    blocks = np.maximum(np.ceil((shape.size / step + 4) / BLOCK).astype(int), 1)
    origin = shape.centre - blocks * BLOCK * step / 2
    field, looked = _field(shape, origin, step, blocks)
    if not (field.min() < 0 < field.max()):
        raise ValueError(
            "the shape has no surface at this size: is everything carved away, or is it thinner than "
            f"{step * 1000:.3g} mm, a cell? Give more cells, or thicker walls"
        )
    points, faces, _, _ = marching_cubes(field, level=0.0, mask=looked, gradient_direction="descent")
    points, faces = _welded(points.astype(float), faces[:, ::-1])
    vertices = origin + points * step
    if _signed_volume(vertices, faces) < 0:
        faces = faces[:, ::-1]
    return vertices, np.ascontiguousarray(faces), step


def _field(shape: Shape, origin: Array, step: float, blocks: Array) -> tuple[Array, Array]:
    """Distances on the grid of corners, coarse where no surface is near, and the cells that were looked into."""
    side = BLOCK * step
    centres = origin + (np.stack(np.meshgrid(*map(np.arange, blocks), indexing="ij"), -1).reshape(-1, 3) + 0.5) * side
    coarse = evaluated(shape, centres).reshape(blocks)
    near = np.abs(coarse) < SAFE * side * np.sqrt(3) / 2
    for axis in range(3):  # whatever the estimate says, a change of sign is a surface
        a, b = (tuple(slice(*s) if k == axis else slice(None) for k in range(3)) for s in ((None, -1), (1, None)))
        change = (coarse[a] < 0) != (coarse[b] < 0)
        near[a] |= change
        near[b] |= change
    field = np.full(blocks * BLOCK + 1, np.inf)
    cells = coarse.repeat(BLOCK, 0).repeat(BLOCK, 1).repeat(BLOCK, 2)
    field[:-1, :-1, :-1] = cells
    for axis in range(3):
        last = tuple(-1 if k == axis else slice(None) for k in range(3))
        field[last] = np.take(field, -2, axis=axis)
    wanted = np.zeros(field.shape, dtype=bool)
    inside = near.repeat(BLOCK, 0).repeat(BLOCK, 1).repeat(BLOCK, 2)
    for k in range(8):
        shift = tuple(slice(1, None) if k >> axis & 1 else slice(None, -1) for axis in range(3))
        wanted[shift] |= inside
    at = np.argwhere(wanted)
    field[wanted] = evaluated(shape, origin + at * step)
    field[np.abs(field) < 1e-6 * step] = 1e-6 * step  # no vertex of the surface falls on a corner of the grid
    return field, wanted


def evaluated(shape: Shape, points: Array) -> Array:
    """Distances (N,) of points (N, 3), in pieces that fit the cache, on every core."""
    pieces = list(_chunks(points))
    workers = min(os.cpu_count() or 1, 4, len(pieces))
    if workers < 2:
        parts = [shape.measure(piece) for piece in pieces]
    else:
        with ThreadPoolExecutor(workers) as pool:
            parts = list(pool.map(shape.measure, pieces))
    found = np.concatenate(parts) if parts else np.zeros(0)
    if not np.isfinite(found).all():
        raise ValueError("the shape's distance function gives numbers that are not finite")
    return found


def _chunks(points: Array) -> Iterator[Array]:
    for start in range(0, len(points), CHUNK):
        yield points[start : start + CHUNK]


def gradients(shape: Shape, points: Array, step: float) -> Array:
    """Unit normals (N, 3) of the field at points, by differences over a quarter of a cell.

    Source: I. Quilez, "Normals for an SDF", four samples at the corners of a tetrahedron.
    """
    found = np.zeros(points.shape)
    for corner in ((1, -1, -1), (-1, -1, 1), (-1, 1, -1), (1, 1, 1)):
        way = np.array(corner, dtype=float)
        found += way * evaluated(shape, points + 0.25 * step * way)[:, None]
    length = np.linalg.norm(found, axis=1, keepdims=True)
    return np.where(length > 0, found / np.maximum(length, 1e-300), (0.0, 0.0, 1.0))


def _welded(points: Array, faces: Array) -> tuple[Array, Array]:
    """The mesh without faces of no area and without vertices that nothing uses."""
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    used, index = np.unique(faces, return_inverse=True)
    return points[used], index.reshape(-1, 3)


def _signed_volume(vertices: Array, faces: Array) -> float:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("fi,fi->", a, np.cross(b, c)) / 6)


def decimated(shape: Shape, skin: Skin, triangles: int, step: float) -> Skin:
    """A surface with at most about so many triangles, its vertices put back onto the shape.

    Source: M. Garland, P. Heckbert, "Surface simplification using quadric error metrics" (1997), by fast-simplification.
    """
    if len(skin.faces) <= triangles:
        return skin
    import fast_simplification

    vertices, faces = fast_simplification.simplify(
        skin.vertices.astype(np.float32), skin.faces.astype(np.int32), target_count=triangles
    )
    points, faces = _welded(vertices.astype(float), faces.astype(np.int64))
    normals = gradients(shape, points, step)
    off = np.clip(evaluated(shape, points), -step / 2, step / 2)
    return Skin(points - off[:, None] * normals, normals, faces)
