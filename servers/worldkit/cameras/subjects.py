"""The space that subjects take up: points to fit into a frame."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..turning import turned

if TYPE_CHECKING:
    import mujoco

VISIBLE_GROUPS = 3
"""Geom groups below this are seen."""
MOMENTS = 160
"""How many moments of a recording are used, besides the extremes."""
MOST_CARRIERS = 64
"""So many of the bodies that carry a flex stand for it, evenly taken: each is followed over the whole recording."""
_SIGNS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
_BALL = np.concatenate([np.eye(3), -np.eye(3), _SIGNS * 0.75])
"""Points whose hull holds a unit ball closely enough for framing."""


@dataclass(frozen=True)
class Crossing:
    """Where the subjects are over a recording."""

    points: np.ndarray
    """(N, 3): corners of boxes around the subjects at all moments, m."""
    centres: np.ndarray
    """(T, 3): middle of all subjects at each moment, m."""
    places: np.ndarray
    """(T, S, 3): middle of each subject."""
    radii: np.ndarray
    """(S,): radius of each subject, m."""
    bodies: tuple[int, ...]
    """Body numbers of the subjects."""


def known_bodies(model: mujoco.MjModel) -> list[str]:
    """Names of the bodies, the world excepted."""
    import mujoco

    names = (mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, i) for i in range(1, model.nbody))
    return [name for name in names if name]


def resolve(model: mujoco.MjModel, names: tuple[str, ...]) -> tuple[int, ...]:
    """Body numbers of the subjects; without names: all that moves, or else every body that can be seen.

    A flex stands for the bodies that carry it; one that no body carries is `drawn` only.

    Raises ValueError, listing the bodies, for a name that is neither.
    """
    import mujoco

    if names:
        numbers: list[int] = []
        for name in names:
            number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
            flex = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_FLEX, name) if number < 0 else -1
            if number < 0 and flex < 0:
                missing = [n for n in names if not _is_there(model, n)]
                known = ", ".join((*known_bodies(model), *_flexes(model))) or "none"
                raise ValueError(f"there is no body {', '.join(missing)}; known: {known}")
            numbers += [number] if flex < 0 else _carriers(model, flex)
        return tuple(dict.fromkeys(numbers))
    seen = [b for b in range(1, model.nbody) if len(_geoms(model, b))]
    moving = [b for b in seen if model.body_weldid[b] != 0]
    return tuple(moving or seen)


def _flexes(model: mujoco.MjModel) -> list[str]:
    from ..naming import names

    return names(model, "flex", model.nflex)


def _is_there(model: mujoco.MjModel, name: str) -> bool:
    import mujoco

    return any(
        mujoco.mj_name2id(model, kind, name) >= 0 for kind in (mujoco.mjtObj.mjOBJ_BODY, mujoco.mjtObj.mjOBJ_FLEX)
    )


def _carriers(model: mujoco.MjModel, flex: int) -> list[int]:
    """The bodies, the world excepted, that carry a flex's shape."""
    first, node = int(model.flex_vertadr[flex]), int(model.flex_nodeadr[flex])
    owners = model.flex_vertbodyid[first : first + int(model.flex_vertnum[flex])].tolist()
    nodes = model.flex_nodebodyid[node : node + int(model.flex_nodenum[flex])].tolist() if node >= 0 else []
    found = list(dict.fromkeys(int(body) for body in (*nodes, *owners) if body > 0))
    return found[:: -(-len(found) // MOST_CARRIERS)] if found else []


def drawn(model: mujoco.MjModel, names: tuple[str, ...]) -> np.ndarray:
    """Corners (8 F, 3) m of the boxes around the subjects that no body carries, as the world is built: what an author's law moves."""
    import mujoco

    from ..moved_shapes import at_rest

    found = [np.zeros((0, 3))]
    for name in names:
        flex = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_FLEX, name)
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
        if body < 0 <= flex and not _carriers(model, flex):
            points = at_rest(model, flex)
            low, high = points.min(axis=0), points.max(axis=0)
            found.append(0.5 * (low + high) + 0.5 * _SIGNS * (high - low))
    return np.concatenate(found)


def _family(model: mujoco.MjModel, body: int) -> list[int]:
    """The body and all that hangs on it, those with geoms to see."""
    family = {body}
    for child in range(body + 1, model.nbody):
        if int(model.body_parentid[child]) in family:
            family.add(child)
    return [b for b in sorted(family) if len(_geoms(model, b))] or [body]


def _geoms(model: mujoco.MjModel, body: int) -> np.ndarray:
    """Geoms of a body that can be seen; all but endless planes if none can."""
    mask = (model.geom_bodyid == body) & (model.geom_rbound > 0)
    shown = mask & (model.geom_group < VISIBLE_GROUPS)
    return np.flatnonzero(shown if shown.any() else mask)


def corners(model: mujoco.MjModel, data: mujoco.MjData, geoms: np.ndarray) -> np.ndarray:
    """Corners (8 G, 3) of the oriented boxes around geoms, world frame."""
    if not len(geoms):
        return np.zeros((0, 3))
    turned = data.geom_xmat[geoms].reshape(-1, 3, 3)
    local = model.geom_aabb[geoms, None, :3] + _SIGNS[None] * model.geom_aabb[geoms, None, 3:]
    return (data.geom_xpos[geoms][:, None] + np.einsum("gij,gkj->gki", turned, local)).reshape(-1, 3)


def _moments(places: np.ndarray) -> np.ndarray:
    """Indices of the moments that are used: evenly spread ones and the extremes of every body along every axis."""
    count = len(places)
    even = np.linspace(0, count - 1, min(count, MOMENTS)).astype(int)
    flat = places.reshape(count, -1)
    return np.array(sorted({*even.tolist(), *flat.argmin(axis=0).tolist(), *flat.argmax(axis=0).tolist()}))


def _own_box(model: mujoco.MjModel, data: mujoco.MjData, body: int) -> np.ndarray:
    """Corners (8, 3) of the box around a body's geoms, in the body's frame; its origin eight times if it has none."""
    turned = data.xmat[body].reshape(3, 3)
    points = (corners(model, data, _geoms(model, body)) - data.xpos[body]) @ turned
    if not len(points):
        return np.zeros((8, 3))
    low, high = points.min(axis=0), points.max(axis=0)
    return 0.5 * (low + high) + 0.5 * _SIGNS * (high - low)


def crossing(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    bodies: tuple[int, ...],
    positions: np.ndarray | None,
    orientations: np.ndarray | None = None,
) -> Crossing:
    """Where `bodies`, and what hangs on them, are: at rest (`data`), or over time.

    `positions` (T, B, 3) are the origins of all bodies but the world, `orientations` (T, B, 4) their quaternions, w
    first; without these a body may be turned in any way, so it takes up a ball.
    """
    families = [_family(model, body) for body in bodies]
    everyone = sorted({member for family in families for member in family})
    tracks = data.xpos[None, everyone] + 0.0
    turns: np.ndarray | None = data.xquat[None, everyone] + 0.0
    if positions is not None and len(positions):
        first = 0 if positions.shape[1] == model.nbody else 1
        columns = [b - first for b in everyone]
        chosen = np.asarray(positions, dtype=float)[:, columns]
        sound = np.isfinite(chosen).all(axis=(1, 2))
        if sound.any():
            moments = np.flatnonzero(sound)[_moments(chosen[sound])]
            tracks = chosen[moments]
            turns = None if orientations is None else np.asarray(orientations, dtype=float)[moments][:, columns]
    clouds, radii = {}, {}
    for i, body in enumerate(everyone):
        box = _own_box(model, data, body)
        middle = box.mean(axis=0)
        radii[body] = _ball(model, body) or float(np.linalg.norm(box[0] - middle))
        if turns is not None or model.body_weldid[body] == 0:
            quaternions = turns[:, i] if turns is not None else np.repeat(data.xquat[None, body], len(tracks), 0)
            if _ball(model, body):
                clouds[body] = tracks[:, i, None] + radii[body] * _BALL
            else:
                clouds[body] = tracks[:, i, None] + turned(quaternions[:, None], box)
        else:
            clouds[body] = tracks[:, i, None] + (radii[body] + float(np.linalg.norm(middle))) * _BALL
    places, sizes = [], []
    for family in families:
        around = np.concatenate([clouds[member] for member in family], axis=1)
        low, high = around.min(axis=1), around.max(axis=1)
        places.append(0.5 * (low + high))
        own = [radii[member] for member in family]
        spread = float(np.linalg.norm(high - low, axis=1).max()) / 2.0
        sizes.append(own[0] if len(family) == 1 else spread)
    points = np.concatenate([clouds[member].reshape(-1, 3) for member in everyone])
    where = np.stack(places, axis=1)
    return Crossing(points, where.mean(axis=1), where, np.array(sizes), bodies)


def with_drawn(way: Crossing | None, points: np.ndarray) -> Crossing | None:
    """A crossing, with the corners (8 F, 3) m of what is only drawn; of these alone where nothing else is a subject."""
    if not len(points):
        return way
    if way is not None:
        return replace(way, points=np.concatenate([way.points, points]))
    low, high = points.min(axis=0), points.max(axis=0)
    middle = 0.5 * (low + high)[None]
    return Crossing(points, middle, middle[None], np.array([np.linalg.norm(high - low) / 2]), ())


def _ball(model: mujoco.MjModel, body: int) -> float:
    """Radius of a body that is one sphere about its own origin; 0 for any other."""
    import mujoco

    geoms = _geoms(model, body)
    if len(geoms) != 1 or model.geom_type[geoms[0]] != mujoco.mjtGeom.mjGEOM_SPHERE:
        return 0.0
    return float(model.geom_size[geoms[0], 0]) if np.linalg.norm(model.geom_pos[geoms[0]]) < 1e-9 else 0.0
