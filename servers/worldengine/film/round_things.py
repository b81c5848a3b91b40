"""Things whose outline does not turn with them: a ball that spins covers what a still one covers.

A point beside such a thing, carried along as if it were a part of it, would come onto it: a rolling ball would get a pale ring. Its
pattern goes round, but not its shade and gloss, which are in the same picture: so only a little of a turn is smeared.
"""

from __future__ import annotations

import numpy as np

from . import screws

NOT, ABOUT_Z, ALL_ROUND, OF_A_STRING = 0, 1, 2, 3
"""How a thing is round: not at all, as a cylinder about its own z, as a ball, as a cylinder that is one piece of a string."""
MOST_RAD = 0.3
"""Of a turn about an axis of symmetry so much at most is smeared, rad."""
SAME = 0.9, 0.2
"""A piece of a string is the same one at another moment where the cosine between both is so large, and its length as far off at most:
a string that hangs through, or is paid out, has other pieces then, under the same numbers."""


def spun(now: np.ndarray, then: np.ndarray, rounds: np.ndarray, most_rad: float = 0.0) -> np.ndarray:
    """Poses at another moment (N, 3, 4), but no round thing has turned on its own axis by more than an angle, rad.

    Args:
        now, then: poses at two moments near to each other, as in `carrying.Surfaces`.
        rounds: how each of them is round (N,).
    """
    some = np.flatnonzero(rounds[: min(len(now), len(then))])
    some = some[np.abs(now[some, :, :3] - then[some, :, :3]).max(axis=(1, 2)) > 1e-9]
    found = then.copy()
    if not len(some):
        return found
    others = some[(rounds[some] == OF_A_STRING) & ~_same(now[some, :, 2], then[some, :, 2])]
    found[others] = now[others]
    some = np.setdiff1d(some, others)
    if not len(some):
        return found
    turn = then[some, :, :3] @ np.linalg.pinv(now[some, :, :3])
    swing = np.where((rounds[some] != ALL_ROUND)[:, None, None], _between(now[some, :, 2], then[some, :, 2]), np.eye(3))
    axis, angle = screws.turning(np.swapaxes(swing, 1, 2) @ turn)
    less = np.clip(angle, -most_rad, most_rad)[:, None, None]
    part = np.eye(3) + np.sin(less) * axis + (1 - np.cos(less)) * axis @ axis
    found[some, :, :3] = swing @ part @ now[some, :, :3]
    return found


def _same(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Whether pieces of a string that reach along `one` (N, 3) are those that reach along `other` soon after."""
    long, then = np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1)
    alike = (one * other).sum(axis=1) > SAME[0] * long * then
    return np.asarray(alike & (np.abs(then - long) < SAME[1] * long))


def _between(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The shortest turns (N, 3, 3) from ways (N, 3) to others, of any length, less than half a turn away."""
    a, b = (way / np.linalg.norm(way, axis=1, keepdims=True) for way in (one, other))
    x, y, z = np.cross(a, b).T
    rest = np.zeros_like(x)
    cross = np.stack([rest, -z, y, z, rest, -x, -y, x, rest], axis=1).reshape(-1, 3, 3)
    cosine = np.maximum((a * b).sum(axis=1), -1.0 + 1e-9)
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + cosine)[:, None, None])
