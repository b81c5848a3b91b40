"""Forms of revolution about z: cone, torus and lathe."""

import itertools
from collections.abc import Sequence

import numpy as np

from .bulk import Form, Piece, Rod, positive
from .outlines import area, cells, crosses_itself, line, smoothed, thickened

Array = np.ndarray
AROUND = 48
"""Corners of a drawn circle."""
RODS = 48
"""Capsules of a torus: a ring of radius R deviates from round by 0.2 % of R."""
SECTORS = ((8, 24), (16, 16), (1000, 12))
"""How many pieces go round for up to so many cells of the outline."""
MOST_POINTS = 200
Point = tuple[float, float]


def cone(*, diameter: float, height: float, top_diameter: float = 0.0) -> Form:
    """An upright cone, or with `top_diameter` a frustum; `diameter` is its base, m."""
    positive("cone", diameter=diameter, height=height)
    if not 0 <= top_diameter < np.inf:
        raise ValueError(f"cone: top_diameter must be zero or positive, got {top_diameter}")
    bottom, top = diameter / 2, top_diameter / 2
    outline = [(0.0, 0.0), (bottom, 0.0), (top, height), (0.0, height)] if top else [(0, 0), (bottom, 0), (0, height)]
    return _revolved("cone", np.array(outline, dtype=float))


