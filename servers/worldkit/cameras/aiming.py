"""Choosing a camera's pose: its view's direction, nudged if something hides the subjects, at the distance that frames them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..model_text import read
from .sight import ground_height, hidden_share, samples, supports
from .standpoint import Pose, Shot, fit, look, widen
from .subjects import Crossing, corners
from .views import VIEWS, View

if TYPE_CHECKING:
    import mujoco

LEGIBLE = 0.032
"""A subject of less than this share of the frame's height cannot be read; the camera then follows instead."""
CLEAR = 0.045
"""A subject should keep this share of the frame's height when all of its support is shown."""
SUPPORT_STRETCH = 1.9
"""How much farther the camera may stand to show all of a support."""
HIDDEN_LIMIT = 0.15
OUTDOOR_LOWER_DEG = 12.0
FOLLOW_ROOM = 5.0
"""Half the width shown around what a camera follows, in its radii."""


def _nudges(view: View) -> Iterator[tuple[float, float]]:
    """Turns of azimuth and elevation, the smallest first."""
    if view.elevation_deg > 80:
        yield from ((0.0, 0.0), (0.0, -8.0), (0.0, -16.0), (0.0, -28.0), (180.0, -16.0), (180.0, -28.0))
        return
    turns = [
        (a, e) for e in (0.0, 9.0, 18.0, 30.0, 44.0) for a in (0.0, 14.0, -14.0, 28.0, -28.0, 44.0, -44.0, 65.0, -65.0)
    ]
    yield from sorted(turns, key=lambda turn: abs(turn[0]) + 1.2 * turn[1])


def broadside_deg(points: np.ndarray, azimuth_deg: float) -> float:
    """How far to turn from `azimuth_deg` toward the side of points that lie along a line, degrees (within 28)."""
    flat = points[:, :2] - points[:, :2].mean(axis=0)
    values, vectors = np.linalg.eigh(flat.T @ flat / max(len(flat), 1))
    if values[1] < 1e-12 or np.sqrt(max(values[0], 0.0) / values[1]) > 0.75:
        return 0.0
    line = float(np.degrees(np.arctan2(vectors[1, 1], vectors[0, 1])))
    away = (line + 90.0 - azimuth_deg + 90.0) % 180.0 - 90.0
    return float(np.clip(0.6 * away, -28.0, 28.0))


