"""Many bodies or particles of one substance as one smooth surface, made for each picture from where they are then."""

from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.laws import PLAIN

from ..recording import point_colours

if TYPE_CHECKING:
    import mujoco

REACH = 2.4
"""A particle draws the surface towards itself within so many of its radii."""
CELLS_A_RADIUS, LONE_CELLS, LEAST_CELLS = 3.0, 2.4, 1.5
MOST_CELLS = 3_000_000
SMOOTH_CELLS = 0.7
SUNK = 0.8
"""Radii that a level surface would lie too deep for each time that the mean reaches as far again: measured on heaps of points."""
MOST_TRIANGLES, LEAST_TRIANGLES, TRIANGLES_EACH = 150_000, 4_000, 240
"""A surface has room for so many: at most, at least, and for each particle."""
SAMPLES = 5
"""A long shape counts as so many balls in a row."""
NEAREST, MINGLING, DARKEST = 12, 3.0, 0.02
"""So many particles colour a corner, within so many of their radii; what is darker than this (sRGB) would swallow all else."""
NOWHERE = -1e4
FLAKE = 0.7
"""What falls alone of a snow is drawn so much as wide as what lies together: it is flakes, not lumps."""
COMPANY = 6
"""With so many others near, a ball lies among them: on a layer it has more, in the air less."""
LEAST_M = 1e-6
"""A ball with a smaller radius is not drawn."""
DEEPEST_CELLS = 96
"""What is thicker than so many cells of the grid counts as so thick."""