def torus(*, diameter: float, thickness: float) -> Form:
    """A ring that lies flat: `diameter` outside, `thickness` of the ring itself, m. Its hole is open."""
    positive("torus", diameter=diameter, thickness=thickness)
    if diameter <= 2 * thickness:
        raise ValueError(f"torus: {diameter} m across with a ring of {thickness} m leaves no hole")
    radius, ring = thickness / 2, (diameter - thickness) / 2
    turn = np.arange(24) * 2 * np.pi / 24
    outline = np.stack([ring + radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    vertices, faces = _mesh(outline)
    angles = np.arange(RODS + 1) * 2 * np.pi / RODS
    middle = ring * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    rods = [Rod(a, b, radius, True) for a, b in itertools.pairwise(middle)]
    return Form.centred(vertices, faces, rods)


def lathe(*, profile: Sequence[Point], wall: float | None = None, smooth: int = 0) -> Form:
    """What a lathe turns: an outline of (radius, height) points, m, taken round z.

    Without `wall` the points are the outline of the section, from the bottom outwards and up: a solid one begins and ends on
    the axis (radius 0) or is closed along it; an outline that keeps off the axis is a ring. With `wall` they are the outer
    line of a vessel, from the middle of its bottom to its rim: it is open at the top, and its wall is so thick.

    Args:
        profile: at least three points, two with `wall`; radii not negative.
        wall: m.
        smooth: points put between each two, on a smooth curve.

    Raises:
        ValueError: a radius below zero, an outline that crosses itself, or a wall that does not fit.
    """
    outline = smoothed(line("lathe", profile, 2, 2 if wall else 3), smooth)
    outline[:, 0] = np.where(np.abs(outline[:, 0]) < 1e-9, 0.0, outline[:, 0])
    if (outline[:, 0] < 0).any():
        raise ValueError("lathe: a radius is below zero; points are (radius, height)")
    if wall is not None:
        positive("lathe", wall=wall)
        outline = thickened(outline, wall)
        outline[:, 0] = np.maximum(outline[:, 0], 0.0)
        on_axis = outline[0, 0] == 0.0
        if on_axis:
            outline[-1, 0] = 0.0
    elif (outline[0, 0] == 0) != (outline[-1, 0] == 0) and outline[:, 0].min() == 0:
        # One end on the axis: the other is joined to the axis at its own height.
        end = 0 if outline[0, 0] else -1
        corner = np.array([[0.0, outline[end, 1]]])
        outline = np.concatenate([corner, outline] if end == 0 else [outline, corner])
    if len(outline) > MOST_POINTS:
        raise ValueError(f"lathe: its outline has {len(outline)} points, {MOST_POINTS} are the most: smooth it less")
    return _revolved("lathe", outline)


def _revolved(what: str, outline: Array) -> Form:
    outline = outline[np.linalg.norm(outline - np.roll(outline, 1, axis=0), axis=1) > 1e-9]
    if crosses_itself(outline):
        raise ValueError(f"{what}: its outline crosses itself: list the points in their order along it")
    if area(outline) < 0:
        outline = outline[::-1]
    if area(outline) < 1e-12:
        raise ValueError(f"{what}: its outline has no area")
    slices = _stacked(outline)
    convex = slices or cells(outline)
    around = next(count for most, count in SECTORS if len(convex) <= most)
    pieces: list[Piece] = []
    for cell in convex:
        pieces += _pieces(outline[cell], around, bool(slices))
    return Form.centred(*_mesh(outline), pieces)


def _stacked(outline: Array) -> list[list[int]]:
    """A solid whose radius is a function of its height, as few slices that are convex all round; none of another one."""
    on_axis = np.flatnonzero(outline[:, 0] == 0)
    if len(on_axis) != 2 or (on_axis[1] - on_axis[0]) % len(outline) not in (1, len(outline) - 1):
        return []
    low, high = sorted(map(int, on_axis), key=lambda k: float(outline[k, 1]))
    side = [(low + d) % len(outline) for d in range(len(outline))]
    if side[-1] != high or (np.diff(outline[side, 1]) < 0).any():
        return []
    found, start = [], 0
    while start < len(side) - 1:
        stop = start + 1
        while stop < len(side) - 1 and _bulges(outline[side[start : stop + 2]]):
            stop += 1
        if outline[side[stop], 1] > outline[side[start], 1]:
            found.append(side[start : stop + 1])
        start = stop
    return found


def _bulges(points: Array) -> bool:
    """Whether the outside of a slice bends to the left at every point: it is convex with its two level faces."""
    way = np.diff(points, axis=0)
    return bool((way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0] >= -1e-12).all())


def _mesh(outline: Array) -> tuple[Array, Array]:
    """The surface of a counter-clockwise outline taken round z; points on the axis are one vertex each."""
    turn = np.arange(AROUND) * 2 * np.pi / AROUND
    vertices: list[Array] = []
    index = np.zeros((len(outline), AROUND), dtype=int)
    for k, (radius, height) in enumerate(outline):
        start = len(vertices)
        if radius == 0:
            vertices.append(np.array([0.0, 0.0, height]))
            index[k] = start
            continue
        vertices += [
            np.array([radius * c, radius * s, height]) for c, s in zip(np.cos(turn), np.sin(turn), strict=True)
        ]
        index[k] = start + np.arange(AROUND)
    faces = []
    for k in range(len(outline)):
        a, b = index[k], index[(k + 1) % len(outline)]
        if outline[k, 0] == 0 and outline[(k + 1) % len(outline), 0] == 0:
            continue
        a2, b2 = np.roll(a, -1), np.roll(b, -1)
        if outline[k, 0]:
            faces.append(np.stack([a, a2, b], axis=1))
        if outline[(k + 1) % len(outline), 0]:
            faces.append(np.stack([a2, b2, b], axis=1))
    return np.array(vertices), np.concatenate(faces)


def _pieces(corners: Array, around: int, whole: bool) -> list[Array]:
    """The hulls of a convex cell (N, 2) taken round z: one when that is convex, else `around` of them."""
    if whole or _convex_around(corners):
        turn = np.arange(AROUND) * 2 * np.pi / AROUND
        return [_spun(corners, turn)]
    step = 2 * np.pi / around
    return [_spun(corners, step * (k + np.array([0.0, 0.5, 1.0]))) for k in range(around)]


def _convex_around(corners: Array) -> bool:
    """Whether a convex cell is convex together with its mirror image across the axis."""
    on_axis = corners[corners[:, 0] == 0]
    if len(on_axis) < 2:
        return False
    low, high = on_axis[:, 1].min(), on_axis[:, 1].max()
    return bool(corners[:, 1].min() >= low - 1e-12 and corners[:, 1].max() <= high + 1e-12)


def _spun(corners: Array, angles: Array) -> Array:
    radius, height = corners.T
    x, y = (np.outer(f(angles), radius).ravel() for f in (np.cos, np.sin))
    found = np.stack([x, y, np.tile(height, len(angles))], axis=1)
    return np.unique(np.round(found, 12), axis=0)


__all__ = ["cone", "lathe", "torus"]
