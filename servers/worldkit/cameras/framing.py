"""From what must be in the picture to where the camera stands.

For a camera looking along -d from centre c + s d, a ball of radius r at p is inside the frame when both
|x| + r / cos(h) <= (s - p.d) tan(h) across and the same for y up: the smallest such s over all balls is the distance.
"""

from typing import TYPE_CHECKING

import numpy as np

from .intent import Intent, intents
from .views import VIEWS, Vec3, View

if TYPE_CHECKING:
    import mujoco

ASPECT = 16 / 9
SAMPLES = 60
"""Recorded moments looked at for framing."""
CLEARANCE_M = 0.08
"""The least height of a camera above the ground."""
DETOURS = [(t, e) for e in (0.0, 10.0, 22.0, 36.0) for t in (0.0, 14.0, -14.0, 30.0, -30.0, 50.0, -50.0)]
"""Turns and lifts (degrees) tried, in this order, when something stands in the way."""


def orientation(place: "np.ndarray | Vec3", target: "np.ndarray | Vec3") -> np.ndarray:
    """Camera quaternion (wxyz) at `place` looking at `target`, upright; straight down keeps +X at the top."""
    import mujoco

    back = np.asarray(place, dtype=float) - np.asarray(target, dtype=float)
    right, up, back = _axes(back / max(np.linalg.norm(back), 1e-9))
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.column_stack([right, up, back]).ravel())
    return quat


def _axes(back: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Right, up and backward unit vectors of a camera that looks along `-back`."""
    ahead = np.array([0.0, 0.0, 1.0]) if abs(back[2]) < 0.999 else np.array([1.0, 0.0, 0.0])
    right = np.cross(ahead, back)
    right /= np.linalg.norm(right)
    return right, np.cross(back, right), back


def frame(
    points: np.ndarray, radii: np.ndarray, direction: Vec3, fovy: float, margin: float
) -> tuple[np.ndarray, np.ndarray]:
    """Position and target (3,) of the nearest camera in `direction` that has every ball in its frame.

    Args:
        points: (N, 3) centres of balls, metres.
        radii: (N,) their radii.
        direction: unit vector from the subjects to the camera.
        fovy: vertical field of view, degrees.
        margin: size of the frame over the size of what must be in it.
    """
    right, up, back = _axes(np.asarray(direction, dtype=float))
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    half = {"y": np.radians(fovy) / 2, "x": np.arctan(np.tan(np.radians(fovy) / 2) * ASPECT)}
    distance = 0.0
    for last in (False, False, False, True):
        offset = points - centre
        across, above, towards = offset @ right, offset @ up, offset @ back
        distance = max(
            float(np.max(towards + (np.abs(extent) + radii / np.cos(angle)) * margin / np.tan(angle)))
            for extent, angle in ((across, half["x"]), (above, half["y"]))
        )
        if last:
            break
        # Shift the centre so that what is seen is balanced left to right and top to bottom.
        depth = np.maximum(distance - towards, 1e-6)
        for axis, values in ((right, across), (up, above)):
            low, high = ((values - radii) / depth).min(), ((values + radii) / depth).max()
            centre = centre + axis * (low + high) / 2 * distance
    return centre + back * max(distance, 0.02), centre


def first_pose(spec: "mujoco.MjSpec", intent: Intent) -> tuple[np.ndarray, np.ndarray]:
    """A camera's pose before anything is compiled: from the bodies' poses and their geoms' sizes."""
    from ..bodies import world_pose

    bodies = [b for b in spec.bodies if b.name != "world" and (b.name in intent.subjects or not intent.subjects)]
    points = np.array([world_pose(body)[0] for body in bodies]) if bodies else np.zeros((1, 3))
    sizes = [max((float(np.max(geom.size)) for geom in body.geoms), default=0.1) for body in bodies] or [1.0]
    radii = np.maximum(np.array(sizes), 0.05)
    if intent.position is not None:
        return np.asarray(intent.position), np.asarray(intent.target) if intent.target else points.mean(axis=0)
    view = VIEWS[intent.view or "perspective"]
    return frame(points, radii, view.direction(), intent.fovy, view.margin)


def aim(model: "mujoco.MjModel", positions: np.ndarray | None = None) -> None:
    """Pose every annotated camera so that the space its subjects cross fills the frame.

    Args:
        model: edited in place (`cam_pos`, `cam_quat`, `cam_fovy`).
        positions: (T, B, 3) recorded world positions of all bodies but the world, in model order; None: at rest.
    """
    import mujoco

    data = mujoco.MjData(model)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, "start")
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_kinematics(model, data)
    path = data.xpos[None, 1:].copy() if positions is None or not len(positions) else np.asarray(positions)
    path = path[np.unique(np.linspace(0, len(path) - 1, SAMPLES).astype(int))]
    radius = _radii(model, data)
    for camera, intent in intents(model).items():
        subjects = _subjects(model, intent)
        seen = path[:1] if intent.follow else path
        points, radii = _balls(model, data, seen, subjects, radius)
        if not len(points):
            continue
        if intent.position is not None:
            place = np.asarray(intent.position, dtype=float)
            target = np.asarray(intent.target, dtype=float) if intent.target else points.mean(axis=0)
        else:
            view = VIEWS[intent.view or "perspective"]
            place, target = _unobstructed(model, data, view, intent, points, radii, subjects)
        model.cam_pos[camera] = place
        model.cam_quat[camera] = orientation(place, target)
        model.cam_fovy[camera] = intent.fovy
    _tell_space(model, path, radius)


