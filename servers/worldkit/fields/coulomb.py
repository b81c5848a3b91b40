"""Charges that attract and repel each other, in a uniform field or none.

    F = q q' / (4 pi epsilon0 r^2) on both, apart where their signs agree; U = q q' / (4 pi epsilon0 r); F = q E

Each body carries its charge at one point, which is exact for balls whose charge stays evenly spread. Nearer than `CORE_M` one of two is
such a ball, which the other enters: its force falls to nothing at the middle, and two charges at one place are pushed nowhere. Slow: no
radiation, no magnetism. Source: Jackson, Classical Electrodynamics, sections 1.1, 1.4 and 1.11.
"""

import numpy as np

from . import EPSILON0

Array = np.ndarray
CORE_M = 1e-4
"""m: the radius of that ball."""


def felt(at: Array, charge: Array, uniform: Array) -> tuple[Array, float]:
    """The forces (n, 3), N, on charges (n,), C, at (n, 3), m, in a uniform field (3,), V/m, and the energy, J."""
    way = at[:, None] - at
    far = np.sqrt(np.einsum("ijk,ijk->ij", way, way))
    np.fill_diagonal(far, np.inf)
    away = np.maximum(far, CORE_M)
    pairs = charge[:, None] * charge / (4 * np.pi * EPSILON0 * away)
    forces = ((pairs / away**2)[..., None] * way).sum(axis=1) + charge[:, None] * uniform
    pairs *= 1.5 - 0.5 * (np.minimum(far, CORE_M) / CORE_M) ** 2  # 1 outside
    return forces, float(pairs.sum()) / 2 - float((charge[:, None] * at * uniform).sum())
