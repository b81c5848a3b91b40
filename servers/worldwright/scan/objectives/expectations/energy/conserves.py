"""A quantity of some bodies stays the same over a window, or is the same after a contact as before it.

momentum: sum of m v (a vector; the change is taken relative to the sum of |m v|). angular_momentum: about the bodies'
common centre of mass, or about `about`. energy: kinetic energy of translation and rotation plus m g h above the lowest
height in the window, relative to its largest value. `around_contact: [a, b]` compares the instants just before the two
first touch and just after they part. Source: conservation laws of Newtonian mechanics.
"""

from typing import Literal

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, falling, sliding
from ....known.motions import orbiting
from ....measuring.energetics import angular_momentum, mechanical, momentum
from ....measuring.measured import (
    Measured,
    Name,
    OfBodies,
    Point,
    Tolerance,
    UnknowableError,
    at_most,
    body_index,
    masses,
    pair_rows,
    window,
)

CODE = "WE109"
OF_MOVERS = False
LASTING = True


class Given(OfBodies):
    """The quantity, the tolerance, and the contact to compare around."""

    quantity: Literal["momentum", "angular_momentum", "energy"] = Field(description="what is conserved")
    tolerance: Tolerance = Field(description="allowed change, relative")
    around_contact: tuple[Name, Name] | None = Field(
        None, description="two bodies: compare before and after they touch"
    )
    about: Point | None = Field(None, description="for angular momentum: a fixed point [x, y, z], m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative change."""
    masses(trajectory)
    names = given.names or (given.around_contact or ())
    if not names:
        raise UnknowableError("no body is named", next_move="add `body: NAME` or `bodies: [NAME, …]`")
    bodies = [body_index(trajectory, name) for name in names]
    rows = np.arange(len(trajectory.t))[window(trajectory, given.window_s)]
    if given.around_contact:
        rows = _change_around_contact(trajectory, given.around_contact, rows)
    if given.quantity == "energy":
        energy = mechanical(trajectory, rows, bodies)
        scale, change = float(np.abs(energy).max()), float(np.abs(energy - energy[0]).max())
    else:
        if given.quantity == "momentum":
            each = momentum(trajectory, rows, bodies)
        else:
            each = angular_momentum(trajectory, rows, bodies, None if given.about is None else np.array(given.about))
        total = each.sum(axis=1)
        scale = float(np.linalg.norm(each, axis=2).sum(axis=1).max())
        change = float(np.linalg.norm(total - total[0], axis=1).max())
    relative = change / scale if scale > 0 else 0.0
    what = given.quantity.replace("_", " ")
    message = f"{what} of {', '.join(names)} changes by {relative:.2%}"
    span = f"between {trajectory.t[rows[0]]:.3f} and {trajectory.t[rows[-1]]:.3f} s"
    return at_most(relative, given.tolerance, "1", f"{message} {span}")


def _change_around_contact(trajectory: Trajectory, pair: tuple[str, str], rows: np.ndarray) -> np.ndarray:
    touching = rows[pair_rows(trajectory, *pair)[rows]]
    if not len(touching):
        raise UnknowableError(f"{' and '.join(pair)} never touch")
    gaps = np.flatnonzero(np.diff(touching) > 1)
    apart = touching[gaps[0]] if len(gaps) else touching[-1]
    return np.array([max(int(touching[0]) - 1, rows[0]), min(int(apart) + 1, rows[-1])])


GOOD = (
    (collision, {"quantity": "momentum", "bodies": ["a", "b"], "tolerance": 0.001, "around_contact": ["a", "b"]}),
    (lambda: falling(mass=[2.0]), {"quantity": "energy", "body": "body", "tolerance": 0.01}),
    (
        lambda: orbiting(eccentricity=0.5),
        {"quantity": "angular_momentum", "body": "body", "about": [0, 0, 1], "tolerance": 1e-6},
    ),
)
BAD = (
    (lambda: falling(mass=[2.0]), {"quantity": "momentum", "body": "body", "tolerance": 0.5}),
    (lambda: sliding(1.0, 0.5), {"quantity": "energy", "body": "body", "tolerance": 0.5}),
    (
        lambda: orbiting(eccentricity=0.5),
        {"quantity": "angular_momentum", "body": "body", "about": [1, 0, 1], "tolerance": 0.1},
    ),
)