class Surface:
    """One substance's skin in the dressed world, which has room for a fixed number of triangles.

    Args:
        model: the dressed world.
        skin: number of its skin.
        geoms: numbers of the geoms that it stands for.
        blended: it has their colours, mixed where they meet, in place of its look's; colours that a law tells it has always.
        alone: what has next to nothing near it is drawn this share as wide.
        smooth: how many times as far as else places are evened out.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        skin: int,
        geoms: "np.ndarray",
        blended: bool = False,
        alone: float = 1.0,
        smooth: float = 1.0,
    ) -> None:
        self._model, self._geoms, self._alone, self._smooth = model, geoms, alone, smooth
        first, count = int(model.skin_vertadr[skin]), int(model.skin_vertnum[skin])
        self._vertices = model.skin_vert[first : first + count]
        first, count = int(model.skin_faceadr[skin]), int(model.skin_facenum[skin])
        self._faces = model.skin_face[first : first + count]
        colours, first = point_colours.of(model), int(model.skin_vertadr[skin])
        mine = slice(first, first + int(model.skin_vertnum[skin]))
        self._told, self._own, self._thick = colours.geom, colours.skin[mine], colours.thick[mine]
        self._blended = blended
        self._laid: tuple[np.ndarray, ...] | None = None
        self._colour(self._own[:0], np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))

    def place(self, data: "mujoco.MjData", eye: "np.ndarray | None" = None, pixel: float = 0.0) -> None:
        """Lay the surface around its particles as they are in `data`, no finer than an eye (3,) sees whose pixels are so wide, rad."""
        points, radii, owners = balls(self._model, data, self._geoms)
        radii, finest = narrowed(points, radii, self._alone), 0.0
        if eye is not None and len(points):
            finest = pixel * max(float((np.linalg.norm(points - eye, axis=1) - radii).min()), 0.0)
        here = self._decides(points, radii, finest)
        if self._laid is not None and all(map(np.array_equal, self._laid, here)):
            return  # a frame is set up for its picture and again for how it moves: it is laid once
        self._laid = here
        vertices, faces, thick = around(points, radii, len(self._faces), len(self._vertices), finest, self._smooth)
        self._vertices[:] = NOWHERE
        self._faces[:] = len(self._vertices) - 1
        self._vertices[: len(vertices)], self._faces[: len(faces)] = vertices, faces
        self._thick[: len(vertices)], self._thick[len(vertices) :] = thick, 0.0
        self._colour(vertices, owners, points, radii)

    def _decides(self, points: "np.ndarray", radii: "np.ndarray", finest: float) -> "tuple[np.ndarray, ...]":
        """All by which the surface is laid and coloured, as it is now."""
        own = self._model.geom_rgba[self._geoms] if self._blended else np.zeros(0)
        return points, radii, np.array(finest), self._told[self._geoms], np.array(own)

    def _colour(self, vertices: "np.ndarray", owners: "np.ndarray", points: "np.ndarray", radii: "np.ndarray") -> None:
        """Mix the colours of the particles around each corner, as paints: by what each takes from light."""
        told = self._told[self._geoms]
        if not self._blended and (not len(told) or told.min() < 0):
            self._own[:] = PLAIN
            return
        own = np.array([seen_rgb(self._model, geom) for geom in self._geoms]).reshape(-1, 3) if self._blended else told
        own = np.where(told < 0, own, told)
        self._own[:] = own.mean(axis=0) if len(own) else 0.5
        if len(vertices):
            self._own[: len(vertices)] = mixed(vertices, points, radii, own[np.searchsorted(self._geoms, owners)])


def seen_rgb(model: "mujoco.MjModel", geom: int) -> "np.ndarray":
    """(3,) sRGB of a geom."""
    from .renderers.preview.finish import of_material

    material = int(model.geom_matid[geom])
    return np.asarray(
        model.geom_rgba[geom, :3] if material < 0 else np.array(of_material(model, material).mean) ** (1 / 2.2)
    )


def mixed(vertices: "np.ndarray", points: "np.ndarray", radii: "np.ndarray", colours: "np.ndarray") -> "np.ndarray":
    """(V, 3) sRGB at corners of a surface around balls (P) of these colours, those near by weight: the mean of their logarithms,
    as layers of colour add up what they absorb (the law of Beer and Lambert).
    """
    from scipy.spatial import cKDTree

    away, near = cKDTree(points).query(vertices, k=min(NEAREST, len(points)))
    away, near = away.reshape(len(vertices), -1), near.reshape(len(vertices), -1)
    weight = np.maximum(1.0 - (away / (MINGLING * radii[near])) ** 2, 1e-3 / (1.0 + away / radii[near])) ** 3
    lost = np.log(np.maximum(colours, DARKEST))[near]
    return np.asarray(np.exp((weight[..., None] * lost).sum(axis=1) / weight.sum(axis=1, keepdims=True)))


def narrowed(points: "np.ndarray", radii: "np.ndarray", alone: float) -> "np.ndarray":
    """(P,) m: the radii of balls (P), of which those with fewer than `COMPANY` others within reach are `alone` times as wide."""
    return radii if alone >= 1.0 else np.where(_lone(points, radii), alone * radii, radii)


def _lone(points: "np.ndarray", radii: "np.ndarray") -> "np.ndarray":
    """(P,) which balls have fewer than `COMPANY` others within reach; none where there are no more in all."""
    from scipy.spatial import cKDTree

    if len(points) <= COMPANY:
        return np.zeros(len(points), dtype=bool)
    away, _ = cKDTree(points).query(points, k=COMPANY + 1)
    return np.asarray(away[:, -1] > REACH * radii)


def room(particles: int) -> int:
    """The number of triangles to keep for so many particles."""
    return int(np.clip(TRIANGLES_EACH * particles, LEAST_TRIANGLES, MOST_TRIANGLES))


def balls(
    model: "mujoco.MjModel", data: "mujoco.MjData", geoms: "np.ndarray"
) -> "tuple[np.ndarray, np.ndarray, np.ndarray]":
    """Middles (P, 3), m, radii (P,), m, and geoms (P,) of balls that fill some geoms; long ones are filled by several."""
    import mujoco

    kinds = mujoco.mjtGeom
    geoms = np.asarray(geoms, dtype=int)
    if (model.geom_type[geoms] == kinds.mjGEOM_SPHERE).all():  # thousands of particles, one by one, take half a second
        sizes = np.array(model.geom_size[geoms, 0])
        drawn = sizes >= LEAST_M
        return np.array(data.geom_xpos[geoms[drawn]]), sizes[drawn], geoms[drawn]
    points, radii, owners = [], [], []
    for geom in geoms:
        size, kind = model.geom_size[geom], model.geom_type[geom]
        if kind == kinds.mjGEOM_SPHERE:
            half = np.full(3, size[0])
        elif kind in (kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER):
            half = np.array([size[0], size[0], size[1] + (size[0] if kind == kinds.mjGEOM_CAPSULE else 0.0)])
        else:
            half = np.array(model.geom_aabb[geom, 3:])
        radius = float(np.sort(half)[0] + np.sort(half)[1]) / 2
        if radius < LEAST_M:  # not drawn
            continue
        axis = int(half.argmax())
        row = np.linspace(-1, 1, SAMPLES) * (half[axis] - radius) if half[axis] > 1.2 * radius else np.zeros(1)
        own = np.zeros((len(row), 3))
        own[:, axis] = row
        turn = data.geom_xmat[geom].reshape(3, 3)
        points.append(own @ turn.T + data.geom_xpos[geom])
        radii.append(np.full(len(row), radius))
        owners.append(np.full(len(row), geom))
    if not points:
        return np.zeros((0, 3)), np.zeros(0), np.zeros(0, int)
    return np.concatenate(points), np.concatenate(radii), np.concatenate(owners)


def around(
    points: "np.ndarray",
    radii: "np.ndarray",
    most_faces: int,
    most_vertices: int,
    finest: float = 0.0,
    smooth: float = 1.0,
) -> "tuple[np.ndarray, np.ndarray, np.ndarray]":
    """Vertices (V, 3), m, faces (F, 3), outward, of a smooth surface around balls, and how thick (V,), m, it is straight in from
    each vertex; all empty where there is none.

    After Zhu and Bridson, "Animating Sand as a Fluid" (2005): the distance to the weighted mean of what is near, less its
    radius, which is flat over what lies level, and smoothed a little. `finest`, m: what is smaller is not seen. `smooth`: the mean
    reaches so many times as far.
    """
    if not len(points):
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32), np.zeros(0)
    radius, even = float(np.median(radii)), np.full(len(points), smooth)
    cell = min(max(smooth * radius / CELLS_A_RADIUS, finest), smooth * radius / LEAST_CELLS)
    if smooth > 1.0 and (lone := _lone(points, radii)).any():  # what flies apart keeps its own shape
        even[lone] = 1.0
        cell = min(cell, max(float(radii[lone].min()) / LONE_CELLS, finest))
    while True:
        vertices, faces, thick, cell = _meshed(points, radii, cell, even)
        if len(faces) <= most_faces and len(vertices) < most_vertices:
            return vertices, faces, thick
        cell *= 1.25


def _meshed(
    points: "np.ndarray", radii: "np.ndarray", cell: float, even: "np.ndarray"
) -> "tuple[np.ndarray, np.ndarray, np.ndarray, float]":
    from scipy.ndimage import gaussian_filter
    from scipy.sparse import csr_array
    from skimage.measure import marching_cubes

    margin = REACH * float((even * radii).max()) + 2 * cell
    low, span = points.min(axis=0) - margin, np.ptp(points, axis=0) + 2 * margin
    cell = max(cell, float(np.prod(span) / MOST_CELLS) ** (1 / 3))
    low, span = low - 2 * cell, span + 4 * cell  # all that a ball reaches is in the grid
    shape = tuple(int(n) for n in np.ceil(span / cell) + 1)
    total, strides = int(np.prod(shape)), np.array([shape[1] * shape[2], shape[2], 1])
    sums = np.zeros((total, 5))  # of the weights, and of them with places and radii
    for radius, smooth in np.unique(
        np.round(np.column_stack([radii, even]), 9), axis=0
    ):  # they reach over equally many cells
        mine = points[(np.abs(radii - radius) < 1e-8) & (np.abs(even - smooth) < 1e-8)]
        reach = REACH * smooth * radius
        n = int(np.ceil(reach / cell))
        around_it = np.stack(np.meshgrid(*[np.arange(-n, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
        around_it = around_it[np.linalg.norm(around_it, axis=1) <= reach / cell + 0.9]
        for part in np.array_split(mine, len(mine) * len(around_it) // 4_000_000 + 1):
            nearest = np.rint((part - low) / cell).astype(int)
            off = (nearest * cell + low - part) / reach
            steps = around_it * (cell / reach)
            away = (off**2).sum(axis=1)[:, None] + 2 * off @ steps.T + (steps**2).sum(axis=1)
            weights = np.maximum(1.0 - away, 0.0) ** 3
            places = (nearest @ strides)[:, None] + around_it @ strides
            ends = np.arange(0, places.size + 1, len(around_it))
            table = csr_array((weights.ravel(), places.ravel(), ends), shape=(len(part), total))
            sums += table.T @ np.column_stack([np.ones(len(part)), part, np.full(len(part), radius)])
    weight, mean, mean_radius = sums[:, 0], sums[:, 1:4], sums[:, 4]
    near = weight > 1e-9
    places = np.stack(np.unravel_index(np.flatnonzero(near), shape), -1) * cell + low
    level = np.full(total, 2.0 * cell)
    distance = np.linalg.norm(places - mean[near] / weight[near, None], axis=1) - mean_radius[near] / weight[near]
    if (
        smooth := float(even.max())
    ) > 1.0:  # the mean of what lies beneath is deeper, the farther it reaches; that of a lone drop is not
        among = np.median(weight[np.rint((points - low) / cell).astype(int) @ strides])
        distance -= SUNK * (smooth - 1.0) * np.median(radii) * np.minimum(2.0 * weight[near] / among, 1.0)
    level[near] = np.clip(distance, -3.0 * cell, 3.0 * cell)
    field: Any = gaussian_filter(level.reshape(shape), SMOOTH_CELLS)
    if not field.min() < 0.0 < field.max():
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32), np.zeros(0), cell
    vertices, faces, inward, _ = marching_cubes(field, 0.0, spacing=(cell,) * 3, gradient_direction="descent")
    return vertices + low, faces.astype(np.int32), cell * _thickness(field, vertices / cell, inward), cell


def _thickness(field: "np.ndarray", starts: "np.ndarray", inward: "np.ndarray") -> "np.ndarray":
    """(V,) how far it is from places (V, 3) on the surface, along unit vectors `inward` (V, 3), to where a field is no
    longer negative, all in cells.
    """
    from scipy.ndimage import map_coordinates

    found, alive = np.full(len(starts), float(DEEPEST_CELLS)), np.arange(len(starts))
    before = np.zeros(len(starts))
    for step in range(1, DEEPEST_CELLS):
        here = map_coordinates(field, (starts[alive] + step * inward[alive]).T, order=1, mode="nearest")
        left = here >= 0.0
        gone = alive[left]
        found[gone] = step - here[left] / np.maximum(here[left] - before[gone], 1e-12)
        before[alive] = here
        alive = alive[~left]
        if not len(alive):
            break
    return np.maximum(found, 0.5)
