"""One solid from what a file draws: corners welded, faces turned outwards, small holes closed, parts joined; and what that took.

The parts of a thing that are closed make its substance: joined exactly, what overlaps counted once, and what is inside out
within another is its cavity. Sheets beside them are only drawn. A thing that is sheets alone has no substance of its own, and
says so.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import IntakeError
from .drawn_pieces import Array, Drawn

WELD = 1e-6
"""Corners nearer than this share of the thing's diagonal are one."""
MOST_JOINED = 300
"""Parts that are joined exactly; more of them are summed up."""
MOST_TURNED = 200_000
"""Faces of one part up to which faces that disagree are turned."""
SIMPLE = 0.15
"""A hole is closed when it is smaller than this share of the diagonal, or lies flat under the thing."""
FLAT = 0.02
CORNERS_OF_A_HOLE = 400
SUBSTANCE = 0.5
"""Share of the area that must be closed for a thing to have substance."""


@dataclass(frozen=True)
class Solid:
    """A thing's substance: vertices (V, 3), faces (F, 3), and per unit of density its volume, centre (3,) and inertia (3, 3)."""

    vertices: Array
    faces: Array
    closed: bool
    volume: float
    com: Array
    inertia: Array
    """About the centre of mass."""
    said: list[str] = field(default_factory=list)


def solid_of(pieces: list[Drawn], name: str) -> Solid:
    """The solid of some pieces whose unit is metres, with z up.

    Raises:
        IntakeError: it has no volume.
    """
    vertices, faces = _together([(piece.vertices, piece.faces) for piece in pieces])
    points = vertices[np.unique(faces)]
    size = np.ptp(points, axis=0)
    diagonal = float(np.linalg.norm(size))
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if not diagonal > 0 or not spread[-1] > 1e-7 * spread[0]:
        thin = (
            f"no extent along {'xyz'[int(size.argmin())]}"
            if not size.min() > 1e-7 * diagonal
            else "all of it in one plane"
        )
        raise IntakeError("zero_volume", f"it is flat: {thin}", name, "give it thickness, and add it again")
    said: list[str] = []
    ground = float(points[:, 2].min())
    parts: list[_Part] = []
    open_ones = []
    for piece in pieces:
        # What is closed by itself is a part, however it touches others; a skin of several materials is closed with them.
        welded = _welded(piece.vertices, piece.faces, diagonal, [])
        own = next((one for one in (welded, _tidy(piece)) if len(one[1]) and not len(_loose(one[1]))), None)
        if own is None:
            open_ones.append((piece.vertices, piece.faces))
            continue
        if own is welded:
            _welded(piece.vertices, piece.faces, diagonal, said)
        parts += _parts(*own, diagonal, ground, said)
    if open_ones:
        parts += _parts(*_welded(*_together(open_ones), diagonal, said), diagonal, ground, said)
    return _joined(parts, name, list(dict.fromkeys(said)))


