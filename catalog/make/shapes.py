"""Surfaces of revolution, sweeps, rounded convex solids and bevelled plates. Metres, z up."""

import manifold3d
import numpy as np

from .surface import Surface


def arc(centre: tuple[float, float], radius: float, from_deg: float, to_deg: float, count: int) -> np.ndarray:
    """Points (count, 2) on a circular arc in the plane."""
    angle = np.radians(np.linspace(from_deg, to_deg, count))
    return np.stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)], axis=1)


def curve(points: list[tuple[float, ...]], count: int) -> np.ndarray:
    """A smooth curve (count, D) through the points (Catmull-Rom, evenly spaced by chord)."""
    p = np.asarray(points, float)
    padded = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    chord = np.r_[0, np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))]
    at = np.interp(np.linspace(0, chord[-1], count), chord, np.arange(len(p)))
    i = np.minimum(at.astype(int), len(p) - 2)
    t = (at - i)[:, None]
    a, b, c, d = (padded[i + k] for k in range(4))
    return 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)


def lathe(profile: np.ndarray, segments: int, *, repeat: float = 1.0, v: np.ndarray | None = None) -> Surface:
    """Revolve `profile` (N, 2) of (radius, z) about z; walk it with the outside on the right-hand side going up.

    u runs once (or `repeat` times) counter-clockwise around, v along the profile's length (or as given, (N,)).
    A radius of zero at either end closes the surface in a pole.
    """
    profile = np.asarray(profile, float)
    count = len(profile)
    if v is None:
        v = np.r_[0, np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))]
        v = v / v[-1]
    angle = 2 * np.pi * np.arange(segments) / segments
    vertices, ring = [], []
    for r, z in profile:
        start = sum(map(len, vertices))
        if r < 1e-9:
            vertices.append(np.array([[0, 0, z]]))
            ring.append(np.full(segments + 1, start))
        else:
            vertices.append(np.stack([r * np.cos(angle), r * np.sin(angle), np.full(segments, z)], axis=1))
            ring.append(start + np.arange(segments + 1) % segments)
    u = np.linspace(0, repeat, segments + 1)
    uv = np.stack([np.tile(u, count), np.repeat(v, segments + 1)], axis=1)
    mid = np.stack([np.tile((u[:-1] + u[1:]) / 2, 2), np.repeat([v[0], v[-1]], segments)], axis=1)
    faces, uv_faces = [], []
    for k in range(count - 1):
        lower, upper, row = ring[k], ring[k + 1], k * (segments + 1)
        for s in range(segments):
            corners = (lower[s], lower[s + 1], upper[s + 1], upper[s])
            texels = [row + s, row + s + 1, row + segments + 2 + s, row + segments + 1 + s]
            if corners[0] == corners[1]:
                texels[0] = len(uv) + s
            if corners[2] == corners[3]:
                texels[3] = len(uv) + segments + s
            for a, b, c in ((0, 1, 2), (0, 2, 3)):
                if len({corners[a], corners[b], corners[c]}) == 3:
                    faces.append((corners[a], corners[b], corners[c]))
                    uv_faces.append((texels[a], texels[b], texels[c]))
    return Surface(np.concatenate(vertices), np.array(faces), np.concatenate([uv, mid]), np.array(uv_faces))


def sweep(
    path: np.ndarray,
    section: np.ndarray,
    *,
    side: tuple[float, float, float],
    scale: np.ndarray | None = None,
    closed: bool = False,
    tile: tuple[float, float] = (1.0, 1.0),
) -> Surface:
    """Carry a closed section (M, 2) along a path (N, 3); ends are capped unless the path is closed.

    The section's first axis lies along `side` (made normal to the path), the second along path x side. Give the section
    counter-clockwise. `scale` (N,) or (N, 2) resizes it along the way. u runs along the path in units of tile[0] metres,
    v around the section in units of tile[1] metres.
    """
    path, section = np.asarray(path, float), np.asarray(section, float)
    n, m = len(path), len(section)
    if closed:
        tangent = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    else:
        tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    first = np.asarray(side, float) - tangent * (tangent @ np.asarray(side, float))[:, None]
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(tangent, first)
    size = np.ones((n, 2)) if scale is None else np.broadcast_to(np.asarray(scale, float).reshape(n, -1), (n, 2))
    local = section[None] * size[:, None]
    vertices = (path[:, None] + local[..., :1] * first[:, None] + local[..., 1:] * second[:, None]).reshape(-1, 3)
    loop = np.concatenate([path, path[:1]]) if closed else path
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(loop, axis=0), axis=1))] / tile[0]
    ring = np.concatenate([section, section[:1]])
    around = np.r_[0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1))] / tile[1]
    if closed:  # whole repeats, so that the texture meets itself
        along *= max(1, round(along[-1])) / along[-1]
    rows = len(along)
    uv = np.stack([np.repeat(along, m + 1), np.tile(around, rows)], axis=1)
    faces, uv_faces = [], []
    for i in range(rows - 1):
        for j in range(m):
            a, b = i * m + j, i * m + (j + 1) % m
            c, d = ((i + 1) % n) * m + (j + 1) % m, ((i + 1) % n) * m + j
            ta, tb = i * (m + 1) + j, i * (m + 1) + j + 1
            tc, td = ta + m + 2, ta + m + 1
            faces += [(a, b, c), (a, c, d)]
            uv_faces += [(ta, tb, tc), (ta, tc, td)]
    if not closed:
        cap_uv = len(uv)
        uv = np.concatenate([uv, section / tile[1], section / tile[1]])
        flat = manifold3d.triangulate([section])
        faces += [(a, c, b) for a, b, c in flat] + [tuple((n - 1) * m + k for k in t) for t in flat]
        uv_faces += [(cap_uv + a, cap_uv + c, cap_uv + b) for a, b, c in flat]
        uv_faces += [tuple(cap_uv + m + k for k in t) for t in flat]
    return Surface(vertices, np.array(faces), uv, np.array(uv_faces))


