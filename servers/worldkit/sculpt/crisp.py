"""Exact solids with crisp edges, by manifold3d: lathe, loft, sweep, bevelled slabs, booleans. Metres, z up.

    cup = crisp.vessel([(0.035, 0.0), (0.04, 0.09)], wall=0.003)
    frame = crisp.slab([(-0.2, -0.15), (0.2, -0.15), (0.2, 0.15), (-0.2, 0.15)], 0.02, bevel=0.003)

Every knife-sharp edge looks false: give visible ones a `bevel` of 1 to 3 mm. Where shapes flow into each other, use the
distance functions of this package instead; where they are worn or moulded, too.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..forms.bulk import Form
from .marching import Skin
from .profiles import Outline, curve
from .signatures import signature
from .signed import AXES, Array, Vec3, rotation_about

if TYPE_CHECKING:
    import manifold3d

SEGMENTS = 96


@dataclass(frozen=True, eq=False)
class Solid:
    """A watertight solid of triangles."""

    manifold: "manifold3d.Manifold"

    def __post_init__(self) -> None:
        if self.manifold.is_empty() or not self.manifold.volume() > 0:
            raise ValueError("the solid encloses no volume: check the order of its points, and what is taken away")

    def __or__(self, other: "Solid") -> "Solid":
        """Both: their union."""
        return Solid(self.manifold + other.manifold)

    def __and__(self, other: "Solid") -> "Solid":
        """What both share: their intersection."""
        return Solid(self.manifold ^ other.manifold)

    def __sub__(self, other: "Solid") -> "Solid":
        """This without the other: their difference."""
        return Solid(self.manifold - other.manifold)

    def translate(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Solid":
        """Moved by so many metres."""
        return Solid(self.manifold.translate((x, y, z)))

    def rotate(self, deg: float, axis: str | Vec3 = "z") -> "Solid":
        """Turned counter-clockwise, seen against an axis through the origin."""
        return Solid(self.manifold.transform(np.column_stack([rotation_about(deg, axis), np.zeros(3)])))

    def scale(self, factor: float | Vec3) -> "Solid":
        """Enlarged about the origin, alike or by a factor for each axis."""
        return Solid(self.manifold.scale(tuple(np.broadcast_to(np.asarray(factor, dtype=float), (3,)))))

    def mirror(self, axis: str = "x") -> "Solid":
        """With its mirror image in the plane where that coordinate is 0."""
        return Solid(self.manifold + self.manifold.mirror(tuple(np.eye(3)[AXES[axis]])))

    def cut(self, normal: Vec3, offset: float = 0.0) -> "Solid":
        """Cut off flat by a plane so far from the origin, m; points with `normal` . p < offset stay: a rim, a foot, a half."""
        way = np.asarray(normal, dtype=float)
        if not (length := float(np.linalg.norm(way))) > 0:
            raise ValueError("cut: the normal has no direction")
        return Solid(self.manifold.trim_by_plane(tuple(-way / length), -offset))

    @cached_property
    def recipe(self) -> str:
        """Tells this solid from others."""
        skin = self.skin()
        return signature("solid", skin.vertices, skin.faces)

    def skin(self) -> Skin:
        """Its surface, with one normal a vertex."""
        mesh = self.manifold.to_mesh64()
        points, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, dtype=np.int64)
        normals = np.zeros(points.shape)
        crossed = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
        for k in range(3):
            np.add.at(normals, faces[:, k], crossed)
        return Skin(points, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300), faces)

    def drawn(self) -> Skin:
        """Its surface as it is drawn: smooth, but with an edge where faces meet at more than 35 degrees."""
        skin = self.skin()
        vertices, normals, faces = Form(skin.vertices, skin.faces, (), np.zeros(3)).drawn()
        key = np.round(np.column_stack([vertices, 1e-3 * normals]), 9)
        _, first, index = np.unique(key, axis=0, return_index=True, return_inverse=True)
        return Skin(vertices[first], normals[first], index.reshape(-1)[faces])


def lathe(profile: Outline, smooth: bool = False) -> Solid:
    """A profile of (radius, height), from bottom to top, turned about z and closed along it."""
    points = np.asarray(profile, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2 or (points[:, 0] < 0).any():
        raise ValueError("lathe: the profile is a row of (radius, height), with two or more points, no radius negative")
    if smooth:
        points = np.maximum(curve(points), (0.0, -np.inf))
    closed = np.concatenate([points[:1] * (0.0, 1.0), points, points[-1:] * (0.0, 1.0)])
    return Solid(_section(closed).revolve(SEGMENTS))


def vessel(profile: Outline, wall: float, smooth: bool = False) -> Solid:
    """A vessel turned about z, open at the top: its outside (radius, height) from bottom to rim, its wall inside that, m.

    Everywhere, in the bottom too, it is as thick; the rim is flat.
    """
    import manifold3d

    points = np.asarray(profile, dtype=float)
    outside = lathe(profile, smooth)
    points = np.maximum(curve(points), (0.0, -np.inf)) if smooth else points
    way = points[-1] - points[-2]
    if not way[1] > 0 or points[-1, 1] < points[:, 1].max():
        raise ValueError("vessel: the profile rises to its rim, which is its last point")
    beyond = points[-1] + way * (3 * wall / way[1])  # so that the rim is open, and its wall as thick as below
    beyond = np.maximum(beyond, (0.0, -np.inf))
    half = np.concatenate([points[:1] * (0.0, 1.0), points, [beyond], [beyond * (0.0, 1.0)]])
    closed = np.concatenate([half, half[::-1] * (-1.0, 1.0)])  # its mirror image, so that the axis is no edge of it
    room = _section(closed).offset(-wall, manifold3d.JoinType.Round, circular_segments=SEGMENTS)
    if not wall > 0 or room.is_empty() or not room.bounds()[1] < points[-1, 1] < room.bounds()[3]:
        raise ValueError(f"vessel: a wall of {wall} m leaves no room in it")
    return outside - Solid(room.revolve(SEGMENTS))


def hull(*solids: Solid) -> Solid:
    """What a skin drawn tight over solids encloses, without hollows: an egg over two balls, a spoon's bowl over bowl and lip."""
    import manifold3d

    return Solid(manifold3d.Manifold.batch_hull([one.manifold for one in solids]))


