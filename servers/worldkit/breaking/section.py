"""What the section between two pieces carries: stress from force and moment, by the theory of beams.

A force along the normal of a plane section and a moment across it make tension, which grows evenly from one edge to the other; a
force along it and a moment about its normal make shear. What is compared with a strength is the largest tension in any
direction:

    sigma = N / A + |M1| / W1 + |M2| / W2,   tau = V / A + |T| / Z,   S = sigma / 2 + sqrt(sigma^2 / 4 + tau^2)

Source: Navier 1826 (bending, W = I / c); Timoshenko, Strength of Materials (twist of a rectangle L x d,
Z = L d^2 / (3 + 1.8 d / L), within 1 %; of a circle it is 17 % low); Rankine's criterion for what is brittle.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

Array = np.ndarray


class Section(NamedTuple):
    """The section that a bond has, in the frame that its corners were given in."""

    centre: Array
    """(3,) m."""
    axes: Array
    """(3, 3) rows: the normal from the first piece to the second, the long principal axis, the thin one."""
    area: float
    """m^2."""
    moduli: Array
    """(3,) m^3: of twist about the normal, and of bending about each principal axis."""


def section(polygons: Sequence[Array], normal: Array) -> Section:
    """The section of convex polygons (k, 3), m, in one plane, that do not overlap; `normal` (3,) points to the second piece."""
    normal = normal / np.linalg.norm(normal)
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= np.linalg.norm(across)
    frame = np.stack([across, np.cross(normal, across)])
    origin = polygons[0].mean(axis=0)
    area, first, second = 0.0, np.zeros(2), np.zeros((2, 2))
    for corners in polygons:
        a = (corners - origin) @ frame.T
        b = np.roll(a, -1, axis=0)
        wedge = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        wedge = wedge * np.sign(wedge.sum())
        area += float(wedge.sum()) / 2
        first += wedge @ (a + b) / 6
        second += sum(np.einsum("k,ki,kj->ij", wedge, p, p) for p in (a, b, a + b)) / 24
    middle = first / area
    spread, turn = np.linalg.eigh(second - area * np.outer(middle, middle))  # the thin direction first
    points = (np.concatenate(polygons) - origin) @ frame.T - middle
    thin, long = np.abs(points @ turn).max(axis=0)
    twist = area * 2 * thin / (3 + 1.8 * thin / long)
    principal = turn.T @ frame
    # A moment about the long axis bends across the thin one, and the other way round.
    moduli = np.array([twist, spread[0] / thin, spread[1] / long])
    return Section(origin + middle @ frame, np.stack([normal, principal[1], principal[0]]), area, moduli)


def stress(forces: Array, moments: Array, areas: Array, moduli: Array) -> Array:
    """(n,) Pa: the largest tension in each of n sections.

    Args:
        forces: (n, 3) N on the first piece: along the normal, which points to the second piece, and along the two axes.
        moments: (n, 3) N m on the first piece, about the same three.
        areas: (n,) m^2.
        moduli: (n, 3) m^3, as `Section` has them.
    """
    share = np.abs(moments) / moduli
    tension = forces[:, 0] / areas + share[:, 1] + share[:, 2]
    shear = np.hypot(forces[:, 1], forces[:, 2]) / areas + share[:, 0]
    return np.asarray(tension / 2 + np.sqrt(tension**2 / 4 + shear**2))
