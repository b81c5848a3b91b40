"""What a thing collides as: a primitive where it is one, else one hull, else several that leave its cavities open, else its box."""

import importlib.util
from typing import Any

import numpy as np

from . import cutting
from .drawn_pieces import Array
from .mending import Solid

TOLERANCE = 0.05
"""A primitive stands for a solid when it is larger by no more than this share of its volume."""
FULL = 0.93
"""A solid that fills this share of its hull collides as that."""
TRIANGLES = 3_000
"""Of what is cut into hulls."""
WIDE = 1.8
"""Where CoACD's hulls are together so many times as large as the solid, it is cut by planes too, and the tighter ones count."""
LOOSE = 2.0
"""Hulls that are so many times as large as the solid have lost it."""


def pieces(solid: Solid) -> tuple[list[dict[str, Any]], list[Array], str]:
    """The collision of a solid in the frame of its vertices.

    Returns:
        Rows as `asset.yaml` has them (with `hull` as a number instead of a file), the corners (N, 3) of each hull, and
        how that was found.
    """
    from ..sculpt.hulls import corners_of

    whole = corners_of(solid.vertices)
    if solid.closed:
        if (row := primitive(solid)) is not None:
            return [row], [], f"a {row['type']}, within {TOLERANCE:.0%} of its volume"
        if solid.volume > FULL * volume_of(whole):
            return (
                [{"type": "hull", "hull": 0}],
                [whole],
                f"one hull, which it fills to {solid.volume / volume_of(whole):.0%}",
            )
    try:
        found, how = _cut(solid)
        if solid.closed and _together(found) > WIDE * solid.volume:  # thin things want straight cuts
            straight = _cut_by_planes(solid, *thinned(solid.vertices, solid.faces, TRIANGLES))
            if straight and _together(straight) < _together(found):
                found, how = straight, "cut by planes"
    except Exception as error:  # a decomposition of a stranger's mesh may raise anything, and then a box stands in
        said = str(error).strip().splitlines()
        return (
            [_box(solid)],
            [],
            f"its box, since it could not be cut into hulls: {said[0][:120] if said else type(error).__name__}",
        )
    together = _together(found)
    if not found or (solid.closed and together > LOOSE * solid.volume and together > 0.9 * volume_of(whole)):
        return [_box(solid)], [], "its box, since its hulls lost its shape"
    rows = [{"type": "hull", "hull": number} for number in range(len(found))]
    more = f", together {together / solid.volume:.2f} times its volume" if solid.closed else ""
    return rows, found, f"{len(found)} hulls {how}{more}"


def primitive(solid: Solid) -> dict[str, Any] | None:
    """The sphere, cylinder or box along the axes that holds a solid and is larger by at most `TOLERANCE`; None if none is."""
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    middle, size = (low + high) / 2, high - low
    away = solid.vertices - middle
    pos = [float(v) for v in middle]
    radius = float(np.linalg.norm(away, axis=1).max())
    if np.ptp(size) < TOLERANCE * size.max() and solid.volume > (1 - TOLERANCE) * 4 / 3 * np.pi * radius**3:
        return {"type": "sphere", "pos": pos, "diameter": 2 * radius}
    if solid.volume > (1 - TOLERANCE) * float(np.prod(size)):
        return {"type": "box", "pos": pos, "extents": [float(v) for v in size]}
    for axis in (2, 0, 1):
        across = np.delete(away, axis, axis=1)
        radius = float(np.linalg.norm(across, axis=1).max())
        if solid.volume > (1 - TOLERANCE) * np.pi * radius**2 * float(size[axis]):
            row = {"type": "cylinder", "pos": pos, "diameter": 2 * radius, "height": float(size[axis])}
            half = float(np.sqrt(0.5))
            quat = {0: [half, 0.0, half, 0.0], 1: [half, -half, 0.0, 0.0], 2: None}[axis]
            return row | ({"quat": quat} if quat else {})
    return None


def _box(solid: Solid) -> dict[str, Any]:
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    return {"type": "box", "pos": [float(v) for v in (low + high) / 2], "extents": [float(v) for v in high - low]}


def _together(hulls: list[Array]) -> float:
    return sum(volume_of(corners) for corners in hulls)


def _cut(solid: Solid) -> tuple[list[Array], str]:
    """Convex pieces (N, 3) of a solid, by CoACD where it is installed and comes to an end, else by planes; and by which.

    Raises:
        ValueError: neither cuts it.
    """
    from ..sculpt.hulls import corners_of

    vertices, faces = thinned(solid.vertices, solid.faces, TRIANGLES)
    why = "install the extra `hulls` for CoACD"
    if importlib.util.find_spec("coacd") is not None:
        try:
            found = [corners_of(points) for points in cutting.cut(vertices, faces, solid.closed)]
            return [corners for corners in found if len(corners) >= 4], "by CoACD"
        except ValueError as error:
            if not solid.closed:
                raise
            why = f"CoACD: {error}"
    return _cut_by_planes(solid, vertices, faces), f"cut by planes ({why})"


def _cut_by_planes(solid: Solid, vertices: Array, faces: Array) -> list[Array]:
    from ..sculpt.hulls import hulls
    from ..sculpt.marching import Skin

    return list(
        hulls(None, Skin(vertices, np.zeros_like(vertices), faces), max(solid.volume, 1e-300), cutting.MOST_HULLS)
    )


def thinned(vertices: Array, faces: Array, most: int) -> tuple[Array, Array]:
    """A surface of at most about so many triangles.

    Source: M. Garland, P. Heckbert, "Surface simplification using quadric error metrics" (1997), by fast-simplification.
    """
    if len(faces) <= most:
        return vertices, faces
    import fast_simplification

    middle, size = vertices.mean(axis=0), float(np.ptp(vertices, axis=0).max())
    points, index = fast_simplification.simplify(
        ((vertices - middle) / size).astype(np.float32), faces.astype(np.int32), target_count=most
    )
    return np.asarray(points, float) * size + middle, np.asarray(index, np.int64)


def volume_of(corners: Array) -> float:
    """Of the hull of points, m^3; 0 where they lie flat."""
    import manifold3d

    return float(manifold3d.Manifold.hull_points(np.ascontiguousarray(corners, float)).volume())


def hull_text(corners: Array) -> str:
    """The hull of points as OBJ text, its faces counter-clockwise from outside."""
    from scipy.spatial import ConvexHull

    faces = ConvexHull(corners).simplices
    middle = corners.mean(axis=0)
    a, b, c = (corners[faces[:, k]] - middle for k in range(3))
    inward = np.einsum("fi,fi->f", a, np.cross(b, c)) < 0
    rows = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in corners]
    rows += [f"f {i + 1} {j + 1} {k + 1}" for i, j, k in np.where(inward[:, None], faces[:, ::-1], faces)]
    return "\n".join(rows) + "\n"
