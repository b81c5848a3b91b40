"""A tube along a path: a bent rod, or with a wall a pipe that things can go through."""

import itertools
from collections.abc import Sequence

import numpy as np

from .bulk import Form, Piece, Rod, positive
from .outlines import line, smoothed

Array = np.ndarray
AROUND = 36
SLABS = 12
"""Pieces that go round a pipe's wall."""
MOST_SEGMENTS = 120
SHARPEST_DEG = 100.0
Vec3 = tuple[float, float, float]


def tube(*, path: Sequence[Vec3], diameter: float, wall: float | None = None, smooth: int = 0) -> Form:
    """A round tube along a line of points, m; `diameter` outside. With `wall` it is hollow and open at both ends.

    Args:
        path: at least two points of its middle line; where it should bend gently, many, or `smooth`.
        diameter: m.
        wall: m; a pipe's bore is `diameter - 2 wall`.
        smooth: points put between each two, on a smooth curve through all of them.

    Raises:
        ValueError: too few points, a bend of more than 100 degrees at one point, a wall that leaves no bore.
    """
    positive("tube", diameter=diameter)
    middle = smoothed(line("tube", path, 3), smooth)
    if len(middle) > MOST_SEGMENTS + 1:
        raise ValueError(f"tube: {len(middle) - 1} segments, {MOST_SEGMENTS} are the most: smooth it less")
    if wall is not None and not 0 < wall < diameter / 2:
        raise ValueError(f"tube: a wall of {wall} m leaves no bore in a tube of {diameter} m")
    outer = _rings(middle, diameter / 2, AROUND)
    if wall is None:
        return Form.centred(*_skin(outer, None), _rods(middle, diameter / 2))
    inner = _rings(middle, diameter / 2 - wall, AROUND)
    step = AROUND // SLABS
    pieces: list[Piece] = []
    for k in range(len(middle) - 1):
        for s in range(SLABS):
            columns = [(s * step + d) % AROUND for d in range(step + 1)]
            # The inner face is a chord of the slab's ends: between them the wall may only be thinner, never the bore wider.
            ends = [columns[0], columns[-1]]
            pieces.append(np.concatenate([outer[k : k + 2, columns], inner[k : k + 2, ends]], axis=1).reshape(-1, 3))
    return Form.centred(*_skin(outer, inner), pieces)


def _rings(middle: Array, radius: float, around: int) -> Array:
    """(N, around, 3) the rings of a tube, mitred in the plane that halves each bend; their frame is carried without twist.

    Source: W. Wang et al., "Computation of rotation minimizing frames", ACM Transactions on Graphics 27, 2008.
    """
    way = np.diff(middle, axis=0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    least = float((way[:-1] * way[1:]).sum(axis=1).min(initial=1.0))
    if least < np.cos(np.radians(SHARPEST_DEG)):
        raise ValueError(
            f"tube: it bends by {np.degrees(np.arccos(least)):.0f} degrees at one point: add points, or smooth"
        )
    side = np.cross(way[0], np.eye(3)[np.abs(way[0]).argmin()])
    side /= np.linalg.norm(side)
    angles = np.arange(around) * 2 * np.pi / around
    found = []
    for k, point in enumerate(middle):
        along = way[max(k - 1, 0)]
        out = way[min(k, len(way) - 1)]
        around_it = radius * (np.outer(np.cos(angles), side) + np.outer(np.sin(angles), np.cross(along, side)))
        plane = along + out
        found.append(point + around_it - np.outer(around_it @ plane / (along @ plane), along))
        turn = out - along
        if turn @ turn > 1e-24:  # mirrored in the mitre: the lines of the tube meet there
            side = side - 2 * (side @ plane) / (plane @ plane) * plane
            side = side - (side @ out) * out
            side /= np.linalg.norm(side)
    return np.array(found)


def _skin(outer: Array, inner: Array | None) -> tuple[Array, Array]:
    """The closed surface of a rod, or of a pipe."""
    rings, around = outer.shape[:2]
    vertices = [outer.reshape(-1, 3)]
    faces = [_strip(np.arange(k * around, (k + 1) * around), around) for k in range(rings - 1)]
    first, last = np.arange(around), np.arange(around) + (rings - 1) * around
    if inner is None:
        centres = np.stack([outer[0].mean(axis=0), outer[-1].mean(axis=0)])
        a, b = rings * around, rings * around + 1
        vertices.append(centres)
        faces.append(np.stack([np.roll(first, -1), first, np.full(around, a)], axis=1))
        faces.append(np.stack([last, np.roll(last, -1), np.full(around, b)], axis=1))
        return np.concatenate(vertices), np.concatenate(faces)
    base = rings * around
    vertices.append(inner.reshape(-1, 3))
    faces += [_strip(base + np.arange(k * around, (k + 1) * around), around)[:, ::-1] for k in range(rings - 1)]
    faces += [_between(first + base, first), _between(last, last + base)]
    return np.concatenate(vertices), np.concatenate(faces)


def _strip(ring: Array, around: int) -> Array:
    return _between(ring, ring + around)


def _between(one: Array, other: Array) -> Array:
    """The quads between two rings as triangles."""
    nxt, beyond = np.roll(one, -1), np.roll(other, -1)
    return np.concatenate([np.stack([one, nxt, other], axis=1), np.stack([nxt, beyond, other], axis=1)])


def _rods(middle: Array, radius: float) -> list[Piece]:
    """Rods along the path: flat at its two ends, round at the bends between."""
    last = len(middle) - 2
    found: list[Piece] = []
    for k, (a, b) in enumerate(itertools.pairwise(middle)):
        found.append(Rod(a, b, radius, 0 < k < last))
        if k > 0 and (k == 1 or k == last):  # the ball that fills the bend beside a flat-ended rod
            found.append(Rod(a, a, radius, True))
    return found
