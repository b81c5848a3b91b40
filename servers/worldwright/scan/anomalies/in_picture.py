"""Where a viewer can see a finding: its bodies' boxes, frame by frame, through the planned cameras as they stood.

A body is seen where its projected box, cut to the picture, is `PIXELS` long; and where the finding tells how large the
fault is, in metres, the fault too has so many pixels at the body's distance. What hides behind something counts as seen.
Source: pinhole projection (R. Hartley, A. Zisserman, Multiple View Geometry, chapter 6).
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from worldengine.recording.replay import frame_rows
from worldkit.turning import matrices

from ...model.finding import Anomaly
from ...model.plan import belonging
from ...model.plan.committed import Plan
from ...model.plan.in_view import spoken_of
from ...model.plan.scene_objects import Vec3
from ...model.recording.stills import NEAR_M, Lens
from ...model.recording.trajectory import Trajectory

Array = np.ndarray
PIXELS, FRAMES = 2.0, 2
WATCHED_FPS = 24
"""Pictures are looked at so often at least: a film of fewer per second hides nothing by that."""
LOOKED_AT = 60
_SIGNS = np.array([(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], dtype=float)


class Sight(NamedTuple):
    """A picture that shows a finding."""

    camera: str
    frame: int
    """Of the camera's film, counted from 0."""
    time_s: float
    pixels: float
    """Length of what is seen; nan where no camera's place is known."""

    def __str__(self) -> str:
        if np.isnan(self.pixels):
            return "where the planned cameras stand is not recorded, so it may be seen"
        return f"it measures {self.pixels:.0f} pixels in camera {self.camera}, frame {self.frame} ({self.time_s:.2f} s)"


def seen(anomaly: Anomaly, bodies: tuple[int, ...], trajectory: Trajectory, plan: Plan) -> Sight | None:
    """The frame that shows a finding about these bodies largest; None where it is not seen for two frames.

    Of several bodies all are in that frame. Without the place of a planned camera everything counts as seen.
    """
    lenses = trajectory.cameras or {}
    planned = [camera.name for camera in plan.cameras()]
    if not planned or not bodies or any(name not in lenses for name in planned):
        return Sight("", 0, anomaly.window_s[0], np.nan)
    fps = max(plan.recording_mode.fps, WATCHED_FPS)
    every = frame_rows(trajectory.t, fps)
    slack = 0.5 * trajectory.interval_s
    start, end = anomaly.window_s
    shown_until = max(end, start + FRAMES / fps)  # what it did to the world outlasts an instant
    frames = np.flatnonzero((trajectory.t[every] >= start - slack) & (trajectory.t[every] <= shown_until + slack))
    frames = frames if len(frames) >= FRAMES else np.arange(len(every))[-FRAMES:]  # it ends with the recording
    if len(frames) < FRAMES:
        return None
    metres = {"m": anomaly.measured, "m/s": anomaly.measured * (shown_until - start)}.get(
        anomaly.unit, anomaly.extent_m
    )
    best: Sight | None = None
    for name in planned:
        lens = replace(lenses[name], size=plan.recording_mode.size)
        each = [_pixels(trajectory, trajectory.members(body), every[frames], lens, metres) for body in bodies]
        pixels = np.min(each, axis=0)
        at = int(np.argmax(pixels))
        if (pixels >= PIXELS).sum() >= FRAMES and (best is None or pixels[at] > best.pixels):
            best = Sight(
                name,
                int(frames[at] * plan.recording_mode.fps / fps),
                float(trajectory.t[every[frames[at]]]),
                float(pixels[at]),
            )
    return best


class Largest(NamedTuple):
    """Where a thing that the plan speaks of is seen largest."""

    name: str
    pixels: float
    """Length of the longer side of its box in the picture."""
    camera: str
    time_s: float
    eye: Vec3
    """Where the camera stands then, m."""
    place: Vec3
    """Where the middle of the thing is then, m."""
    follows: bool
    """Whether the camera moves with its subjects."""


