"""How far things go in the picture while a shutter is open: so many moments it takes to blur them evenly, and no more."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .renderers.preview.eye import View

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco

SHARP_PX = 1.0
"""What goes less far stays sharp."""
APART_PX = 2.0
"""Moments that lie so far apart melt into each other."""
BESIDE = 0.25
"""What is further beside the picture than this share of it does not count."""
LOOKS = (0.0, 0.38, 1.0 - 1e-6)
"""At these shares of the time that a shutter is open it is looked where things are: what turns once around is back at its end."""
NEAR_M = 0.02
_SIGNS = np.array(list(product((-1.0, 1.0), repeat=3)))
_EDGES = np.array([(a, b) for a in range(8) for b in range(a) if np.abs(_SIGNS[a] - _SIGNS[b]).sum() == 2])
_GRID = np.array(list(product((-0.9, 0.0, 0.9), repeat=2)))


class Drawn(NamedTuple):
    """What is drawn at a moment: the boxes around all geoms but endless planes, and single points of all that is soft."""

    middles: np.ndarray
    """(N, 3), m, world."""
    turns: np.ndarray
    """(N, 3, 3)."""
    halves: np.ndarray
    """(N, 3), m: half their extents."""
    loose: np.ndarray
    """(P, 3), m, world."""

    def at(self, owners: np.ndarray, own: np.ndarray) -> np.ndarray:
        """(M, 3), m, world: where points (M, 3) of these boxes' own frames are."""
        return np.asarray(self.middles[owners] + (self.turns[owners] @ own[..., None])[..., 0])


def drawn(model: mujoco.MjModel, data: mujoco.MjData) -> Drawn:
    """What a model shows where `data` has it."""
    some = np.flatnonzero(model.geom_rbound > 0)
    turns = np.array(data.geom_xmat[some]).reshape(-1, 3, 3)
    middles = data.geom_xpos[some] + (turns @ model.geom_aabb[some, :3, None])[..., 0]
    return Drawn(middles, turns, model.geom_aabb[some, 3:], np.array(data.flexvert_xpos).reshape(-1, 3))


def travel_px(views: Sequence[View], moments: Sequence[Drawn], height: int) -> float:
    """How far, pixels of a picture of `height`, anything goes from moment to moment, the camera's own way included.

    Corners alone would not do: those of what is large may all be beside the picture.

    Args:
        views: the camera at some moments.
        moments: the same things at each of them.
        height: of the picture.
    """
    count = len(moments[0].halves)
    parts = [(np.repeat(np.arange(count), 8), (_SIGNS * moments[0].halves[:, None]).reshape(-1, 3))]
    parts += [_met(view, there) for view, there in zip(views, moments, strict=True)]
    owners, own = (np.concatenate(kind) for kind in zip(*parts, strict=True))
    places = [np.concatenate([there.at(owners, own), there.loose]) for there in moments]
    if any(not np.array_equal(views[0].matrix(), view.matrix()) for view in views[1:]):
        # Bare ground goes by, too.
        away = max(float(np.median(np.linalg.norm(places[0] - views[0].eye, axis=1))), 0.1) if len(places[0]) else 1.0
        fixed = views[0].eye + away * _rays(views[0])
        places = [np.concatenate([there, fixed]) for there in places]
    scale = np.array([views[0].tangents[0] / views[0].tangents[1], 1.0]) * height / 2
    gone = np.zeros(len(places[0]))
    for (here, ahead), (there, still) in pairwise(map(_seen, views, places)):
        gone += np.where(ahead & still, np.linalg.norm((there - here) * scale, axis=1), 0.0)
    return float(gone.max(initial=0.0))


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


def _rays(view: View) -> np.ndarray:
    """(9, 3): ways from the eye through points all over the picture, as long as they go 1 m ahead."""
    return np.asarray(view.forward + (_GRID * view.tangents) @ view.axes[:, :2].T)


def _met(view: View, there: Drawn) -> tuple[np.ndarray, np.ndarray]:
    """Points of the boxes that are partly in the picture: their numbers (M,), and the points in their frames (M, 3), m.

    Either an edge of such a box crosses the picture, or a side of it fills it.
    """
    corners = there.middles[:, None] + _SIGNS * there.halves[:, None] @ np.swapaxes(there.turns, 1, 2)
    inside = _inside((corners - view.eye) @ view.axes, view)
    some = np.flatnonzero((inside >= 0).any(axis=1).all(axis=-1) & (inside < 0).any(axis=(1, 2)))
    ends = inside[some][:, _EDGES]  # (S, 12, 2, 5)
    first, last = ends[:, :, 0], ends[:, :, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = first / (first - last)
    enters = np.where((first < 0) & (last >= 0), cross, 0.0).max(axis=-1)
    leaves = np.where((first >= 0) & (last < 0), cross, 1.0).min(axis=-1)
    box, edge = np.nonzero((enters < leaves) & ~((first < 0) & (last < 0)).any(axis=-1))
    begins, over = (_SIGNS[_EDGES[edge, k]] * there.halves[some[box]] for k in (0, 1))
    owners, own = [], []
    for share in (0.0, 0.5, 1.0):
        at = ((1 - share) * enters + share * leaves)[box, edge, None]
        owners.append(some[box])
        own.append((1 - at) * begins + at * over)
    eye = (view.eye - there.middles[some])[:, None] @ there.turns[some]  # (S, 1, 3)
    ways, half = _rays(view) @ there.turns[some], there.halves[some][:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.stack([(-half - eye) / ways, (half - eye) / ways])
    near, far = np.nanmax(sides.min(axis=0), axis=-1), np.nanmin(sides.max(axis=0), axis=-1)
    away = np.where(near > NEAR_M, near, far)  # the eye may be within
    box, ray = np.nonzero((near <= far) & (away > NEAR_M))
    owners.append(some[box])
    own.append(eye[box, 0] + away[box, ray, None] * ways[box, ray])
    return np.concatenate(owners), np.concatenate(own)


def _inside(own: np.ndarray, view: View) -> np.ndarray:
    """How far within each of the five sides of what the camera sees points (..., 3) of its frame are: (..., 5)."""
    x, y, depth = own[..., 0], own[..., 1], -own[..., 2]
    wide, high = view.tangents
    return np.stack([depth - NEAR_M, wide * depth - x, wide * depth + x, high * depth - y, high * depth + y], axis=-1)
