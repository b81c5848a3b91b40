"""What magnets do to each other and to soft iron: forces and torques on each current and each ball, and the energy of the field.

Currents J = I dl of magnets (`filaments`) have the energy - mu0 / (4 pi) sum J . J' / r. Soft iron: a ball in a field B is magnetised by
M = 3 B / mu0 (its own field takes a third of M away), but by no more than its saturation J_s / mu0:

    U = - mu0 / (4 pi) sum J . J' / r - V integral of M dB,   F = - grad U

so actio is reactio, and what bodies gain the field loses. Soft balls do not feel each other's magnetisation, and iron does not weaken a magnet.
Source: Jackson, Classical Electrodynamics, sections 5.7, 5.11, 5.16.
"""

from typing import NamedTuple

import numpy as np

from . import MU0
from .filaments import Filaments, cross, field

Array = np.ndarray
SHARE = MU0 / (4 * np.pi)


class Felt(NamedTuple):
    """What is felt."""

    currents: Array
    """(n, 3) N on each current."""
    turned: Array
    """(n, 3) N m on each current, besides what its force does."""
    balls: Array
    """(k, 3) N on each soft ball, at its middle."""
    energy: float
    """J; 0 with all of them far apart."""


def magnetised(field: Array, volume: Array, saturation: Array) -> tuple[Array, Array]:
    """The moments (k, 3), A m^2, of soft balls (k,) m^3 in fields (k, 3) T, and the energy of each, J; saturation (k,) T."""
    size = np.linalg.norm(field, axis=-1)
    full = saturation / 3
    moment = volume * np.minimum(3 * size, saturation) / MU0
    energy = -volume / MU0 * np.where(size < full, 1.5 * size**2, saturation * (size - full / 2))
    return moment[:, None] * field / np.maximum(size, 1e-30)[:, None], energy


def between(one: Filaments, other: Filaments) -> Felt:
    """What two magnets do to each other; the other's rows follow those of the one."""
    way = one.at[:, None] - other.at
    far = np.einsum("ijk,ijk->ij", way, way) + one.smeared[:, None] ** 2 + other.smeared**2
    near = SHARE / np.sqrt(far)
    alike = np.einsum("ik,jk->ij", one.current, other.current) * near
    pairs = (alike / far)[..., None] * way
    potentials = np.einsum("ij,jk->ik", near, other.current), np.einsum("ij,ik->jk", near, one.current)
    turned = [cross(one.current, potentials[0]), cross(other.current, potentials[1])]
    forces = np.concatenate([-pairs.sum(axis=1), pairs.sum(axis=0)])
    return Felt(forces, np.concatenate(turned), np.zeros((0, 3)), -float(alike.sum()))


def on_balls(magnets: Filaments, balls: Array, volume: Array, saturation: Array, uniform: Array) -> Felt:
    """What magnets and soft balls at (k, 3) m, of (k,) m^3 and (k,) T, do to each other, in a field (3,) T from far away besides."""
    moment, energy = magnetised(field(balls, magnets) + uniform, volume, saturation)
    way = balls[:, None] - magnets.at
    far = np.einsum("knj,knj->kn", way, way) + magnets.smeared**2
    near = SHARE / (far * np.sqrt(far))
    bent = cross(moment[:, None], magnets.current[None])
    along = 3 * np.einsum("knj,knj->kn", way, bent) / far
    each = near[..., None] * (bent - along[..., None] * way)
    potential = (near[..., None] * cross(moment[:, None], -way)).sum(axis=0)
    return Felt(-each.sum(axis=0), cross(magnets.current, potential), each.sum(axis=1), float(energy.sum()))