def _balls(
    model: "mujoco.MjModel", data: "mujoco.MjData", path: np.ndarray, subjects: np.ndarray, radius: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Centres (N, 3) and radii (N,) of what must be in the frame.

    What can turn is a ball about its origin wherever it was; scenery, which cannot, is the corners of its geoms.
    """
    moving = model.body_treeid[subjects] >= 0
    movers = subjects[moving]
    points = [path[:, movers - 1].reshape(-1, 3)]
    radii = [np.tile(radius[movers], len(path))]
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    for geom in np.flatnonzero(np.isin(model.geom_bodyid, subjects[~moving])):
        corners = model.geom_aabb[geom, :3] + signs * model.geom_aabb[geom, 3:]
        points.append(data.geom_xpos[geom] + corners @ data.geom_xmat[geom].reshape(3, 3).T)
        radii.append(np.zeros(8))
    scenery = np.concatenate([np.zeros((0, 3)), *points[1:]])
    if len(scenery):  # what stands on the scenery belongs to its picture
        low, high = scenery.min(axis=0), scenery.max(axis=0)
        others = np.setdiff1d(np.flatnonzero(model.body_treeid >= 0), movers)
        inside = ((data.xpos[others, :2] > low[:2]) & (data.xpos[others, :2] < high[:2])).all(axis=1)
        points.append(data.xpos[others[inside]])
        radii.append(radius[others[inside]])
    all_points, all_radii = np.concatenate(points), np.concatenate(radii)
    finite = np.isfinite(all_points).all(axis=1)
    return all_points[finite], all_radii[finite]


def _tell_space(model: "mujoco.MjModel", path: np.ndarray, radius: np.ndarray) -> None:
    """Leave the corners of the space that everything movable crosses where the renderer looks for them."""
    import mujoco

    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, "worldkit.space")
    if number < 0:
        return
    bodies = _subjects(model, Intent())
    points, margin = path[:, bodies - 1], radius[bodies][None, :, None]
    finite = np.isfinite(points)
    low = np.where(finite, points - margin, np.inf).min(axis=(0, 1))
    high = np.where(finite, points + margin, -np.inf).max(axis=(0, 1))
    if np.isfinite(low).all() and np.isfinite(high).all():
        start = model.numeric_adr[number]
        model.numeric_data[start : start + 6] = np.concatenate([low, high])


def _unobstructed(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    view: View,
    intent: Intent,
    points: np.ndarray,
    radii: np.ndarray,
    subjects: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """The view itself when nothing hides its subjects, else the first detour that shows the most of them."""
    best, fewest = None, np.inf
    for turn, lift in DETOURS:
        place, target = frame(points, radii, view.direction(turn, lift), intent.fovy, view.margin)
        if place[2] < CLEARANCE_M:
            place[2] = CLEARANCE_M
        hidden = _hidden(model, data, place, points, radii, subjects)
        if hidden < fewest - 0.05:
            best, fewest = (place, target), hidden
        if fewest == 0:
            break
    assert best is not None
    return best


def _hidden(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    place: np.ndarray,
    points: np.ndarray,
    radii: np.ndarray,
    subjects: np.ndarray,
) -> float:
    """Share (0 to 1) of the subjects' sampled tops that something at rest stands in front of."""
    import mujoco

    solid = np.flatnonzero(radii > 0)  # corners of scenery may well be hidden, by its own legs or by what stands there
    if not len(solid):
        return 0.0
    chosen = solid[np.unique(np.linspace(0, len(solid) - 1, 24).astype(int))]
    number = np.zeros(1, np.int32)
    groups = np.array([1, 1, 1, 0, 0, 0], np.uint8)
    blocked = 0
    for index in chosen:
        top = points[index] + np.array([0.0, 0.0, 0.6 * radii[index]])
        ray = top - place
        length = np.linalg.norm(ray)
        if length < 1e-6:
            continue
        reached = mujoco.mj_ray(model, data, place, ray / length, groups, 1, -1, number, None)
        own = number[0] >= 0 and model.geom_bodyid[number[0]] in subjects
        blocked += 0 <= reached < length - 1.2 * radii[index] and not own
    return blocked / len(chosen)


def _subjects(model: "mujoco.MjModel", intent: Intent) -> np.ndarray:
    """Body numbers of a camera's subjects; everything that can move when none is named, all when nothing can."""
    import mujoco

    named = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) for name in intent.subjects]
    chosen = [number for number in named if number > 0]
    if not chosen:
        chosen = [b for b in range(1, model.nbody) if model.body_treeid[b] >= 0] or list(range(1, model.nbody))
    return np.asarray(chosen or [0])


def _radii(model: "mujoco.MjModel", data: "mujoco.MjData") -> np.ndarray:
    """(nbody,) radius about each body's origin that holds all its geoms, metres."""
    radius = np.full(model.nbody, 0.01)
    for geom in range(model.ngeom):
        body = model.geom_bodyid[geom]
        if body == 0:
            continue
        centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        far = np.linalg.norm(model.geom_pos[geom]) + np.linalg.norm(centre) + np.linalg.norm(half)
        if np.linalg.norm(half) > 0 and model.geom_type[geom] == 2:  # a sphere is no bigger than its radius
            far = np.linalg.norm(model.geom_pos[geom]) + model.geom_size[geom, 0]
        radius[body] = max(radius[body], far)
    return radius


def track(model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
    """Move every following camera with the centre of its subjects (call it after the kinematics of each frame)."""
    import mujoco

    for camera, intent in intents(model).items():
        if not intent.follow:
            continue
        subjects = _subjects(model, intent)
        key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, "start")
        rest = mujoco.MjData(model)
        if key >= 0:
            mujoco.mj_resetDataKeyframe(model, rest, key)
        mujoco.mj_kinematics(model, rest)
        data.cam_xpos[camera] = model.cam_pos[camera] + (data.xpos[subjects] - rest.xpos[subjects]).mean(axis=0)
