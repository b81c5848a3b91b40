"""Outline an object from above and from the side: convex polygons, world frame, m.

Assets are drawn by their collision pieces, so that a mug has its handle and a chair its back; primitives by their
shape. The side is -Y (x to the right, z up) or +X (y to the right, z up).
"""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np

from worldkit.turning import matrices

from ...model.plan.committed import Plan, SceneObject
from ...model.plan.layout import PlacedObject
from ..anchors import cos_sin
from ..start import Motion


@dataclass(frozen=True)
class Silhouette:
    """One object's outlines: polygons of (N, 2) points, from above (x, y), from -Y (x, z) and from +X (y, z)."""

    name: str
    top: list[np.ndarray]
    side: list[np.ndarray]
    front: list[np.ndarray]


def silhouette(plan: Plan, placed: PlacedObject, motion: Motion | None = None) -> Silhouette:
    """The outlines of a placed object, also after a motion; those of its box if the catalog cannot be read."""
    row = next((row for row in plan.scene_objects if row.name == placed.name), None)
    clouds = primitive_clouds(row) if row is not None else _asset(placed)
    c, s = cos_sin(placed.deg_z)
    top, side, front = [], [], []
    for cloud in clouds:
        x = c * cloud[:, 0] - s * cloud[:, 1] + placed.position[0]
        y = s * cloud[:, 0] + c * cloud[:, 1] + placed.position[1]
        z = cloud[:, 2] + placed.position[2]
        if motion is not None:
            x, y, z = np.array(motion.rotation) @ np.stack([x, y, z]) + np.array(motion.shift)[:, None]
        top.append(_hull(np.stack([x, y], axis=1)))
        side.append(_hull(np.stack([x, z], axis=1)))
        front.append(_hull(np.stack([y, z], axis=1)))
    return Silhouette(placed.name, top, side, front)


def _hull(points: np.ndarray) -> np.ndarray:
    return cv2.convexHull(points.astype(np.float32)).reshape(-1, 2).astype(float)


def primitive_clouds(row: SceneObject) -> list[np.ndarray]:
    """The corners of a primitive, or of each part of a compound, after its tilt: (N, 3), around its centre, metres."""
    if row.parts:
        return [_solid(s.shape, s.half) @ np.array(s.rotation).T + np.array(s.centre) for s in row.whole().solids]
    if row.formed:
        return row.form().clouds()
    if not row.deg_x:
        return _primitive(row)
    c, s = cos_sin(row.deg_x)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    return [cloud @ turn.T for cloud in _primitive(row)]


def _primitive(row: SceneObject) -> list[np.ndarray]:
    x, y, z = (extent / 2 for extent in row.size)
    if row.primitive in ("sphere", "ellipsoid"):
        return [_ball(x, y, z)]
    if row.primitive == "cylinder":
        return [_tube(x, y, z)]
    if row.primitive == "capsule":
        straight = max(z - x, 0.0)
        ball, shift = _ball(x, y, x), np.array([0.0, 0.0, straight])
        return [np.concatenate([ball + shift, ball - shift])]
    return [_box(x, y, z)]


def _solid(shape: str, half: tuple[float, float, float]) -> np.ndarray:
    """The corners of a solid by MuJoCo's half sizes, around its own centre."""
    x, y, z = half
    if shape == "box":
        return _box(x, y, z)
    if shape == "cylinder":
        return _tube(x, x, y)
    if shape == "capsule":
        ball = _ball(x, x, x)
        shift = np.array([0.0, 0.0, y])
        return np.concatenate([ball + shift, ball - shift])
    return _ball(x, x, x) if shape == "sphere" else _ball(x, y, z)


def _box(x: float, y: float, z: float) -> np.ndarray:
    return np.array([(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])


def _ball(x: float, y: float, z: float) -> np.ndarray:
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi, 25))
    return np.stack([x * np.cos(u) * np.sin(v), y * np.sin(u) * np.sin(v), z * np.cos(v)], axis=-1).reshape(-1, 3)


def _tube(x: float, y: float, z: float) -> np.ndarray:
    u = np.linspace(0, 2 * np.pi, 49)
    ring = np.stack([x * np.cos(u), y * np.sin(u), np.full_like(u, z)], axis=1)
    return np.concatenate([ring, ring * (1, 1, -1)])


def _asset(placed: PlacedObject) -> list[np.ndarray]:
    from worldkit import assets

    box = [_box(*(extent / 2 for extent in placed.size))]
    try:
        return asset_clouds(placed.kind, placed.size[2]) or box
    except (assets.UnknownAssetError, assets.AssetError, OSError):
        return box


def asset_clouds(key: str, height: float) -> list[np.ndarray]:
    """The corners of an asset's collision pieces, each (N, 3), around the centre of its bounding box, metres."""
    from worldkit import assets

    entry = assets.find(key)
    scale = entry.scale(height)
    clouds = []
    for piece in entry.collision:
        if piece.file is not None:
            local = _vertices(piece.file)
        elif piece.extents is not None:
            local = _box(*(extent / 2 for extent in piece.extents))
        else:
            radius = (piece.diameter or 0.0) / 2
            tall = piece.height is not None and piece.type in ("cylinder", "capsule")
            local = _tube(radius, radius, (piece.height or 0.0) / 2) if tall else _ball(radius, radius, radius)
        clouds.append((local @ matrices(piece.quat).T + np.asarray(piece.pos)) * scale)
    return clouds


@lru_cache(maxsize=2048)
def _vertices(file: Path) -> np.ndarray:
    """(N, 3) vertices of a Wavefront mesh."""
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    rows = [line.split()[1:4] for line in lines if line.startswith("v ")]
    return np.asarray(rows, dtype=float).reshape(-1, 3)