def _together(meshes: list[tuple[Array, Array]]) -> tuple[Array, Array]:
    """Vertices and faces of several meshes as those of one."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in meshes[:-1])])
    faces = [own + start for (_, own), start in zip(meshes, starts, strict=True)]
    return np.concatenate([vertices for vertices, _ in meshes]), np.concatenate(faces)


def _tidy(piece: Drawn) -> tuple[Array, Array]:
    """A piece as its file numbers it, without faces that name a corner twice."""
    a, b, c = piece.faces.T
    used, index = np.unique(piece.faces[(a != b) & (b != c) & (c != a)], return_inverse=True)
    return piece.vertices[used], index.reshape(-1, 3)


def _welded(vertices: Array, faces: Array, diagonal: float, said: list[str]) -> tuple[Array, Array]:
    keys = np.round(vertices / (WELD * diagonal)).astype(np.int64)
    _, first, where = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    joined = where.ravel()[faces]
    if len(first) < len(vertices):
        said.append(f"{len(vertices):,} corners became {len(first):,} where they coincide")
    points = vertices[first]
    a, b, c = joined.T
    area = np.linalg.norm(np.cross(points[b] - points[a], points[c] - points[a]), axis=1)
    whole = (a != b) & (b != c) & (c != a) & (area > 1e-14 * diagonal**2)
    if not whole.all():
        said.append(f"{int((~whole).sum()):,} faces without area removed")
    joined = joined[whole]
    joined = _once(joined, said)
    used, index = np.unique(joined, return_inverse=True)
    return points[used], index.reshape(-1, 3)


def _once(faces: Array, said: list[str]) -> Array:
    """Faces without those that are there twice, nor walls between parts that touch: two faces back to back."""
    turned = np.take_along_axis(faces, (faces.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    _, first = np.unique(turned, axis=0, return_index=True)
    kept = faces[np.sort(first)]
    if len(kept) < len(faces):
        said.append(f"{len(faces) - len(kept):,} faces that were there twice removed")
    _, first, where, count = np.unique(
        np.sort(kept, axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    walls = count[where.ravel()] == 2
    if not walls.any():
        return kept
    if walls.mean() > SUBSTANCE:  # a sheet that is drawn from both sides
        return kept[np.sort(first)]
    said.append(f"{int(walls.sum()):,} faces of walls within it removed")
    return kept[~walls]


@dataclass(frozen=True)
class _Part:
    vertices: Array
    faces: Array
    closed: bool
    volume: float
    """Signed: below 0 where it is inside out."""
    area: float


def _parts(vertices: Array, faces: Array, diagonal: float, ground: float, said: list[str]) -> list[_Part]:
    """What hangs together by edges of two faces, each with its faces turned alike and its simple holes closed."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(faces)), 3)
    _, edge, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(edge.ravel(), kind="stable")
    two = order[np.repeat(count == 2, count)].reshape(-1, 2)
    links = coo_array((np.ones(len(two), bool), (owner[two[:, 0]], owner[two[:, 1]])), shape=(len(faces), len(faces)))
    number, label = connected_components(links, directed=False)
    found, turned, holes = [], 0, 0
    ordered = faces[np.argsort(label, kind="stable")]
    for own in np.split(ordered, np.cumsum(np.bincount(label, minlength=number))[:-1]):
        used, index = np.unique(own, return_inverse=True)
        points, own = vertices[used], index.reshape(-1, 3)
        own, changed = _turned_alike(points, own)
        points, own, closed_holes = _without_holes(points, own, diagonal, ground)
        turned, holes = turned + changed, holes + closed_holes
        a, b, c = points[own[:, 0]], points[own[:, 1]], points[own[:, 2]]
        volume = float(np.einsum("fi,fi->", a, np.cross(b, c)) / 6)
        area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
        found.append(_Part(points, own, not len(_loose(own)), volume, area))
    if turned:
        said.append(f"{turned:,} faces turned to face as their neighbours do")
    if holes:
        said.append(f"{holes} hole{'s' * (holes > 1)} closed")
    return found


def _directed(faces: Array) -> Array:
    return faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def _turned_alike(points: Array, faces: Array) -> tuple[Array, int]:
    """Faces that run along each edge in opposite ways, and how many were turned for that."""
    ways = _directed(faces)
    if len(np.unique(ways, axis=0)) == len(ways) or len(faces) > MOST_TURNED:
        return faces, 0
    import trimesh

    mesh: Any = trimesh.Trimesh(points, faces, process=False)
    trimesh.repair.fix_winding(mesh)
    after = np.asarray(mesh.faces)
    changed = int((after != faces).any(axis=1).sum())
    if changed > len(faces) / 2:  # the others were few: those count as turned
        after, changed = after[:, ::-1], len(faces) - changed
    return after, changed


def _loose(faces: Array) -> Array:
    """Directed edges (N, 2) that belong to one face alone, or to more than two."""
    ways = _directed(faces)
    _, where, count = np.unique(np.sort(ways, axis=1), axis=0, return_inverse=True, return_counts=True)
    return ways[count[where.ravel()] != 2]


def _without_holes(points: Array, faces: Array, diagonal: float, ground: float) -> tuple[Array, Array, int]:
    """Close each hole that is small, or flat and under the thing, by a fan about its middle."""
    loose = _loose(faces)
    if not len(loose):
        return points, faces, 0
    after = {int(a): int(b) for a, b in loose}
    closed = 0
    if len(after) != len(loose):  # edges meet at a corner: no simple hole
        return points, faces, 0
    left, more, fans = {*after}, [points], [faces]
    count = len(points)
    while left:
        start = min(left)
        loop, at = [start], after[start]
        left.discard(start)
        while at in left:
            loop.append(at)
            left.discard(at)
            at = after[at]
        corners = points[loop]
        size = float(np.linalg.norm(np.ptp(corners, axis=0)))
        below = float(corners[:, 2].max()) - ground < FLAT * diagonal
        if at != start or not 3 <= len(loop) <= CORNERS_OF_A_HOLE or not (size < SIMPLE * diagonal or below):
            continue
        more.append(corners.mean(axis=0)[None])
        ring = np.array(loop)
        fans.append(np.column_stack([np.roll(ring, -1), ring, np.full(len(ring), count)]))
        count, closed = count + 1, closed + 1
    return np.concatenate(more), np.concatenate(fans), closed


