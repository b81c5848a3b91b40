"""A quantity of some bodies stays the same over a window, or is the same after a contact as before it.

momentum: sum of m v over the bodies (vector; the change is taken relative to the sum of |m v|). energy: their kinetic
energy of translation and rotation plus m g h, relative to its largest value in the window measured from the lowest
height. `around_contact: [a, b]` compares the instants just before the two first touch and just after they part.
Source: conservation laws of Newtonian mechanics.
"""

from typing import Literal

import numpy as np
from pydantic import Field

from ...model.mechanics import rotation
from ...model.trajectory import Trajectory
from ..analytic import collision, falling
from ..measured import Measured, OfBodies, UnknowableError, body_index, pair_rows, window

CODE = "WE109"


class Given(OfBodies):
    """quantity; tolerance: allowed relative change; window_s, or around_contact: two body names."""

    quantity: Literal["momentum", "energy"]
    tolerance: float = Field(gt=0)
    window_s: tuple[float, float] | None = None
    around_contact: tuple[str, str] | None = None


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The relative change."""
    mass = trajectory.mechanics.mass
    if mass is None:
        raise UnknowableError("the recording does not tell masses")
    names = given.names or (given.around_contact or ())
    if not names:
        raise UnknowableError("name the bodies")
    bodies = [body_index(trajectory, name) for name in names]
    rows = np.arange(len(trajectory.t))[window(trajectory, given.window_s)]
    if given.around_contact:
        touching = np.flatnonzero(pair_rows(trajectory, *given.around_contact))
        if not len(touching):
            raise UnknowableError(f"{' and '.join(given.around_contact)} never touch")
        apart = touching[np.flatnonzero(np.diff(touching) > 1)[:1]] if (np.diff(touching) > 1).any() else touching[-1:]
        rows = np.array([max(touching[0] - 1, 0), min(int(apart[0]) + 1, len(trajectory.t) - 1)])
    velocity = trajectory.com_velocity[rows][:, bodies]
    m = mass[bodies]
    if given.quantity == "momentum":
        total = np.einsum("b,tbi->ti", m, velocity)
        scale = np.einsum("b,tb->t", m, np.linalg.norm(velocity, axis=2)).max()
        change = float(np.linalg.norm(total - total[0], axis=1).max())
    else:
        energy = _energy(trajectory, rows, bodies, m, velocity)
        scale, change = float(np.ptp(energy) + np.abs(energy).max()), float(np.abs(energy - energy[0]).max())
        scale = float(np.abs(energy).max())
    relative = change / scale if scale > 0 else 0.0
    message = f"{given.quantity} of {', '.join(names)} changes by {relative:.2%}"
    span = f"between {trajectory.t[rows[0]]:.3f} and {trajectory.t[rows[-1]]:.3f} s"
    return Measured(relative, f"within {given.tolerance:.2%}", given.tolerance - relative, "1", f"{message} {span}")


def _energy(trajectory: Trajectory, rows: np.ndarray, bodies: list[int], m: np.ndarray, v: np.ndarray) -> np.ndarray:
    """(rows,) J: kinetic energy plus the potential above the lowest height in the window."""
    kinetic = 0.5 * np.einsum("b,tbi,tbi->t", m, v, v)
    facts = trajectory.mechanics
    if facts.inertia is not None:
        turn = rotation(trajectory.quat[rows][:, bodies])
        spin = np.einsum("tbji,tbj->tbi", turn, trajectory.angvel[rows][:, bodies])
        if facts.inertia_quat is not None:
            spin = np.einsum("bji,tbj->tbi", rotation(facts.inertia_quat[bodies]), spin)
        kinetic = kinetic + 0.5 * np.einsum("bi,tbi,tbi->t", facts.inertia[bodies], spin, spin)
    potential = -np.einsum("b,tbi,i->t", m, trajectory.com[rows][:, bodies], trajectory.gravity)
    return kinetic + potential - potential.min()


GOOD = (
    (collision, {"quantity": "momentum", "bodies": ["a", "b"], "tolerance": 0.001, "around_contact": ["a", "b"]}),
    (lambda: falling(mass=[2.0]), {"quantity": "energy", "body": "body", "tolerance": 0.01}),
)
BAD = ((lambda: falling(mass=[2.0]), {"quantity": "momentum", "body": "body", "tolerance": 0.5}),)
