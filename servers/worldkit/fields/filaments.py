"""Magnets as filaments: what is magnetised evenly along z has the field of a current B_r / mu0 for each metre of its length, around its side.

That sheet is cut into short currents I dl, each smeared a little, so that two that meet are no singularity. So faces may touch: the
force there is what it is in the book. A ball is a dipole. Source: Jackson, Classical Electrodynamics, sections 5.8 to 5.10.
"""

from typing import NamedTuple

import numpy as np

from . import MU0

Array = np.ndarray
AROUND, ALONG = 16, 8
"""Currents around, and loops along, a cylinder."""
SIDE = 4
"""Currents on each side of a bar's loop."""
SMEARED = 0.25
"""Of the distance of two neighbours, around or along, whichever is less."""
BLOCK = 96
"""Places whose field is worked out at once."""
SMALL = 0.02
"""Of a ball's radius: that of the loop that makes its dipole."""


class Filaments(NamedTuple):
    """The currents of one magnet, in its own frame."""

    at: Array
    """(n, 3) m."""
    current: Array
    """(n, 3) A m: current times length; their sum is 0."""
    smeared: Array
    """(n,) m."""

    @property
    def moment(self) -> Array:
        """(3,) A m^2."""
        return np.asarray(np.cross(self.at, self.current).sum(axis=0) / 2)


def axis_of(box: bool, size: Array) -> int:
    """Which of its own axes a magnet is magnetised along: a box of half sizes (3,) along its longest side, all else along z."""
    return int(np.argmax(size)) if box else 2


def cylinder(radius: float, length: float, remanence: float) -> Filaments:
    """A cylinder along z; m and T."""
    turn = 2 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
    out = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(AROUND)])
    way = 2 * np.pi * radius / AROUND * np.column_stack([-np.sin(turn), np.cos(turn), np.zeros(AROUND)])
    return _stacked(radius * out, way, length, remanence, 2 * np.pi * radius / AROUND)


def bar(width: float, depth: float, length: float, remanence: float) -> Filaments:
    """A bar along z, width along x and depth along y; m and T."""
    corners = np.array([(1, -1), (1, 1), (-1, 1), (-1, -1)]) * (width / 2, depth / 2)
    steps = np.roll(corners, -1, axis=0) - corners
    shares = (np.arange(SIDE) + 0.5) / SIDE
    at = (corners[:, None] + steps[:, None] * shares[:, None]).reshape(-1, 2)
    way = np.repeat(steps / SIDE, SIDE, axis=0)
    return _stacked(_flat(at), _flat(way), length, remanence, min(width, depth) / SIDE)


def ball(radius: float, remanence: float) -> Filaments:
    """A ball magnetised along z, a dipole of B_r V / mu0; m and T."""
    loops = cylinder(SMALL * radius, 1.0, remanence * 4 / 3 * radius / SMALL**2)
    current = loops.current.reshape(ALONG, AROUND, 3).sum(axis=0)
    return Filaments(loops.at[:AROUND] * (1, 1, 0), current, np.zeros(AROUND))


def _stacked(at: Array, way: Array, length: float, remanence: float, apart: float) -> Filaments:
    """A loop, stacked along z."""
    nodes, weights = np.polynomial.legendre.leggauss(ALONG)
    places = np.concatenate([at + np.array([0, 0, node * length / 2]) for node in nodes])
    current = np.concatenate([remanence / MU0 * weight * length / 2 * way for weight in weights])
    return Filaments(places, current, np.full(len(places), SMEARED * min(apart, length / ALONG)))


def _flat(at: Array) -> Array:
    return np.column_stack([at, np.zeros(len(at))])


def field(at: Array, magnets: Filaments) -> Array:
    """(p, 3) T: what all of them give together. No matrix product here, whose last digit depends on a processor's threads."""
    middle = magnets.at.mean(axis=0)  # near which squares of distances lose no digits
    there = magnets.at - middle
    told = (there**2).sum(axis=1) + magnets.smeared**2, cross(magnets.current, there)
    blocks = [at[n : n + BLOCK] - middle for n in range(0, len(at), BLOCK)]  # few at a time stay in the cache
    return (
        np.concatenate([_near(here, there, magnets.current, *told) for here in blocks]) if blocks else np.zeros((0, 3))
    )


def _near(here: Array, there: Array, current: Array, size: Array, turned: Array) -> Array:
    far = np.einsum("pk,nk->pn", -2 * here, there)
    far += (here**2).sum(axis=1)[:, None]
    far += size
    share = MU0 / (4 * np.pi) / (far * np.sqrt(far))
    # sum of J x (p - x) / r^3 = (sum of J / r^3) x p - sum of J x x / r^3
    return cross(np.einsum("pn,nk->pk", share, current), here) - np.einsum("pn,nk->pk", share, turned)


def cross(a: Array, b: Array) -> Array:
    """a x b, without the checks that make numpy's slow for many short vectors."""
    x, y, z = (a[..., (n + 1) % 3] * b[..., (n + 2) % 3] - a[..., (n + 2) % 3] * b[..., (n + 1) % 3] for n in range(3))
    return np.stack([x, y, z], axis=-1)