def _joined(parts: list[_Part], name: str, said: list[str]) -> Solid:
    vertices, faces = _together([(part.vertices, part.faces) for part in parts])
    closed = [part for part in parts if part.closed and part.volume]
    area = sum(part.area for part in parts)
    if sum(part.area for part in closed) < SUBSTANCE * area:
        said.append("it is not closed, so that it has no substance of its own: what it collides as counts as that")
        return Solid(vertices, faces, False, 0.0, vertices.mean(axis=0), np.zeros((3, 3)), said)
    if len(closed) < len(parts):
        said.append(f"{len(parts) - len(closed)} open sheets are only drawn")
    if all(part.volume < 0 for part in closed):
        said.append("it was inside out: every face turned")
        closed = [_inverted(part) for part in closed]
    outer = [part for part in closed if part.volume > 0]
    inner = []
    for part in (part for part in closed if part.volume < 0):
        inside = any(_holds(other, part) for other in outer)
        inner.append(part) if inside else outer.append(_inverted(part))
        if not inside:
            said.append("a part was inside out: its faces turned")
    made = _union(outer, inner, said)
    if made is None:
        every = [*outer, *inner]
        made = _together([(part.vertices, part.faces) for part in every])
        if len(every) > 1:
            said.append(f"its {len(every)} parts are summed up, overlaps counted twice")
    elif len(outer) > 1:
        said.append(f"{len(outer)} parts joined, overlaps counted once")
    box = float(np.prod(np.ptp(vertices, axis=0)))
    a, b, c = (made[0][made[1][:, k]] - vertices.mean(axis=0) for k in range(3))
    if not float(np.einsum("fi,fi->", a, np.cross(b, c))) / 6 > 1e-9 * box:
        raise IntakeError("zero_volume", "what it encloses has no volume", name, "give it thickness, and add it again")
    volume, com, inertia = properties(*made)
    return Solid(*made, True, volume, com, inertia, said)


def _inverted(part: _Part) -> _Part:
    return _Part(part.vertices, part.faces[:, ::-1], part.closed, -part.volume, part.area)


def _holds(outer: _Part, inner: _Part) -> bool:
    low, high = outer.vertices.min(axis=0), outer.vertices.max(axis=0)
    return bool((inner.vertices.min(axis=0) >= low).all() and (inner.vertices.max(axis=0) <= high).all())


def _union(outer: list[_Part], inner: list[_Part], said: list[str]) -> tuple[Array, Array] | None:
    """The exact union of parts less their cavities; None where they cannot be joined."""
    import manifold3d

    if len(outer) + len(inner) > MOST_JOINED:
        return None

    def made(part: _Part) -> Any:
        corners, index = np.array(part.vertices, float), np.array(part.faces, np.uint64)
        return manifold3d.Manifold(manifold3d.Mesh64(vert_properties=corners, tri_verts=index))

    solids = [made(part) for part in outer]
    holes = [made(_inverted(part)) for part in inner]
    if any(solid.is_empty() for solid in (*solids, *holes)):
        return None
    whole = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    for hole in holes:
        cut = whole - hole
        if whole.volume() - cut.volume() < 0.5 * hole.volume():  # it lies in the box of a part, not in its substance
            whole = whole + hole
            said.append("a part was inside out: its faces turned")
        else:
            whole = cut
    mesh = whole.to_mesh64()
    faces = np.asarray(mesh.tri_verts, np.int64)
    return (np.asarray(mesh.vert_properties, float)[:, :3], faces) if len(faces) and whole.volume() > 0 else None


def properties(vertices: Array, faces: Array) -> tuple[float, Array, Array]:
    """Volume, centre of mass (3,) and inertia about it (3, 3) of a closed surface, of density 1.

    Source: D. Eberly, "Polyhedral mass properties (revisited)", by sums over tetrahedra.
    """
    middle = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - middle for k in range(3))
    six = np.einsum("fi,fi->f", a, np.cross(b, c))
    volume = float(six.sum() / 6)
    com = ((a + b + c) * six[:, None]).sum(axis=0) / 24 / volume
    corners = np.stack([a, b, c, a + b + c])
    second = np.einsum("f,kfi,kfj->ij", six, corners, corners) / 120 - volume * np.outer(com, com)
    return volume, com + middle, np.trace(second) * np.eye(3) - second