def largest(trajectory: Trajectory, plan: Plan) -> Iterator[Largest]:
    """Each thing that the plan speaks of, where it is seen largest in two frames of a planned camera; at most some 60 are looked at."""
    rows = frame_rows(trajectory.t, plan.recording_mode.fps)
    rows = rows[:: max(1, len(rows) // LOOKED_AT)]
    found = {row.name: lens for row in plan.cameras() if (lens := (trajectory.cameras or {}).get(row.name))}
    lenses = {name: replace(lens, size=plan.recording_mode.size) for name, lens in found.items()}
    if not lenses or len(rows) < FRAMES:
        return
    owners = _owners(trajectory, plan)
    for name in (n for n in spoken_of(plan) if n in trajectory.names):
        parts = tuple({*trajectory.members(trajectory.names.index(name)), *np.flatnonzero(owners == name).tolist()})
        each = {camera: _pixels(trajectory, parts, rows, lens, None) for camera, lens in lenses.items()}
        camera = max(each, key=lambda camera: float(np.sort(each[camera])[-FRAMES]))
        at = int(np.argsort(each[camera])[-FRAMES])
        if each[camera][at] > 0:
            eye = _eyes(trajectory, lenses[camera], rows[[at]])[0].tolist()
            box = _corners(trajectory, parts, rows[[at]])[0]
            place, time_s = ((box.min(axis=0) + box.max(axis=0)) / 2).tolist(), float(trajectory.t[rows[at]])
            follows = bool(lenses[camera].follows)
            yield Largest(name, float(each[camera][at]), camera, time_s, tuple(eye), tuple(place), follows)


def _owners(trajectory: Trajectory, plan: Plan) -> Array:
    """(B,) the object of the plan that each body belongs to: all that an imported model brings along is that model's."""
    names, above = trajectory.names, trajectory.mechanics.parent
    parents = {} if above is None else {n: names[p] if p >= 0 else "world" for n, p in zip(names, above, strict=True)}
    objects = frozenset(plan.object_names())
    return np.array([belonging.owner(name, parents, objects) for name in names])


def _eyes(trajectory: Trajectory, lens: Lens, rows: Array) -> Array:
    """(F, 3) m: where a camera stands at these rows."""
    follows = [trajectory.names.index(n) for n in lens.follows if n in trajectory.names]
    eye = lens.eye_at(trajectory.pos[np.ix_(rows, follows)].mean(axis=1)) if follows else lens.eye
    return np.broadcast_to(eye, (len(rows), 3))


def _pixels(trajectory: Trajectory, parts: tuple[int, ...], rows: Array, lens: Lens, metres: float | None) -> Array:
    """(F,) length of some bodies together in the picture at these rows, or of a fault of so many metres on them, the smaller."""
    corners = _corners(trajectory, parts, rows)
    stands = _eyes(trajectory, lens, rows)
    eyes = np.broadcast_to(stands[:, None], corners.shape)
    depth = -((corners - eyes) @ lens.axes)[..., 2]
    flat = lens.pixels(corners.reshape(-1, 3), eyes.reshape(-1, 3)).reshape(*corners.shape[:2], 2)
    size = np.array(lens.size, dtype=float)
    behind = depth <= NEAR_M
    around = behind.any(axis=1)  # a box through which the camera's plane goes may fill the picture
    low, high = (np.where(behind[..., None], worst, flat) for worst in (np.inf, -np.inf))
    low, high = np.clip(low.min(axis=1), 0, size), np.clip(high.max(axis=1), 0, size)
    sides = np.where(around[:, None], size, np.maximum(high - low, 0.0))
    found = np.where((sides > 0).all(axis=1) & ~behind.all(axis=1), sides.max(axis=1), 0.0)
    away = np.abs(depth).min(axis=1)
    for plane in _planes(trajectory, parts):  # it may fill any picture
        found, away = np.full(len(rows), size.max()), np.minimum(away, _from_plane(trajectory, plane, rows, stands))
    if metres is None:
        return np.asarray(found)
    scale = lens.size[1] / 2 / np.tan(np.radians(lens.fovy_deg) / 2)
    return np.asarray(np.minimum(found, metres * scale / np.maximum(away, NEAR_M)))


def _planes(trajectory: Trajectory, parts: tuple[int, ...]) -> Array:
    """The geoms without an end of some bodies."""
    half, of = trajectory.mechanics.geom_half_extents, trajectory.mechanics.geom_body
    if half is None or of is None:
        return np.zeros(0, dtype=int)
    return np.flatnonzero(np.isinf(half).any(axis=1) & np.isin(of, parts))


def _from_plane(trajectory: Trajectory, geom: int, rows: Array, eyes: Array) -> Array:
    """(F,) m: how far eyes (F, 3) are from a plane; of one that nobody says how it lies, from its body."""
    facts = trajectory.mechanics
    assert facts.geom_body is not None
    part = int(facts.geom_body[geom])
    own = np.einsum("fi,fij->fj", eyes - trajectory.pos[rows, part], matrices(trajectory.quat[rows, part]))
    if facts.geom_pos is None or facts.geom_quat is None:
        return np.asarray(np.linalg.norm(own, axis=1))
    return np.asarray(np.abs((own - facts.geom_pos[geom]) @ matrices(facts.geom_quat[geom])[:, 2]))


def _corners(trajectory: Trajectory, parts: tuple[int, ...], rows: Array) -> Array:
    """(F, 8 P, 3) m: the boxes around P bodies; a ball's box where a shape is not known."""
    facts, found = trajectory.mechanics, []
    for part in parts:
        half = None if facts.half_extents is None else facts.half_extents[part]
        known = half is not None and facts.center is not None and bool(np.isfinite(half).all())
        if known:
            assert facts.center is not None
            local = facts.center[part] + _SIGNS * half
        else:
            local = _SIGNS * trajectory.size_m[part]
        found.append(
            trajectory.pos[rows, part][:, None] + local @ np.swapaxes(matrices(trajectory.quat[rows, part]), 1, 2)
        )
    return np.concatenate(found, axis=1)