def _middle(values: np.ndarray) -> float:
    """The median of (N,) numbers. Numpy's own brings its masked arrays in, a tenth of what it costs to start a process."""
    ordered = np.sort(values)
    return float((ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2)


def _context(
    model: mujoco.MjModel, data: mujoco.MjData, crossing: Crossing, view: View
) -> tuple[np.ndarray, np.ndarray]:
    """Points that must be in the frame, and points that should be if they cost little."""
    touch, geoms = supports(model, data, crossing)
    must = [crossing.points]
    if len(touch):
        # A little of the surface around the way, so that the shadow and the contact are seen.
        near = touch[:, 2] > crossing.points[:, 2].min() - 2.0 * max(float(crossing.radii.max()), 1e-3) - np.ptp(
            crossing.points[:, 2]
        )
        around = 0.8 * _middle(crossing.radii)
        for dx, dy in ((around, 0), (-around, 0), (0, around), (0, -around)):
            must.append(touch[near] + np.array([dx, dy, 0.0]))
    want = corners(model, data, np.array(sorted(geoms), dtype=int)) if geoms and view.support else np.zeros((0, 3))
    if view.whole_scene:
        fixed = np.flatnonzero(
            (model.body_weldid[model.geom_bodyid] == 0) & (model.geom_rbound > 0) & (model.geom_group < 3)
        )
        must.append(corners(model, data, fixed))
    return np.concatenate(must), want


def _above(pose: Pose, floor_z: float | None) -> Pose:
    """The pose, raised above the ground where it is too low."""
    if floor_z is None:
        return pose
    least = floor_z + max(0.03, 0.035 * pose.distance_m)
    if pose.eye[2] >= least:
        return pose
    target = pose.target
    eye = pose.eye.copy()
    eye[2] = least
    return look(eye, target, pose.fovy_deg)


def _at_wall(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    view: View,
    points: np.ndarray,
    fovy_deg: float,
    aspect: float,
) -> Pose:
    """Just inside the boundary of the fixed things on the view's side."""
    fixed = np.flatnonzero(
        (model.body_weldid[model.geom_bodyid] == 0) & (model.geom_rbound > 0) & (model.geom_group < 3)
    )
    bounds = corners(model, data, fixed)
    everything = np.concatenate([bounds, points]) if len(bounds) else points
    low, high = everything.min(axis=0), everything.max(axis=0)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    toward = view.backward()
    axis = int(np.argmax(np.abs(toward[:2])))
    span = max(float(high[axis] - low[axis]), 1e-3)
    inset = min(0.15, 0.06 * span)
    eye = middle.copy()
    eye[axis] = high[axis] - inset if toward[axis] > 0 else low[axis] + inset
    # Stand off at least as far as the subjects are large, even if that is outside a tight boundary.
    clear = 0.9 * float(np.linalg.norm(np.ptp(points, axis=0)))
    if abs(eye[axis] - middle[axis]) < clear:
        eye[axis] = middle[axis] + np.sign(toward[axis]) * clear
    eye[2] = middle[2] + np.tan(np.radians(view.elevation_deg)) * abs(eye[axis] - middle[axis])
    if np.ptp(bounds[:, 2] if len(bounds) else points[:, 2]) > 1.5:
        eye[2] = min(eye[2], high[2] - inset)
    return widen(look(eye, middle, fovy_deg), points, aspect, view.margin)


def _settle(pose: Pose, points: np.ndarray, view: View, fovy_deg: float, aspect: float, floor_z: float | None) -> Pose:
    """Raise the camera above the ground and frame anew from there."""
    for _ in range(4):
        raised = _above(pose, floor_z)
        if raised is pose:
            return pose
        pose = fit(points, raised.axes[:, 2], fovy_deg, aspect, view.margin)
    return _above(pose, floor_z)


def choose(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    crossing: Crossing,
    view_name: str,
    fovy_deg: float,
    follow: bool,
    aspect: float,
) -> Shot:
    """The shot of the subjects over their whole way."""
    view = VIEWS[view_name]
    floor_z = ground_height(model, data)
    points, want = _context(model, data, crossing, view)
    marks = samples(crossing)
    follows = (False, False, False)
    widest_m = _middle(crossing.radii) / LEGIBLE
    if view.wall:
        return Shot(_settle_wall(_at_wall(model, data, view, points, fovy_deg, aspect), points, view, aspect, floor_z))
    whole = fit(points, view.backward(), fovy_deg, aspect, view.margin)
    span = np.ptp(crossing.centres, axis=0)
    if follow or (
        whole.half_height_m > widest_m and not view.whole_scene and span.max() > 6.0 * float(crossing.radii.max())
    ):
        points, follows = _cluster(crossing, span, follow, widest_m)
        want = np.zeros((0, 3))
        marks = crossing.centres[:1]
    turn = broadside_deg(points, view.azimuth_deg) if view.broadside else 0.0
    # Outdoors the horizon belongs into the picture.
    lower = (
        -OUTDOOR_LOWER_DEG
        if view.broadside and (read(model, "worldkit.setting") or {}).get("setting") == "outdoor"
        else 0.0
    )
    best: tuple[float, Pose] | None = None
    for azimuth, elevation in _nudges(view):
        backward = view.backward(turn + azimuth, lower + elevation)
        pose = fit(points, backward, fovy_deg, aspect, view.margin)
        if len(want):
            wider = fit(np.concatenate([points, want]), backward, fovy_deg, aspect, 0.5 * view.margin)
            if (
                wider.half_height_m < SUPPORT_STRETCH * pose.half_height_m
                and wider.half_height_m < widest_m * LEGIBLE / CLEAR
            ):
                pose = wider
        pose = _settle(pose, points, view, fovy_deg, aspect, floor_z)
        hidden = hidden_share(model, data, pose.eye, marks, crossing.bodies)
        cost = 3.0 * hidden + 0.006 * abs(azimuth) + 0.009 * abs(elevation)
        if best is None or cost < best[0]:
            best = (cost, pose)
        if hidden <= HIDDEN_LIMIT or best[0] < 0.006 * abs(azimuth) + 0.009 * abs(elevation):
            break
    assert best is not None
    return Shot(best[1], follows)


def _settle_wall(pose: Pose, points: np.ndarray, view: View, aspect: float, floor_z: float | None) -> Pose:
    raised = _above(pose, floor_z)
    return pose if raised is pose else widen(raised, points, aspect, view.margin)


def _cluster(
    crossing: Crossing, span: np.ndarray, always: bool, widest_m: float
) -> tuple[np.ndarray, tuple[bool, bool, bool]]:
    """Points around the first moment that hold the subjects whenever the camera moves along with their middle."""
    # Axes along which the subjects hardly leave a legible frame stay still: a bouncing ball need not shake the picture.
    room = 1.1 * widest_m
    moves = [bool(length > (0.02 if always else room)) for length in span]
    if always and span[2] < 0.6 * room:
        moves[2] = False
    if not any(moves):
        moves[int(np.argmax(span))] = True
    follows = (moves[0], moves[1], moves[2])
    mask = np.array(moves, dtype=float)
    drift = (crossing.centres - crossing.centres[0]) * mask
    local = crossing.places - drift[:, None]
    reach = crossing.radii[None, :, None, None]
    ends = np.concatenate([np.eye(3), -np.eye(3)])[None, None]
    around = (local[:, :, None] + reach * ends).reshape(-1, 3)
    least = FOLLOW_ROOM * float(crossing.radii.max())
    middle = 0.5 * (around.min(axis=0) + around.max(axis=0))
    return np.concatenate([around, middle + least * ends.reshape(-1, 3) * np.array([1.0, 1.0, 0.7])]), follows
