"""Where to stand so that given points fill the frame: exact for a pinhole camera looking in a given direction."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

import numpy as np

from .views import axes

NEAREST_M = 0.06
LOOMING = 0.6
"""Least distance to the nearest point, in depths of what is framed."""
NARROWEST_DEG = 8.0


@dataclass(frozen=True)
class Pose:
    """A camera's place, its axes as columns (right, up, back), its lens, and its distance to what it frames."""

    eye: np.ndarray
    axes: np.ndarray
    fovy_deg: float
    distance_m: float

    @property
    def target(self) -> np.ndarray:
        """The point looked at."""
        return self.eye - self.axes[:, 2] * self.distance_m

    @property
    def half_height_m(self) -> float:
        """Half the height of what the frame holds at the target's distance."""
        return self.distance_m * tan(radians(self.fovy_deg) / 2.0)


@dataclass(frozen=True)
class Shot:
    """A chosen pose, and which axes of the subjects' movement the camera follows."""

    pose: Pose
    follow: tuple[bool, bool, bool] = (False, False, False)


def project(pose: Pose, points: np.ndarray, aspect: float) -> np.ndarray:
    """Image coordinates (N, 2) of world points: -1..1 across the frame, right and up; and depth (N,), as (N, 3)."""
    local = (points - pose.eye) @ pose.axes
    depth = -local[:, 2]
    half = tan(radians(pose.fovy_deg) / 2.0)
    safe = np.where(depth > 1e-9, depth, np.nan)
    return np.stack([local[:, 0] / (safe * half * aspect), local[:, 1] / (safe * half), depth], axis=1)


def fit(points: np.ndarray, backward: np.ndarray, fovy_deg: float, aspect: float, margin: float) -> Pose:
    """The nearest camera looking along `-backward` that holds all points with `margin` of the frame free on each side.

    Each side plane of the frustum touches a point or has slack, which is shared between opposite sides.
    """
    frame = axes(backward)
    x, y, z = (points @ frame).T
    depth = -z  # along the view, from the origin
    half = tan(radians(fovy_deg) / 2.0) * (1.0 - 2.0 * margin)
    distances, centres = [], []
    for value, slope in ((x, half * aspect), (y, half)):
        high, low = (value - slope * depth).max(), (value + slope * depth).min()
        distances.append((high - low) / (2.0 * slope))
        centres.append(0.5 * (high + low))
    # Stand clear of the nearest point, too, and far enough that near things do not loom.
    spread = float(np.ptp(depth))
    stand = max(*distances, NEAREST_M - float(depth.min()), LOOMING * spread - float(depth.min()))
    # An axis with room to spare shows its points in the middle, as they appear from this distance.
    for axis, value in enumerate((x, y)):
        if distances[axis] < 0.999 * stand:
            for _ in range(12):
                image = (value - centres[axis]) / (stand + depth)
                centres[axis] += 0.5 * float(image.max() + image.min()) * float(stand + depth.mean())
    if stand > max(distances):
        need = [
            max(abs(value - c) / (stand + d) for value, d in zip(v, depth, strict=True))
            for v, c in ((x, centres[0]), (y, centres[1]))
        ]
        wanted = max(need[0] / aspect, need[1]) / (1.0 - 2.0 * margin)
        fovy_deg = min(fovy_deg, max(float(np.degrees(2.0 * np.arctan(wanted))), NARROWEST_DEG))
    eye = frame @ np.array([centres[0], centres[1], stand])
    middle = 0.5 * (depth.min() + depth.max())
    return Pose(eye, frame, fovy_deg, max(stand + float(middle), NEAREST_M))


def look(eye: np.ndarray, target: np.ndarray, fovy_deg: float) -> Pose:
    """A camera at `eye` looking at `target`."""
    way = np.asarray(eye, dtype=float) - np.asarray(target, dtype=float)
    distance = float(np.linalg.norm(way))
    if distance < 1e-9:
        raise ValueError("a camera cannot stand on its own target; move its position or target apart")
    return Pose(np.asarray(eye, dtype=float), axes(way / distance), fovy_deg, distance)


def widen(pose: Pose, points: np.ndarray, aspect: float, margin: float, widest_deg: float = 100.0) -> Pose:
    """The same camera with a lens just wide enough for the points (not beyond `widest_deg`)."""
    image = project(pose, points, aspect)
    image = image[np.isfinite(image[:, 0])]
    if not len(image):
        return pose
    need = float(np.abs(image[:, :2]).max()) / (1.0 - 2.0 * margin)
    fovy = np.degrees(2.0 * np.arctan(tan(radians(pose.fovy_deg) / 2.0) * need))
    return Pose(pose.eye, pose.axes, float(np.clip(fovy, 12.0, widest_deg)), pose.distance_m)
