"""Energy and momentum of some bodies over some rows, from their masses, inertias and velocities.

Source: rigid-body mechanics: T = m v^2 / 2 + w I w / 2, V = -m g x, P = sum m v, L = sum (r x m v + I w).
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from worldkit.turning import matrices

from ...model.recording.trajectory import Trajectory
from .measured import masses

Array = np.ndarray
Rows = Any
"""A slice, or (R,) row numbers."""


def kinetic(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array:
    """(R, len(bodies)) J: kinetic energy of translation and rotation."""
    m = masses(trajectory)[list(bodies)]
    v = trajectory.com_velocity[rows][:, bodies]
    found = 0.5 * m * np.einsum("tbi,tbi->tb", v, v)
    spin = _own_spin(trajectory, rows, bodies)
    if spin is not None and trajectory.mechanics.inertia is not None:
        found = found + 0.5 * np.einsum("bi,tbi,tbi->tb", trajectory.mechanics.inertia[list(bodies)], spin, spin)
    return found


def potential(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array:
    """(R, len(bodies)) J: potential energy of weight, from z = 0 of the world."""
    m = masses(trajectory)[list(bodies)]
    return -m * (trajectory.com[rows][:, bodies] @ trajectory.gravity)


def mechanical(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array:
    """(R,) J: kinetic energy plus the potential of weight above its lowest value in these rows."""
    height = potential(trajectory, rows, bodies).sum(axis=1)
    return kinetic(trajectory, rows, bodies).sum(axis=1) + height - height.min()


def momentum(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array:
    """(R, len(bodies), 3) kg·m/s: linear momentum, world frame."""
    return masses(trajectory)[list(bodies)][:, None] * trajectory.com_velocity[rows][:, bodies]


def angular_momentum(trajectory: Trajectory, rows: Rows, bodies: Sequence[int], about: Array | None = None) -> Array:
    """(R, len(bodies), 3) kg·m^2/s: angular momentum about a fixed point, or about the bodies' common centre of mass."""
    m = masses(trajectory)[list(bodies)]
    com, linear = trajectory.com[rows][:, bodies], momentum(trajectory, rows, bodies)
    if about is None:
        middle = np.einsum("b,tbi->ti", m, com) / m.sum()
        speed = linear.sum(axis=1) / m.sum()
        arm = com - middle[:, None]
        linear = linear - m[:, None] * speed[:, None]
    else:
        arm = com - about
    found = np.cross(arm, linear)
    spin, inertia = _own_spin(trajectory, rows, bodies), trajectory.mechanics.inertia
    if spin is not None and inertia is not None:
        frame = _frame(trajectory, rows, bodies)
        found = found + np.einsum("tbij,tbj->tbi", frame, inertia[list(bodies)] * spin)
    return found


def _frame(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array:
    """(R, b, 3, 3) principal axes of inertia in the world."""
    turn = matrices(trajectory.quat[rows][:, bodies])
    own = trajectory.mechanics.inertia_quat
    return turn if own is None else np.einsum("tbij,bjk->tbik", turn, matrices(own[list(bodies)]))


def _own_spin(trajectory: Trajectory, rows: Rows, bodies: Sequence[int]) -> Array | None:
    """(R, b, 3) rad/s: angular velocity along the principal axes; None when the inertia is not known."""
    if trajectory.mechanics.inertia is None:
        return None
    return np.einsum("tbji,tbj->tbi", _frame(trajectory, rows, bodies), trajectory.angvel[rows][:, bodies])
