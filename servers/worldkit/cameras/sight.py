"""What stands between a camera and its subjects."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .subjects import VISIBLE_GROUPS, Crossing

if TYPE_CHECKING:
    import mujoco

_GROUPS = np.array([group < VISIBLE_GROUPS for group in range(6)], dtype=np.uint8)


def samples(crossing: Crossing, count: int = 40) -> np.ndarray:
    """Points (N, 3) on the way of the subjects, spread over time and subjects."""
    places = crossing.places
    moments = np.linspace(0, len(places) - 1, min(len(places), 8)).astype(int)
    flat = places[moments].reshape(-1, 3)
    return flat[np.linspace(0, len(flat) - 1, min(len(flat), count)).astype(int)]


def hidden_share(
    model: mujoco.MjModel, data: mujoco.MjData, eye: np.ndarray, points: np.ndarray, subjects: tuple[int, ...]
) -> float:
    """Share of `points` that fixed geoms (those of the subjects aside) hide from `eye`, 0..1."""
    import mujoco

    ways = points - eye
    lengths = np.linalg.norm(ways, axis=1)
    hits = np.full(len(points), -1, dtype=np.int32)
    distances = np.full(len(points), -1.0)
    directions = np.ascontiguousarray(ways / np.maximum(lengths, 1e-9)[:, None])
    mujoco.mj_multiRay(
        model,
        data,
        eye.astype(float),
        directions.reshape(-1),
        _GROUPS,
        True,
        -1,
        hits,
        distances,
        None,
        len(points),
        1e6,
    )
    own = np.isin(np.arange(model.nbody), subjects)
    hidden = 0
    for hit, distance, length in zip(hits, distances, lengths, strict=True):
        if hit < 0 or distance < 0 or distance > length - 1e-3 - 0.02 * length:
            continue
        body = int(model.geom_bodyid[hit])
        # What moves now may have moved on by then.
        hidden += bool(model.body_weldid[body] == 0 and not own[body])
    return hidden / max(len(points), 1)


def supports(model: mujoco.MjModel, data: mujoco.MjData, crossing: Crossing) -> tuple[np.ndarray, set[int]]:
    """Where the subjects' way lies over fixed geoms: points (N, 3) on their surfaces, and the geoms but endless planes."""
    import mujoco

    down = np.array([0.0, 0.0, -1.0])
    hit = np.zeros(1, dtype=np.int32)
    points, geoms = [], set()
    fixed = np.flatnonzero(model.body_weldid == 0)
    for place in samples(crossing, 24):
        start = np.array(place, dtype=float)
        for _ in range(6):
            distance = mujoco.mj_ray(model, data, start, down, _GROUPS, True, -1, hit)
            if distance < 0:
                break
            start = start + down * (distance + 1e-4)
            geom = int(hit[0])
            if int(model.geom_bodyid[geom]) in fixed and int(model.geom_bodyid[geom]) not in crossing.bodies:
                points.append(start.copy())
                if model.geom_rbound[geom] > 0:
                    geoms.add(geom)
                break
    return np.array(points).reshape(-1, 3), geoms


def ground_height(model: mujoco.MjModel, data: mujoco.MjData) -> float | None:
    """Height of the highest endless level plane, or None."""
    import mujoco

    heights = [
        float(data.geom_xpos[g][2])
        for g in range(model.ngeom)
        if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_PLANE
        and model.geom_size[g, :2].min() <= 0
        and data.geom_xmat[g].reshape(3, 3)[2, 2] > 0.95
    ]
    return max(heights) if heights else None