def rounded_section(width: float, height: float, radius: float, steps: int = 3) -> np.ndarray:
    """A rounded rectangle (4 * steps, 2), counter-clockwise, centred."""
    x, y = width / 2 - radius, height / 2 - radius
    turns = ((x, y, 0), (-x, y, 90), (-x, -y, 180), (x, -y, 270))
    return np.concatenate([arc((cx, cy), radius, a, a + 90, steps) for cx, cy, a in turns])


def hull(points: np.ndarray) -> Surface:
    """The convex hull of points (N, 3)."""
    mesh = manifold3d.Manifold.hull_points(np.asarray(points, np.float64)).to_mesh64()
    return Surface.bare(np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts))


def rounded_hull(corners: np.ndarray, radius: float, steps: int = 3) -> Surface:
    """The convex hull of spheres at `corners` (N, 3): a convex solid with rounded edges."""
    corners = np.asarray(corners, float)
    latitude = np.radians(np.linspace(-90, 90, 2 * steps + 1))
    longitude = np.radians(np.arange(4 * steps) * 90 / steps)
    ball = [
        (np.cos(p) * np.cos(t), np.cos(p) * np.sin(t), np.sin(p))
        for p in latitude
        for t in (longitude if abs(np.cos(p)) > 1e-9 else longitude[:1])
    ]
    return hull((corners[:, None] + radius * np.array(ball)[None]).reshape(-1, 3))


def rounded_box(size: tuple[float, float, float], radius: float, steps: int = 3) -> Surface:
    """A box of full extents `size` about the origin, with rounded edges."""
    return rounded_hull(box_corners(np.asarray(size) - 2 * radius), radius, steps)


def tapered_box(
    low: tuple[float, float], high: tuple[float, float], z: tuple[float, float], radius: float, steps: int = 2
) -> Surface:
    """A rounded prism from a rectangle `low` (x, y extents) at z[0] to `high` at z[1], about the z axis."""
    points = [
        (sx * (s[0] / 2 - radius), sy * (s[1] / 2 - radius), h)
        for s, h in ((low, z[0] + radius), (high, z[1] - radius))
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    return rounded_hull(np.array(points), radius, steps)


def box_corners(size: np.ndarray) -> np.ndarray:
    """The eight corners (8, 3) of a box of full extents about the origin."""
    return np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * np.asarray(size)


def plate(outline: manifold3d.CrossSection, low: float, high: float, bevel: float, steps: int = 3) -> Surface:
    """A flat plate between two heights over an outline (holes allowed), its upper rim rounded by `bevel`."""
    loops = [np.asarray(p, float) for p in outline.to_polygons()]
    inward = []
    for loop in loops:
        ahead = np.roll(loop, -1, axis=0) - loop
        normal = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) / np.linalg.norm(ahead, axis=1, keepdims=True)
        before = np.roll(normal, 1, axis=0)
        inward.append((normal + before) / (1 + (normal * before).sum(axis=1, keepdims=True)))
    flat, miter = np.concatenate(loops), np.concatenate(inward)
    count = len(flat)
    following = np.concatenate(
        [
            s + (np.arange(len(p)) + 1) % len(p)
            for s, p in zip(np.cumsum([0] + [len(p) for p in loops[:-1]]), loops, strict=True)
        ]
    )
    rings = [(0.0, low)]
    rings += [(bevel * (1 - np.cos(t)), high - bevel * (1 - np.sin(t))) for t in np.linspace(0, np.pi / 2, steps + 1)]
    vertices = np.concatenate([np.column_stack([flat + miter * d, np.full(count, z)]) for d, z in rings])
    faces = []
    for k in range(len(rings) - 1):
        a = k * count + np.arange(count)
        b = k * count + following
        faces += [np.stack([a, b, b + count], axis=1), np.stack([a, b + count, a + count], axis=1)]
    at = np.cumsum([0] + [len(p) for p in loops])
    top = np.asarray(manifold3d.triangulate([vertices[-count:][a:b, :2] for a, b in zip(at[:-1], at[1:], strict=True)]))
    bottom = np.asarray(manifold3d.triangulate(loops))[:, ::-1]
    faces += [top + (len(rings) - 1) * count, bottom]
    return Surface.bare(vertices, np.concatenate(faces))
