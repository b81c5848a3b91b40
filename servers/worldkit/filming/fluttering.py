"""How thin things turn on the way that they take: a leaf rocks and spins in the air, and lies level where it comes to rest."""

import numpy as np

from ..turning import about, product

ROCKS = 5.0
"""Lengths of itself on which a leaf rocks once to and fro."""
SPINS = 14.0
"""Lengths of itself on which it turns once around the vertical."""
MOST = np.radians(65.0)
"""How far it rocks to each side, in a full fall."""
FULL_M_S = 0.5
"""The speed from which it rocks so far."""


def turns(places: np.ndarray, times: np.ndarray, length: float) -> np.ndarray:
    """Quaternions (F, P, 4) of P leaves of a length, m, at places (F, P, 3), m, at recorded times (F,), s.

    They follow from the way and its speed alone, so that a moment that is held or shown again shows the same.
    """
    moments, first, back = np.unique(np.round(times, 6), return_index=True, return_inverse=True)
    way = places[first]
    step = np.linalg.norm(np.diff(way, axis=0, prepend=way[:1]), axis=2)
    gone = np.cumsum(step, axis=0) / length
    speed = step / np.diff(moments, prepend=moments[0] - 1.0)[:, None]
    speed[0] = speed[min(1, len(speed) - 1)]
    random = np.random.default_rng(places.shape[1])
    start = random.uniform(0, 2 * np.pi, (3, places.shape[1]))
    rocking = MOST * np.tanh(speed / FULL_M_S)
    x, y, z = np.eye(3)
    roll = about(x, rocking * np.sin(start[0] + 2 * np.pi * gone / ROCKS))
    pitch = about(y, 0.7 * rocking * np.sin(start[1] + 2 * np.pi * gone / (1.3 * ROCKS)))
    found = product(about(z, start[2] + 2 * np.pi * gone / SPINS), product(pitch, roll))
    return np.asarray(found[back.ravel()])
