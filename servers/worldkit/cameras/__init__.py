"""Cameras that find their own place: `add` states what to show, `aim` frames it once the movement is known.

A camera is an ordinary fixed camera of the model. Its intent is kept in the model as the text ``worldkit.camera.<name>``,
so that a compiled or reloaded model can be aimed again.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from ..turning import matrices, quaternion
from .standpoint import Shot, look
from .views import VIEWS

if TYPE_CHECKING:
    import mujoco

__all__ = ["VIEWS", "add", "aim", "track"]

PREFIX = "worldkit.camera."
ASPECT = 16.0 / 9.0
_SLOTS = 10
"""Numbers kept per camera: follow x, y, z (0 or 1); eye minus subjects' middle where it follows, x, y, z; eye, x, y, z; spare."""


def add(
    spec: mujoco.MjSpec,
    name: str,
    *,
    view: str | None = None,
    subjects: tuple[str, ...] | list[str] = (),
    position: tuple[float, float, float] | None = None,
    target: tuple[float, float, float] | None = None,
    fovy: float = 40.0,
    follow: bool = False,
) -> mujoco.MjsCamera:
    """Add a camera to the world body, posed for the scene as it stands; add cameras after the bodies they show.

    `view` names a template of `VIEWS` ("perspective" unless a position is given); `subjects` are bodies or flexes, none meaning
    everything that moves. With `position` (m) the camera stays there and looks at `target` (m) or at its subjects.
    `fovy` is the vertical field of view, degrees. `follow` keeps the subjects in place in the frame as they move.

    Raises ValueError for an unknown view, an unknown subject, a camera name in use, or a target without a position.
    """
    if view is not None and view not in VIEWS:
        raise ValueError(f"camera {name!r}: there is no view {view!r}; known: {', '.join(sorted(VIEWS))}")
    if target is not None and position is None:
        raise ValueError(f"camera {name!r} has a target but no position; give both, or a view and subjects")
    if not 1.0 < fovy < 170.0:
        raise ValueError(f"camera {name!r}: fovy must lie between 1 and 170 degrees, got {fovy}")
    if any(camera.name == name for camera in spec.cameras):
        raise ValueError(f"a camera called {name!r} exists already; give this one another name")
    intent = {
        "view": view or "perspective",
        "subjects": list(subjects),
        "position": None if position is None else [float(v) for v in position],
        "target": None if target is None else [float(v) for v in target],
        "fovy": float(fovy),
        "follow": bool(follow),
    }
    model = _compiled(spec)
    pose = _shot(model, intent, None, ASPECT).pose
    camera = spec.worldbody.add_camera(name=name, pos=pose.eye, quat=quaternion(pose.axes), fovy=pose.fovy_deg)
    spec.add_text(name=PREFIX + name, data=json.dumps(intent))
    spec.add_numeric(name=PREFIX + name, size=_SLOTS, data=[0.0] * _SLOTS)
    return camera


_last: dict[str, Any] = {}


def _compiled(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """A compiled copy; several cameras in a row share one."""
    shape = (len(spec.bodies), len(spec.geoms), len(spec.joints), len(spec.meshes))
    if _last.get("spec") is not spec or _last.get("shape") != shape:
        _last.update(spec=spec, shape=shape, model=spec.copy().compile())
    return _last["model"]


def _rest(model: mujoco.MjModel) -> mujoco.MjData:
    """The model at its start: keyframe "start" if it has one."""
    import mujoco

    data = mujoco.MjData(model)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, "start")
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return data


def _shot(
    model: mujoco.MjModel,
    intent: dict[str, Any],
    positions: np.ndarray | None,
    aspect: float,
    orientations: np.ndarray | None = None,
) -> Shot:
    from .aiming import choose
    from .subjects import crossing, drawn, resolve, with_drawn

    fovy = float(intent["fovy"])
    if intent["position"] is not None and intent["target"] is not None:
        return Shot(look(np.array(intent["position"]), np.array(intent["target"]), fovy))
    data = _rest(model)
    subjects = tuple(intent["subjects"])
    bodies = resolve(model, subjects)
    way = crossing(model, data, bodies, positions, orientations) if bodies else None
    way = with_drawn(way, drawn(model, subjects))
    if way is None:
        eye = intent["position"] or (2.4, -1.9, 1.4)
        return Shot(look(np.array(eye, dtype=float), np.array([0.0, 0.0, 0.3]), fovy))
    if intent["position"] is not None:
        middle = 0.5 * (way.points.min(axis=0) + way.points.max(axis=0))
        return Shot(look(np.array(intent["position"]), middle, fovy))
    return choose(model, data, way, intent["view"], fovy, bool(intent["follow"]), aspect)


