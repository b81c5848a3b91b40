"""How far things go in the picture while a shutter is open: so many moments it takes to blur them evenly, and no more."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from .renderers.preview.eye import View

if TYPE_CHECKING:
    import mujoco

SHARP_PX = 1.0
"""What goes less far stays sharp."""
APART_PX = 2.0
"""Moments that lie so far apart melt into each other."""
BESIDE = 0.25
"""What is further beside the picture than this share of it does not count."""
NEAR_M = 0.02
_SIGNS = np.array(list(product((-1.0, 1.0), repeat=3)))
_GRID = np.array(list(product((-0.9, 0.0, 0.9), repeat=2)))


def points(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """(P, 3), m, world: the corners of the boxes around all geoms but endless planes, and of all that is soft."""
    some = np.flatnonzero(model.geom_rbound > 0)
    turned = data.geom_xmat[some].reshape(-1, 1, 3, 3)
    corners = model.geom_aabb[some, None, :3] + _SIGNS * model.geom_aabb[some, None, 3:]
    placed = data.geom_xpos[some, None] + (turned @ corners[..., None])[..., 0]
    return np.concatenate([placed.reshape(-1, 3), np.asarray(data.flexvert_xpos).reshape(-1, 3)])


def travel_px(opened: View, closed: View, before: np.ndarray, after: np.ndarray, height: int) -> float:
    """How far, in pixels of a picture of `height`, anything goes from one moment to another, the camera's own way included.

    Args:
        opened, closed: the camera at both moments.
        before, after: the same points (P, 3) at both, m.
        height: of the picture.
    """
    if opened is not closed:  # what has no corners in the picture, such as the ground, goes by, too
        away = max(float(np.median(np.linalg.norm(before - opened.eye, axis=1))), 0.1) if len(before) else 1.0
        ways = opened.forward + (_GRID * opened.tangents) @ opened.axes[:, :2].T
        fixed = opened.eye + away * ways
        before, after = np.concatenate([before, fixed]), np.concatenate([after, fixed])
    (here, ahead), (there, still) = _seen(opened, before), _seen(closed, after)
    both = ahead & still
    if not both.any():
        return 0.0
    gone = (there[both] - here[both]) * np.array([opened.tangents[0] / opened.tangents[1], 1.0]) * height / 2
    return float(np.linalg.norm(gone, axis=1).max())


def moments(pixels: float, most: int) -> int:
    """How many moments blur what goes so far, at most `most`."""
    return 1 if pixels < SHARP_PX else int(min(most, max(2, np.ceil(pixels / APART_PX))))


def _seen(view: View, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where places are in the picture, -1 to 1 each way, kept near it, and which of them are before the camera."""
    own = (places - view.eye) @ view.axes
    depth = -own[:, 2]
    ahead = depth > NEAR_M
    flat = own[:, :2] / np.maximum(depth, NEAR_M)[:, None] / view.tangents
    return np.clip(flat, -1 - BESIDE, 1 + BESIDE), ahead