def slab(outline: Outline, height: float, bevel: float = 0.0, smooth: bool = False, twist_deg: float = 0.0) -> Solid:
    """An outline of (x, y) pulled up from z = 0 to a height, all its edges rounded off over a bevel, m."""
    points = np.asarray(outline, dtype=float)
    section = _section(curve(points, closed=True) if smooth else points)
    if not bevel:
        steps = max(1, int(abs(twist_deg) / 5))
        return Solid(section.extrude(height, steps, twist_deg))
    if twist_deg:
        raise ValueError("slab: a twisted slab has no bevel")
    if not 0 < 2 * bevel < height:
        raise ValueError(f"slab: a bevel of {bevel} m does not fit a height of {height} m")
    import manifold3d

    inner = section.offset(-bevel, manifold3d.JoinType.Miter)
    if inner.is_empty():
        raise ValueError(f"slab: the outline is thinner than twice its bevel of {bevel} m")
    core = inner.extrude(height - 2 * bevel).translate((0, 0, bevel))
    return Solid(core.minkowski_sum(manifold3d.Manifold.sphere(bevel, 12)))


def box(size: Vec3, bevel: float = 0.0) -> Solid:
    """A box of full extents `size`, centred on the origin, all its edges bevelled by so many metres."""
    import manifold3d

    half = np.asarray(size, dtype=float) / 2
    if not 0 <= bevel < half.min():
        raise ValueError(f"box: a bevel of {bevel} m does not fit {size}")
    corners = [
        np.where(np.arange(3) == k, half, half - bevel) * (np.array([n & 1, n >> 1 & 1, n >> 2 & 1]) * 2 - 1)
        for k in range(3)
        for n in range(8)
    ]
    return Solid(manifold3d.Manifold.hull_points(np.array(corners)))


def loft(sections: Sequence[Sequence[Vec3]]) -> Solid:
    """A skin drawn over sections, closed rows of as many points (x, y, z) each, in order: a hull, a wing, a bonnet.

    The rows run the same way round, each point joined to that of its number in the next row; both ends are closed.
    """
    rows = np.asarray(sections, dtype=float)
    if rows.ndim != 3 or rows.shape[0] < 2 or rows.shape[1] < 3 or rows.shape[2] != 3:
        raise ValueError("loft: give two or more sections of as many points (x, y, z) each, three or more")
    count, around = rows.shape[:2]
    faces = []
    for s in range(count - 1):
        for k in range(around):
            a, b = s * around + k, s * around + (k + 1) % around
            faces += [(a, b, b + around), (a, b + around, a + around)]
    points = np.concatenate([rows.reshape(-1, 3), rows[:1].mean(axis=1), rows[-1:].mean(axis=1)])
    first, last = count * around, count * around + 1
    for k in range(around):
        n = (k + 1) % around
        faces += [(first, n, k), (last, (count - 1) * around + k, (count - 1) * around + n)]
    return Solid(_closed(points, np.array(faces), "loft"))