def _annotated(model: mujoco.MjModel) -> list[tuple[int, str, dict[str, Any]]]:
    """Cameras of the model that carry an intent: number, name, intent."""
    import mujoco

    from ..model_text import read

    found = []
    for camera in range(model.ncam):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_CAMERA, camera)
        intent = read(model, PREFIX + name) if name else None
        if intent is not None and model.cam_bodyid[camera] == 0:
            found.append((camera, name, intent))
    return found


def _slot(model: mujoco.MjModel, name: str) -> np.ndarray | None:
    """The numbers kept for a camera, writable."""
    from ..model_text import numbers

    slot = numbers(model, PREFIX + name)
    return slot if slot is not None and len(slot) == _SLOTS else None


def aim(
    model: mujoco.MjModel,
    positions: np.ndarray | None = None,
    *,
    orientations: np.ndarray | None = None,
    aspect: float = ASPECT,
) -> None:
    """Pose every annotated camera so that the space its subjects cross fills the frame with a margin.

    `positions` (T, B, 3), m, are the origins of all bodies but the world over a recording, in the model's order; None: as
    they stand at the start. With `orientations` (T, B, 4), quaternions with w first, bodies that swing or tumble are framed
    more closely. `aspect` is the picture's width over its height. Edits `cam_pos`, `cam_quat` and `cam_fovy` of the model.

    A camera stays above the ground, turns away from what hides its subjects, shows what they stand on where that costs
    little, and follows subjects that would otherwise be too small to read (call `track` for every frame). Raises ValueError
    if a subject is no body.
    """
    from ..model_text import numbers
    from .subjects import crossing, resolve

    if positions is not None:
        positions = np.asarray(positions, dtype=float)
        if positions.ndim != 3 or positions.shape[2] != 3 or positions.shape[1] not in (model.nbody - 1, model.nbody):
            raise ValueError(
                f"positions must be (T, {model.nbody - 1}, 3): the origins of all bodies but the world; got {positions.shape}"
            )
    space = numbers(model, "worldkit.space")
    if space is not None and len(space) == 6:
        bodies = resolve(model, ())
        if bodies:
            points = crossing(model, _rest(model), bodies, positions, orientations).points
            space[:3], space[3:] = points.min(axis=0), points.max(axis=0)
    for camera, name, intent in _annotated(model):
        shot = _shot(model, intent, positions, aspect, orientations)
        pose = shot.pose
        model.cam_pos[camera] = pose.eye
        model.cam_quat[camera] = quaternion(pose.axes)
        model.cam_fovy[camera] = pose.fovy_deg
        slot = _slot(model, name)
        if slot is not None:
            slot[:] = 0.0
            if any(shot.follow):
                members = list(resolve(model, tuple(intent["subjects"])))
                first = model.nbody - 1 if positions is None else positions.shape[1]
                start = (
                    _rest(model).xpos
                    if positions is None
                    else np.concatenate([np.zeros((model.nbody - first, 3)), positions[0]])
                )
                slot[0:3] = shot.follow
                slot[3:6] = pose.eye - start[members].mean(axis=0)
                slot[6:9] = pose.eye


def track(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Move every following camera along with its subjects in `data` (kinematics up to date); others stay.

    Moves both the model's cameras and their poses in `data`, so that a picture can be drawn at once.
    """
    from .subjects import resolve

    for camera, name, intent in _annotated(model):
        slot = _slot(model, name)
        if slot is None or not slot[:3].any():
            continue
        bodies = list(resolve(model, tuple(intent["subjects"])))
        middle = np.array(data.xpos[bodies]).mean(axis=0)
        follow = slot[:3] > 0.5
        eye = np.where(follow, middle + slot[3:6], slot[6:9])
        model.cam_pos[camera] = eye
        data.cam_xpos[camera] = eye
        # The camera stands in the world's frame; data may still hold an earlier orientation.
        data.cam_xmat[camera] = matrices(model.cam_quat[camera]).ravel()


def standing(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> dict[str, Any]:
    """How a camera stands in `data`, in plain numbers: `eye` (3,) m, `axes` (3, 3) as columns, `fovy_deg`; and of one that
    follows what `subjects`, `along` which axes, `away` (3,) m from the middle of them."""
    from .subjects import resolve

    camera = model.camera(name).id
    found: dict[str, Any] = {
        "eye": data.cam_xpos[camera].tolist(),
        "axes": data.cam_xmat[camera].reshape(3, 3).tolist(),
        "fovy_deg": float(model.cam_fovy[camera]),
    }
    slot = _slot(model, name)
    intent = next((intent for index, _, intent in _annotated(model) if index == camera), None)
    if slot is not None and slot[:3].any() and intent is not None:
        subjects = [model.body(int(body)).name for body in resolve(model, tuple(intent["subjects"]))]
        found["follow"] = {"subjects": subjects, "along": (slot[:3] > 0.5).tolist(), "away": slot[3:6].tolist()}
    return found
