"""What collides: one convex hull where a shape is nearly convex, else several that leave its cavities open.

The solid is cut by planes, again and again where its hull is emptiest, and each piece collides as its own hull.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .marching import Skin, decimated, surface
from .signed import Array, Shape

if TYPE_CHECKING:
    import manifold3d

CONVEX = 0.93
"""A shape that fills this share of its hull collides as that hull."""
MOST, CORNERS = 16, 40
TRIANGLES = 1_500
SHARES = (0.3, 0.5, 0.7)
"""Where a piece may be cut, as shares of its extent."""
THIN = 0.04
"""No slice is thinner than this share of the whole: a thin ring would be cut across before it opens."""
FULL = 0.97
"""Nothing is cut further when all pieces together fill this share of their hulls."""


def hulls(
    shape: "Shape | None", skin: Skin, volume: float, wanted: str | int | Sequence[Shape] = "auto"
) -> tuple[Array, ...]:
    """Corners (N, 3), m, of the convex pieces that a solid collides as.

    Args:
        shape: whose skin it is; None for an exact solid.
        skin: its watertight surface.
        volume: that it encloses, m^3.
        wanted: "auto": 1 to 16; "convex": one hull; a number: at most so many; or shapes, each of which collides as its hull.

    Raises:
        ValueError: anything else is wanted.
    """
    if not isinstance(wanted, str | int):
        return tuple(corners_of(surface(part, 24).vertices) for part in wanted)
    if wanted not in ("auto", "convex") and not (isinstance(wanted, int) and 1 <= wanted <= 200):
        raise ValueError(f"hulls: 'auto', 'convex', a number from 1 to 200, or shapes; not {wanted!r}")
    whole = corners_of(skin.vertices)
    if wanted in ("convex", 1) or (wanted == "auto" and volume > CONVEX * _hull(whole).volume()):
        return (whole,)
    thin = skin
    if shape is not None:
        thin = decimated(shape, skin, TRIANGLES, float(np.ptp(skin.vertices, axis=0).max()) / 48)
    solid = _solid(thin) or _solid(skin)
    if solid is None:
        return (whole,)
    pieces = cut(solid, MOST if isinstance(wanted, str) else wanted)
    return tuple(corners_of(np.asarray(piece.to_mesh64().vert_properties)[:, :3]) for piece in pieces)


def cut(solid: "manifold3d.Manifold", most: int) -> "list[manifold3d.Manifold]":
    """At most so many pieces of a solid, each as full of it as its hull allows."""
    pieces = [(piece, _empty(piece)) for piece in _bits(solid)]
    total = sum(piece.volume() for piece, _ in pieces)
    least = THIN * float(np.ptp(np.array(solid.bounding_box()).reshape(2, 3), axis=0).max())
    whole: list[tuple[manifold3d.Manifold, float]] = []  # pieces that no cut makes better
    while pieces and len(pieces) + len(whole) < most:
        number = max(range(len(pieces)), key=lambda n: pieces[n][1])
        if sum(empty for _, empty in (*pieces, *whole)) < (1 / FULL - 1) * total:
            break
        best: list[tuple[manifold3d.Manifold, float]] | None = None
        worst = pieces.pop(number)
        low, high = np.array(worst[0].bounding_box()).reshape(2, 3)
        for axis in range(3):
            for share in SHARES:
                if min(share, 1 - share) * (high - low)[axis] < least:
                    continue
                halves = worst[0].split_by_plane(tuple(np.eye(3)[axis]), float(low[axis] + share * (high - low)[axis]))
                both = [(bit, _empty(bit)) for half in halves for bit in _bits(half)]
                if len(both) > 1 and (best is None or _cost(both, total) < _cost(best, total)):
                    best = both
        if best is None or len(pieces) + len(whole) + len(best) > most:
            whole.append(worst)
        else:
            pieces += best
    return [piece for piece, _ in (*pieces, *whole)]


def corners_of(points: Array) -> Array:
    """The corners (N, 3) of the hull of points, at most 80: those that reach farthest in even directions."""
    hull = np.asarray(_hull(points).to_mesh64().vert_properties)[:, :3]
    if len(hull) <= CORNERS:
        return hull
    k = np.arange(4 * CORNERS) + 0.5
    polar, turn = np.arccos(1 - k / (2 * CORNERS)), np.pi * (1 + 5**0.5) * k
    ways = np.column_stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)])
    chosen = np.array(list(dict.fromkeys((hull @ np.concatenate([np.eye(3), -np.eye(3), ways]).T).argmax(axis=0))))
    if len(chosen) > 2 * CORNERS:  # the ways run from top to bottom: the first alone would leave nothing to stand on
        rest = np.linspace(6, len(chosen) - 1, 2 * CORNERS - 6).round().astype(int)
        chosen = np.concatenate([chosen[:6], chosen[rest]])
    return hull[chosen]


def _cost(pieces: "list[tuple[manifold3d.Manifold, float]]", total: float) -> float:
    """What is empty in the hulls, m^3, and a little for each piece."""
    return sum(empty for _, empty in pieces) + 0.002 * total * len(pieces)


def _bits(solid: "manifold3d.Manifold") -> "list[manifold3d.Manifold]":
    """The parts of a solid that do not hang together, without crumbs."""
    found = [bit for bit in solid.decompose() if bit.volume() > 0]
    largest = max((bit.volume() for bit in found), default=0.0)
    return [bit for bit in found if bit.volume() > 1e-4 * largest]


def _empty(solid: "manifold3d.Manifold") -> float:
    """How much of its hull a solid does not fill, m^3, times that share of what it fills: a thin ring's hull closes an opening."""
    full = float(solid.volume())
    return max(float(solid.hull().volume()) - full, 0.0) ** 2 / max(full, 1e-300)


def _solid(skin: Skin) -> "manifold3d.Manifold | None":
    import manifold3d

    corners, faces = np.array(skin.vertices, float), np.array(skin.faces, np.uint64)  # it refuses read-only ones
    mesh = manifold3d.Mesh64(vert_properties=corners, tri_verts=faces)
    solid = manifold3d.Manifold(mesh)
    return None if solid.is_empty() or not solid.volume() > 0 else solid


def _hull(points: Array) -> "manifold3d.Manifold":
    import manifold3d

    return manifold3d.Manifold.hull_points(np.ascontiguousarray(points, dtype=float))