def turned(outline: Outline, deg: float = 360.0) -> Solid:
    """A closed outline of (radius, height) turned about z, clear of it: a ring, a tyre, a pipe; or part of the way round."""
    points = np.asarray(outline, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or (points[:, 0] < 0).any():
        raise ValueError("turned: the outline is a closed row of (radius, height), no radius negative")
    return Solid(_section(points).revolve(SEGMENTS, deg))


def torus(diameter: float, thickness: float, deg: float = 360.0) -> Solid:
    """A ring lying flat: its outer diameter, and the diameter of its round wire; or part of one, from +x."""
    return turned([(x + (diameter - thickness) / 2, z) for x, z in ring(thickness, 20)], deg)


def ball(diameter: float) -> Solid:
    """A ball."""
    import manifold3d

    return Solid(manifold3d.Manifold.sphere(diameter / 2, 48))


def cylinder(diameter: float, height: float, bevel: float = 0.0) -> Solid:
    """An upright cylinder from z = 0, its rims bevelled by so many metres."""
    if not 0 <= 2 * bevel < min(diameter, height):
        raise ValueError(
            f"cylinder: a bevel of {bevel} m does not fit a diameter of {diameter} m and a height of {height} m"
        )
    r, b = diameter / 2, bevel
    return lathe([(r - b, 0), (r, b), (r, height - b), (r - b, height)] if b else [(r, 0), (r, height)])


def pipe(outside: float, inside: float, height: float) -> Solid:
    """An upright pipe from z = 0, by its diameters."""
    return turned([(inside / 2, 0), (outside / 2, 0), (outside / 2, height), (inside / 2, height)])


def wire(points: Sequence[Vec3], diameter: float, smooth: bool = True, scales: Sequence[float] | None = None) -> Solid:
    """A round rod through points, m: a wire, a leg, a handle, a hose; `scales` are of its diameter at each of them."""
    return sweep(ring(diameter, 20), points, smooth, scales)


def around(solid: Solid, count: int, axis: str | Vec3 = "z") -> Solid:
    """So many copies of a solid at equal angles round an axis through the origin."""
    return together(*(solid.rotate(360 * k / count, axis) for k in range(count)))


def together(*solids: Solid) -> Solid:
    """The union of several."""
    import manifold3d

    return Solid(manifold3d.Manifold.batch_boolean([one.manifold for one in solids], manifold3d.OpType.Add))


def sweep(outline: Outline, path: Sequence[Vec3], smooth: bool = True, scales: Sequence[float] | None = None) -> Solid:
    """An outline of (x, y) carried along a path, upright on it: a handle, a rail, a horn, a moulding.

    `scales` enlarge the outline at each point of the path. The frame is carried without turning about the path.
    """
    line = np.asarray(path, dtype=float)
    if line.ndim != 2 or line.shape[1] != 3 or len(line) < 2:
        raise ValueError("sweep: the path is two or more points (x, y, z)")
    sizes = np.ones(len(line)) if scales is None else np.asarray(scales, dtype=float)
    if len(sizes) != len(line) or not (sizes > 0).all():
        raise ValueError("sweep: one positive scale for each point of the path")
    if smooth and len(line) > 2:
        both = curve(np.column_stack([line, sizes]))
        line, sizes = both[:, :3], both[:, 3]
    ways = np.gradient(line, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    side = np.cross(ways[0], (0.0, 0.0, 1.0))
    side = np.array([1.0, 0.0, 0.0]) if np.linalg.norm(side) < 1e-6 else side / np.linalg.norm(side)
    points = np.asarray(outline, dtype=float)
    sections = []
    for at, way, size in zip(line, ways, sizes, strict=True):
        side = side - way * (side @ way)
        side /= np.linalg.norm(side)
        up = np.cross(side, way)
        sections.append(at + size * (points[:, :1] * side + points[:, 1:] * up))
    return loft(sections)


def ring(diameter: float, corners: int = 32) -> list[tuple[float, float]]:
    """An outline: a circle, for `sweep` and `slab`."""
    turn = np.arange(corners) * 2 * np.pi / corners
    return [(float(x), float(y)) for x, y in zip(diameter / 2 * np.cos(turn), diameter / 2 * np.sin(turn), strict=True)]


def _section(points: Array) -> "manifold3d.CrossSection":
    import manifold3d

    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
        raise ValueError("the outline is a closed row of three or more points (x, y)")
    section = manifold3d.CrossSection([points], manifold3d.FillRule.NonZero)
    if section.is_empty():
        raise ValueError("the outline encloses no area")
    return section


def _closed(points: Array, faces: Array, what: str) -> "manifold3d.Manifold":
    import manifold3d

    for order in (faces, faces[:, ::-1]):
        mesh = manifold3d.Mesh64(vert_properties=points, tri_verts=np.ascontiguousarray(order).astype(np.uint64))
        mesh.merge()
        solid = manifold3d.Manifold(mesh)
        if not solid.is_empty() and solid.volume() > 0:
            return solid
    raise ValueError(
        f"{what}: its sections do not make a closed solid: do they run the same way round, without crossing?"
    )
