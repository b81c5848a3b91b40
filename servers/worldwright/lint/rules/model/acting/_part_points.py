"""Whether each part of a thing is as large as the plan's: by points just inside its geoms, which the other's must hold.

Boxes, cylinders and what else has a formula; a part may be built of several, and several parts as one.
"""

from itertools import product

import numpy as np

from ....compiled.view import ModelView

INSET, SHARE, LEAST_M = 0.95, 0.03, 1e-3
"""Points lie at this share of a geom's half sizes; what has to hold them is grown by a share of its size, or so much."""
FORMED = ("box", "sphere", "ellipsoid", "cylinder", "capsule")
CORNERS = np.array([*product((-1.0, 1.0), repeat=3), (0.0, 0.0, 0.0)])
TIPS = np.array([*np.eye(3), *-np.eye(3), np.zeros(3)])


def uncovered(view: ModelView, geoms: list[int], body: int, other: ModelView, held: list[int], twin: int) -> int | None:
    """The first of some geoms of a body of which a point lies in none of the twin's; None where all are covered.

    Args:
        view: the world of the geoms, and `body` its frame.
        geoms: indices of geoms, each of one of the kinds `FORMED`.
        other: the world that must hold them, by its geoms `held`, in the frame of its body `twin`.
    """
    for geom in geoms:
        points = _in_body(view, geom, body)
        inside = np.zeros(len(points), bool)
        for one in held:
            inside |= _holds(other, one, twin, points)
            if inside.all():
                break
        else:
            return geom
    return None


def away(view: ModelView, geom: int, body: int, points: np.ndarray) -> np.ndarray:
    """(n,) distances of points, in the frame of a body, from the box along the axes of one of its geoms, m; 0 inside."""
    off = np.abs(_in_geom(view, geom, body, points) - view.geom_aabb[geom, :3]) - view.geom_aabb[geom, 3:]
    return np.asarray(np.linalg.norm(np.maximum(off, 0.0), axis=1))


def _in_body(view: ModelView, geom: int, body: int) -> np.ndarray:
    """(n, 3) points just inside a geom, in the frame of a body, m."""
    shape = CORNERS if view.geom_kind[geom] == "box" else TIPS
    world = view.geom_xpos[geom] + (INSET * shape * view.geom_aabb[geom, 3:]) @ view.geom_xmat[geom].T
    found: np.ndarray = (world - view.xpos[body]) @ view.xmat[body]
    return found


def _holds(view: ModelView, geom: int, body: int, points: np.ndarray) -> np.ndarray:
    """(n,) bool: which points, in the frame of a body, lie in one of its geoms."""
    off = np.abs(_in_geom(view, geom, body, points))
    half, kind = view.geom_aabb[geom, 3:], view.geom_kind[geom]
    half = half + np.maximum(SHARE * half, LEAST_M)
    if kind == "box":
        found = (off <= half).all(axis=1)
    elif kind == "cylinder":
        found = (np.hypot(off[:, 0], off[:, 1]) <= half[0]) & (off[:, 2] <= half[2])
    elif kind == "capsule":
        off[:, 2] = np.maximum(off[:, 2] - (half[2] - half[0]), 0.0)
        found = (off**2).sum(axis=1) <= half[0] ** 2
    else:
        found = ((off / half) ** 2).sum(axis=1) <= 1
    return np.asarray(found)


def _in_geom(view: ModelView, geom: int, body: int, points: np.ndarray) -> np.ndarray:
    """(n, 3) points in the frame of a geom, of such in the frame of its body, m."""
    world = view.xpos[body] + points @ view.xmat[body].T
    return np.asarray((world - view.geom_xpos[geom]) @ view.geom_xmat[geom])
