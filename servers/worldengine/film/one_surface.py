"""Many bodies or particles of one substance as one smooth surface, made for each picture from where they are then."""

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import mujoco

REACH = 2.4
"""A particle draws the surface towards itself within so many of its radii."""
CELLS_A_RADIUS = 3.0
MOST_CELLS = 3_000_000
SMOOTH_CELLS = 0.7
MOST_TRIANGLES, LEAST_TRIANGLES, TRIANGLES_EACH = 150_000, 4_000, 240
"""A surface has room for so many: at most, at least, and for each particle."""
SAMPLES = 5
"""A long shape counts as so many balls in a row."""
NOWHERE = -1e4


class Surface:
    """One substance's skin in the dressed world, which has room for a fixed number of triangles.

    Args:
        model: the dressed world.
        skin: number of its skin.
        geoms: numbers of the geoms that it stands for.
    """

    def __init__(self, model: "mujoco.MjModel", skin: int, geoms: "np.ndarray") -> None:
        self._model, self._geoms = model, geoms
        first, count = int(model.skin_vertadr[skin]), int(model.skin_vertnum[skin])
        self._vertices = model.skin_vert[first : first + count]
        first, count = int(model.skin_faceadr[skin]), int(model.skin_facenum[skin])
        self._faces = model.skin_face[first : first + count]

    def place(self, data: "mujoco.MjData") -> None:
        """Lay the surface around its particles as they are in `data`."""
        points, radii = balls(self._model, data, self._geoms)
        vertices, faces = around(points, radii, len(self._faces), len(self._vertices))
        self._vertices[:] = NOWHERE
        self._faces[:] = len(self._vertices) - 1
        self._vertices[: len(vertices)], self._faces[: len(faces)] = vertices, faces


def room(particles: int) -> int:
    """The number of triangles to keep for so many particles."""
    return int(np.clip(TRIANGLES_EACH * particles, LEAST_TRIANGLES, MOST_TRIANGLES))


def balls(model: "mujoco.MjModel", data: "mujoco.MjData", geoms: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":
    """Middles (P, 3), m, and radii (P,), m, of balls that fill some geoms; long ones are filled by several."""
    import mujoco

    kinds = mujoco.mjtGeom
    points, radii = [], []
    for geom in geoms:
        size, kind = model.geom_size[geom], model.geom_type[geom]
        if kind == kinds.mjGEOM_SPHERE:
            half = np.full(3, size[0])
        elif kind in (kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER):
            half = np.array([size[0], size[0], size[1] + (size[0] if kind == kinds.mjGEOM_CAPSULE else 0.0)])
        else:
            half = np.array(model.geom_aabb[geom, 3:])
        radius = float(np.sort(half)[0] + np.sort(half)[1]) / 2
        if radius < 1e-6:  # not drawn
            continue
        axis = int(half.argmax())
        row = np.linspace(-1, 1, SAMPLES) * (half[axis] - radius) if half[axis] > 1.2 * radius else np.zeros(1)
        own = np.zeros((len(row), 3))
        own[:, axis] = row
        turn = data.geom_xmat[geom].reshape(3, 3)
        points.append(own @ turn.T + data.geom_xpos[geom])
        radii.append(np.full(len(row), radius))
    if not points:
        return np.zeros((0, 3)), np.zeros(0)
    return np.concatenate(points), np.concatenate(radii)


def around(
    points: "np.ndarray", radii: "np.ndarray", most_faces: int, most_vertices: int
) -> "tuple[np.ndarray, np.ndarray]":
    """Vertices (V, 3), m, and faces (F, 3), outward, of a smooth surface around balls; both empty where there is none.

    After Zhu and Bridson, "Animating Sand as a Fluid" (2005): the distance to the weighted mean of what is near, less its
    radius, which is flat over what lies level, and smoothed a little.
    """
    if not len(points):
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32)
    cell = float(np.median(radii)) / CELLS_A_RADIUS
    while True:
        vertices, faces, cell = _meshed(points, radii, cell)
        if len(faces) <= most_faces and len(vertices) < most_vertices:
            return vertices, faces
        cell *= 1.25


def _meshed(points: "np.ndarray", radii: "np.ndarray", cell: float) -> "tuple[np.ndarray, np.ndarray, float]":
    from scipy.ndimage import gaussian_filter
    from skimage.measure import marching_cubes

    largest = float(radii.max())
    low = points.min(axis=0) - 2.0 * largest - 3 * cell
    span = np.ptp(points, axis=0) + 4.0 * largest + 6 * cell
    cell = max(cell, float(np.prod(span) / MOST_CELLS) ** (1 / 3))
    shape = tuple(int(n) for n in np.ceil(span / cell) + 1)
    total = int(np.prod(shape))
    weight, mean, mean_radius = np.zeros(total), np.zeros((3, total)), np.zeros(total)
    for radius in np.unique(np.round(radii, 9)):  # balls of one size reach over equally many cells
        mine = points[np.abs(radii - radius) < 1e-8]
        reach = REACH * radius
        n = int(np.ceil(reach / cell))
        around_it = np.stack(np.meshgrid(*[np.arange(-n, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
        around_it = around_it[np.linalg.norm(around_it, axis=1) <= n + 1]
        for part in np.array_split(mine, max(1, len(mine) * len(around_it) // 2_000_000 + 1)):
            index = np.round((part - low) / cell).astype(int)[:, None] + around_it
            good = ((index >= 0) & (index < np.array(shape))).all(axis=-1)
            away = np.linalg.norm(index * cell + low - part[:, None], axis=-1) / reach
            w = np.maximum(1.0 - away**2, 0.0) ** 3 * good
            flat = np.ravel_multi_index(tuple(np.moveaxis(np.where(good[..., None], index, 0), -1, 0)), shape).ravel()
            weight += np.bincount(flat, w.ravel(), total)
            mean_radius += np.bincount(flat, (w * radius).ravel(), total)
            for axis in range(3):
                mean[axis] += np.bincount(flat, (w * part[:, None, axis]).ravel(), total)
    near = weight > 1e-9
    places = np.stack(np.unravel_index(np.flatnonzero(near), shape), -1) * cell + low
    level = np.full(total, 2.0 * cell)
    distance = np.linalg.norm(places - (mean[:, near] / weight[near]).T, axis=1) - mean_radius[near] / weight[near]
    level[near] = np.clip(distance, -3.0 * cell, 3.0 * cell)
    field: Any = gaussian_filter(level.reshape(shape), SMOOTH_CELLS)
    if not field.min() < 0.0 < field.max():
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32), cell
    vertices, faces, _, _ = marching_cubes(field, 0.0, spacing=(cell,) * 3, gradient_direction="descent")
    return vertices + low, faces.astype(np.int32), cell
