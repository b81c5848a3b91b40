"""Closed surfaces of near-equilateral triangles, anticlockwise from outside: what a skin is made of."""

import numpy as np

from ..errors import ProgramError

Shape = tuple[np.ndarray, np.ndarray]


def revolved(
    profile: "np.ndarray | list[tuple[float, float]]", around: int, middle: "tuple[float, ...]" = (0, 0, 0)
) -> Shape:
    """What a profile sweeps about the vertical: a bottle, a can.

    Args:
        profile: (m, 2) m: radius and height from the lowest point of the axis to the highest; both ends have the radius 0. A
            ring of points stands at each row between; where its rows are as far apart as its points, the triangles are about alike.
        around: points of a ring.
        middle: (3,) m, where the profile's origin lies in the world.

    Returns:
        Points (n, 3), m, world frame, and triangles (f, 3), whole numbers. The last point is the top, the first the bottom.

    Raises:
        ProgramError: the profile is not closed, or has too few rows.
    """
    rows = np.asarray(profile, float)
    if rows.ndim != 2 or len(rows) < 4 or rows[0, 0] or rows[-1, 0] or (rows[1:-1, 0] <= 0).any() or around < 3:
        cause = f"a profile of the shape {rows.shape} sweeps no closed surface with {around} points around"
        move = "give rows (radius, height) from the bottom up, the first and the last of radius 0, others above 0"
        raise ProgramError(cause, "revolved", move)
    inner = rows[1:-1]
    one = np.arange(around)
    turn = np.broadcast_to(2 * np.pi * one / around, (len(inner), around))
    high = np.broadcast_to(inner[:, 1:], turn.shape)
    rings = np.stack([inner[:, :1] * np.cos(turn), inner[:, :1] * np.sin(turn), high], axis=-1).reshape(-1, 3)
    points = np.concatenate([[(0, 0, rows[0, 1])], rings, [(0, 0, rows[-1, 1])]]) + np.asarray(middle, float)
    after, top = (one + 1) % around, len(points) - 1
    faces = [np.stack([0 * one, 1 + after, 1 + one], axis=1)]
    for ring in range(len(inner) - 1):
        a, b = 1 + ring * around, 1 + (ring + 1) * around
        lower, upper = (a + one, a + after), (b + one, b + after)
        odd = ((one + ring) % 2 == 1)[:, None]  # diagonals lean to and fro, so that none prefers to twist
        faces.append(np.where(odd, np.stack([*lower, upper[0]], axis=1), np.stack([*lower, upper[1]], axis=1)))
        faces.append(
            np.where(
                odd, np.stack([lower[1], upper[1], upper[0]], axis=1), np.stack([lower[0], upper[1], upper[0]], axis=1)
            )
        )
    last = 1 + (len(inner) - 1) * around
    faces.append(np.stack([last + one, last + after, top + 0 * one], axis=1))
    return points, np.concatenate(faces)


def ball(radius: float, middle: "tuple[float, ...]" = (0, 0, 0), finer: int = 3) -> Shape:
    """A sphere whose triangles are nearly alike: an icosahedron, each triangle cut in four `finer` times (642 points at 3).

    Returns:
        Points (n, 3), m, world frame, and triangles (f, 3), whole numbers.
    """
    golden = (1 + 5**0.5) / 2
    ring = [(-1, golden), (1, golden), (-1, -golden), (1, -golden)]
    points = [*((a, b, 0.0) for a, b in ring), *((0.0, a, b) for a, b in ring), *((b, 0.0, a) for a, b in ring)]
    found = np.array(points) / np.hypot(1, golden)
    around = np.linalg.norm(found[:, None] - found[None], axis=-1) < 1.2  # the edge of such an icosahedron is 1.05
    faces = np.array([
        (i, j, k) if np.linalg.det(found[[i, j, k]]) > 0 else (i, k, j)
        for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12) if around[i, j] and around[j, k] and around[i, k]
    ])  # fmt: skip
    for _ in range(finer):
        sides = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=-1).reshape(-1, 2)
        edges, which = np.unique(sides, axis=0, return_inverse=True)
        half = found[edges].sum(axis=1)
        ab, bc, ca = (len(found) + which.reshape(-1, 3)).T
        found = np.concatenate([found, half / np.linalg.norm(half, axis=1, keepdims=True)])
        a, b, c = faces.T
        faces = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return radius * found + np.asarray(middle, float), faces
