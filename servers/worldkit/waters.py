"""Fill a container with water: the surface, walls and floor of it as one mesh, whose surface waves, with beads for drops.

What it does lies with the solver `water` (`worldengine.solvers.water`), which the plan asks for; here it gets its shape, by rays from
the container's middle to its walls. A container is anything that stands still and is closed around that middle up to the level.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import moved_shapes
from .errors import ProgramError
from .naming import names
from .polygons import area, inside

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SURFACE_POINTS = 4000
"""Corners of the surface, about."""
RINGS = 12
"""Of corners down the walls."""
DROPS = 90
"""Beads, each of which can be a drop."""
MOST_DROPS = 1000
"""Of 12 corners each, which are recorded."""
INTO_M, INTO = 2e-4, 0.002
"""So far it reaches into the walls, m, and of its half width: no gap is seen, and in glass light passes from one to the other."""
FREE_M = 1e-3
"""The rim is so much higher than the level, at least."""
SMALL_M = 1e-5
"""Radius of a bead that is no drop."""
SLIPS = (-1.3e-4, 1.7e-4)
"""Radians beside each way to the wall, along which it is looked for."""


@dataclass(frozen=True)
class Vessel:
    """The inside of a container below a level, seen from its middle."""

    middle: "np.ndarray"
    """(2,) m."""
    floor: float
    level: float
    rings: "np.ndarray"
    """(R, P, 2) m: its walls at R heights from the level down."""
    heights: "np.ndarray"
    """(R,) m."""


def fill(
    spec: "mujoco.MjSpec", name: str, *, container: str, level: float, look: str = "water_clear", drops: int = DROPS
) -> "mujoco.MjsFlex":
    """Fill a container.

    Args:
        spec: the world, with the container in it, at its place.
        name: of the flex that shows the water; the plan's row names it in `shown_by`.
        container: the body that holds it, which stands still.
        level: height of the surface, m, world frame.
        look: of the skill materials, one that is clear.
        drops: how many can fly at a time.

    Raises:
        ProgramError: the container is not there, has no shape, moves, is open at the level or below it, or has no floor under it;
            the drops are no number from 0 on, or too many to be recorded.
    """
    import numpy as np

    if not (0 <= drops <= MOST_DROPS and drops == int(drops)):
        cause = f"{drops} drops cannot fly"
        raise ProgramError(cause, f"waters.fill({container})", f"let drops be a whole number from 0 to {MOST_DROPS}")
    vessel = measure(spec, container, level)
    points, triangles = _mesh(vessel)
    beads, faces = _beads(vessel, drops)
    count = len(points) + 12 * np.arange(drops)[:, None, None]
    return moved_shapes.surface(
        spec, name, np.concatenate([points, beads]), np.concatenate([triangles, (faces + count).reshape(-1, 3)]), look
    )


def measure(spec: "mujoco.MjSpec", container: str, level: float) -> Vessel:
    """The inside of a container below a level; errors as of `fill`."""
    import mujoco
    import numpy as np

    from .cameras.subjects import corners

    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    bodies = names(model, "body", model.nbody)
    place = f"waters.fill({container})"
    if container not in bodies[1:]:
        raise ProgramError(f"there is no {container!r} to fill", place, f"name one of: {', '.join(bodies[1:])}")
    body = bodies.index(container)
    if model.body_weldid[body] != 0:
        raise ProgramError(f"{container} can move, and its water could not", place, "give it `fixed: true`")
    mine = model.geom_bodyid == body
    if not mine.any():
        raise ProgramError(f"{container} has no shape, and holds nothing", place, "name the body that has the walls")
    drawn = mine & (model.geom_contype == 0) & (model.geom_conaffinity == 0)
    model.geom_group[:] = 0
    model.geom_group[drawn if drawn.any() else mine] = 5  # what is seen; else what is touched
    group, hit = np.array([0, 0, 0, 0, 0, 1], np.uint8), np.zeros(1, np.int32)

    def far(x: float, y: float, z: float, way: "np.ndarray") -> float:
        return float(mujoco.mj_ray(model, data, np.array([x, y, z]), way, group, True, -1, hit))

    down = np.array([0.0, 0.0, -1.0])
    around_it = corners(model, data, np.flatnonzero(model.geom_group == 5))
    low, high = around_it.min(axis=0), around_it.max(axis=0)
    x, y = (low[:2] + high[:2]) / 2
    # Beside the middle, where the triangles of what a lathe turned meet in one corner, which a ray may slip through.
    beside = 0.01 * (high[:2] - low[:2]) * (0.7, 0.4)
    over = float(max(high[2], level)) + 0.01
    ways_down = [far(x + s * beside[0], y + t * beside[1], over, down) for s, t in ((1, 1), (-1, 1), (1, -1), (-1, -1))]
    floor = over - max(ways_down)
    depth = level - floor
    if max(ways_down) <= 0 or depth < FREE_M:
        found = "it has none in its middle" if max(ways_down) <= 0 else f"its floor is at {floor:.4g} m"
        cause = f"there is no floor of {container} under the level of {level:g} m: {found}; it reaches up to {high[2]:.4g} m"
        raise ProgramError(cause, place, "let the level be between its floor and its rim")
    turn = data.xmat[body].reshape(3, 3)[:2, 0]
    yaw = float(np.arctan2(turn[1], turn[0]))
    wide = far(x, y, level, np.array([np.cos(yaw), np.sin(yaw), 0.0]))
    around = int(
        np.clip(2 * np.pi * max(wide, depth, 1e-3) / np.sqrt(np.pi * max(wide, 1e-3) ** 2 / SURFACE_POINTS), 48, 176)
    )
    angles = yaw + 2 * np.pi * np.arange(around) / around

    def ring(z: float, angles: "np.ndarray" = angles) -> "np.ndarray":
        """(P,) m: how far the wall is at a height, the nearest of some rays, as one may slip through an edge; 0 where there is none."""
        found = np.array([[far(x, y, z, np.array([np.cos(a + s), np.sin(a + s), 0.0])) for a in angles] for s in SLIPS])
        return np.where((found > 0).any(axis=0), np.where(found > 0, found, np.inf).min(axis=0), 0.0)

    for height, where in ((level, "at"), (level + FREE_M, "just above")):
        if (gone := ring(height) <= 0).any():
            rim = max((z for z in np.linspace(floor + FREE_M, level, 60) if (ring(z) > 0).all()), default=floor)
            cause = (
                f"{container} is open to {gone.sum()} of {around} sides {where} the level of {level:g} m; "
                f"it is closed from {floor:.4g} m up to {rim:.4g} m"
            )
            raise ProgramError(cause, place, "lower the level, or close the walls")
    heights = level - depth * np.arange(RINGS) / (RINGS - 1) * (1 - 1e-3)
    middle = np.array([x, y])

    def outlines(angles: "np.ndarray") -> "list[np.ndarray]":
        """(P, 2) m of each ring, a little into the walls."""
        rings: list[np.ndarray] = []
        for z in heights:
            reach = ring(z, angles)
            rings.append(
                np.where(reach > 0, reach, rings[-1] if rings else reach)
            )  # a hole below is small, or the floor is higher
        grow = INTO_M + INTO * float(np.median(rings[0]))
        ways = np.column_stack([np.cos(angles), np.sin(angles)])
        return [middle + (reach + grow)[:, None] * ways for reach in rings]

    rings = outlines(angles)
    four = [_four(outline, middle, yaw) for outline in rings]
    if four[0] is not None:  # its corners are looked for; where it is no rectangle farther down, in the same directions
        shore = _sides(four[0], around)
        own = rings if all(one is not None for one in four) else outlines(np.arctan2(*(shore - middle).T[::-1]))
        rings = [outline if one is None else _sides(one, around) for one, outline in zip(four, own, strict=True)]
    return Vessel(middle, floor, level, np.array(rings), heights)


def _four(outline: "np.ndarray", middle: "np.ndarray", yaw: float) -> "np.ndarray | None":
    """(4, 2): the corners of the rectangle, turned by the yaw, on which all points of an outline lie; None where there is none."""
    import numpy as np

    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    own = (outline - middle) @ turn
    low, high = own.min(axis=0), own.max(axis=0)
    off = np.minimum(np.abs(own - low), np.abs(own - high)).min(axis=1)
    if off.max() > 5e-3 * float((high - low).max()):
        return None
    return np.array([[low[0], low[1]], [high[0], low[1]], high, [low[0], high[1]]]) @ turn.T + middle


def _sides(corners: Any, around: int) -> "np.ndarray":
    """(4 n, 2): points along the sides of a rectangle, its corners among them."""
    import numpy as np

    each = max(8, around // 4)
    share = np.arange(each)[:, None] / each
    return np.concatenate([a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)])


def _mesh(vessel: Vessel) -> "tuple[np.ndarray, np.ndarray]":
    """The corners (n, 3) and triangles (f, 3) of the water: surface, walls, floor."""
    import numpy as np
    from scipy.spatial import Delaunay, cKDTree

    shore = vessel.rings[0]
    gap = float(np.sqrt(area(shore) / SURFACE_POINTS))
    low, high = shore.min(axis=0), shore.max(axis=0)
    rows = np.arange(low[1] + gap / 2, high[1], gap * 0.866)
    inner = np.concatenate(
        [np.column_stack([np.arange(low[0] + gap / 2 * (1 + i % 2), high[0], gap), np.full_like(np.arange(low[0] + gap / 2 * (1 + i % 2), high[0], gap), row)])
         for i, row in enumerate(rows)]
    )  # fmt: skip
    dense = np.concatenate([shore + t * (np.roll(shore, -1, axis=0) - shore) for t in (0.0, 0.25, 0.5, 0.75)])
    inner = inner[inside(shore, inner) & (cKDTree(dense).query(inner)[0] > 0.55 * gap)]
    flat = np.concatenate([shore, inner])
    faces = Delaunay(flat).simplices
    faces = faces[inside(shore, flat[faces].mean(axis=1))]
    a, b, c = (flat[faces[:, i]] for i in range(3))
    turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    faces = np.where((turned < 0)[:, None], faces[:, ::-1], faces)[np.abs(turned) > 1e-6 * gap**2]
    points = [np.column_stack([flat, np.full(len(flat), vessel.level)])]
    count, round_it = len(flat), len(shore)
    rim, triangles = np.arange(round_it), [faces]
    for ring, z in zip(vessel.rings[1:], vessel.heights[1:], strict=True):
        points.append(np.column_stack([ring, np.full(round_it, z)]))
        lower = count + np.arange(round_it)
        n, m = np.roll(rim, -1), np.roll(lower, -1)
        triangles += [np.column_stack([rim, lower, n]), np.column_stack([n, lower, m])]
        rim, count = lower, count + round_it
    points.append(np.array([[*vessel.middle, vessel.heights[-1]]]))
    triangles.append(np.column_stack([np.roll(rim, -1), rim, np.full(round_it, count)]))
    return np.concatenate(points), np.concatenate(triangles)


def _beads(vessel: Vessel, drops: int) -> "tuple[np.ndarray, np.ndarray]":
    """Corners (12 drops, 3) and triangles (20, 3) of small twenty-sided balls, hidden in the water until they fly."""
    import numpy as np

    g = (1 + 5**0.5) / 2
    ball = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
                     [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]]) / np.hypot(1, g)  # fmt: skip
    faces = np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
                      [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11],
                      [6, 2, 10], [8, 6, 7], [9, 8, 1]])  # fmt: skip
    middle = np.array([*vessel.middle, vessel.level - 0.3 * (vessel.level - vessel.floor)])
    return np.tile(middle + SMALL_M * ball, (drops, 1)), faces
