"""Forms with flat sides: wedge, hill from a profile, and rounded box."""

from collections.abc import Sequence

import numpy as np

from .bulk import Form, Piece, positive
from .outlines import area, line, smoothed, triangles

Array = np.ndarray
Vec3 = tuple[float, float, float]
Point = tuple[float, float]
QUARTER = 6
"""Steps of a rounded box's quarter circles."""


def wedge(*, size: Vec3) -> Form:
    """A ramp of full extents `size`, m: from an edge on the ground at its back (-x) up to its full height at its front (+x)."""
    positive("wedge", x=size[0], y=size[1], z=size[2])
    x, y, z = size
    return _extruded(np.array([(0.0, 0.0), (x, 0.0), (x, z)]), y, [np.arange(3)])


def hill(*, profile: Sequence[Point], width: float, smooth: int = 0) -> Form:
    """Ground with a profile: (x, height) points, m, from back to front, the same across its `width` (y), solid below.

    Its base lies at height zero, so that no point may be below it; neighbours in a convex stretch collide as one piece.

    Raises:
        ValueError: x does not grow from point to point, or a height is below zero.
    """
    positive("hill", width=width)
    top = smoothed(line("hill", profile, 2), smooth)
    if (np.diff(top[:, 0]) <= 0).any():
        raise ValueError("hill: x must grow from each point of the profile to the next")
    top[:, 1] = np.where(np.abs(top[:, 1]) < 1e-9, 0.0, top[:, 1])
    if (top[:, 1] < 0).any():
        raise ValueError("hill: a height is below zero: heights are measured from its base")
    ends = [(top[-1, 0], 0.0)] if top[-1, 1] else []
    ends += [(top[0, 0], 0.0)] if top[0, 1] else []
    outline = np.concatenate([top, np.array(ends).reshape(-1, 2)])[::-1]
    pieces, start = [], 0
    while start < len(top) - 1:
        stop = start + 1
        while stop < len(top) - 1 and _bends_down(top[start : stop + 2]):
            stop += 1
        pieces.append(top[start : stop + 1])
        start = stop
    clouds = [np.concatenate([p, p * (1, 0)]) for p in pieces if p[:, 1].any()]
    form = _extruded(outline, width, [])
    away = form.shift
    made: list[Piece] = []
    for cloud in clouds:
        sides = [np.insert(cloud, 1, y, axis=1) for y in (-width / 2, width / 2)]
        made.append(np.unique(np.round(np.concatenate(sides) + away, 12), axis=0))
    return Form(form.vertices, form.faces, tuple(made), form.shift)


def _bends_down(points: Array) -> bool:
    """Whether a line bends to the right at every point: solid ground under it is convex."""
    way = np.diff(points, axis=0)
    return bool((way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0] <= 1e-12).all())


def rounded_box(*, size: Vec3, radius: float) -> Form:
    """A box of full extents `size` whose edges and corners are rounded to `radius`, m."""
    positive("rounded box", x=size[0], y=size[1], z=size[2], radius=radius)
    if 2 * radius > min(size) * (1 + 1e-9):
        raise ValueError(f"rounded box: a radius of {radius} m does not fit into {size} m")
    inner = np.maximum(np.array(size) / 2 - radius, 0.0)
    quarter = np.arange(QUARTER + 1) * np.pi / 2 / QUARTER
    around = np.concatenate([quarter + k * np.pi / 2 for k in range(4)])
    heights = np.concatenate([quarter - np.pi / 2, quarter])
    corner = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])[np.repeat(np.arange(4), QUARTER + 1)]
    rings = []
    for k, up in enumerate(heights):
        flat = radius * np.cos(up) * np.stack([np.cos(around), np.sin(around)], axis=1) + corner * inner[:2]
        height = radius * np.sin(up) + (inner[2] if k > QUARTER else -inner[2])
        rings.append(np.column_stack([flat, np.full(len(around), height)]))
    count = len(around)
    vertices = np.round(np.concatenate(rings), 12)
    found = []
    for k in range(len(rings) - 1):
        one, other = np.arange(count) + k * count, np.arange(count) + (k + 1) * count
        nxt, beyond = np.roll(one, -1), np.roll(other, -1)
        found += [np.stack([one, nxt, other], axis=1), np.stack([nxt, beyond, other], axis=1)]
    top = (len(rings) - 1) * count
    for k in range(1, count - 1):
        found.append(np.array([[0, k + 1, k], [top, top + k, top + k + 1]]))
    vertices, faces = _welded(vertices, np.concatenate(found))
    return Form.centred(vertices, faces, [vertices])


def _welded(vertices: Array, faces: Array) -> tuple[Array, Array]:
    """Without doubled vertices, and without the faces that have no area then."""
    kept, same = np.unique(vertices, axis=0, return_inverse=True)
    faces = same.ravel()[faces]
    a, b, c = (kept[faces[:, k]] for k in range(3))
    size = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return kept, faces[size > 1e-15]


def _extruded(outline: Array, width: float, pieces: list[Array]) -> Form:
    """A counter-clockwise outline of (x, z) points, drawn out along y."""
    if area(outline) <= 1e-12:
        raise ValueError("the profile has no area")
    count = len(outline)
    vertices = np.concatenate([np.insert(outline, 1, y, axis=1) for y in (-width / 2, width / 2)])
    near = np.array(triangles(outline))
    k = np.arange(count)
    nxt = np.roll(k, -1)
    sides = [np.stack([k, k + count, nxt], axis=1), np.stack([nxt, k + count, nxt + count], axis=1)]
    faces = np.concatenate([near, near[:, ::-1] + count, *sides])
    # Seen from -y a counter-clockwise (x, z) outline faces the eye.
    if np.einsum("fi,fi->f", vertices[faces[:, 0]], np.cross(vertices[faces[:, 1]], vertices[faces[:, 2]])).sum() < 0:
        faces = faces[:, ::-1]
    clouds = [np.concatenate([vertices[p], vertices[p + count]]) for p in pieces]
    return Form.centred(vertices, faces, clouds)
