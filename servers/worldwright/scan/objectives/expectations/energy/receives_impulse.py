"""A body receives an impulse from another through their contact.

Measures the integral of the contact force that the other puts on the body over the window, N s, along `direction` or in
size. A blow that is over in n rows is known to 0.4 / n of itself: where within a step it begins is chance (a ball thrown at
a wall, restitution 0 to 0.9, 3 to 24 rows: never more than 0.34 / n off the blow of a sixteenth of the step). A bound that
lies within that is neither met nor missed. A ball of mass m that rebounds with restitution e from v receives m v (1 + e). Source: the impulse-momentum theorem; the engine's contact forces.
"""

from math import ceil

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, falling, resting
from ....measuring.measured import (
    Measured,
    Name,
    OfBody,
    Point,
    UnknowableError,
    between,
    body_index,
    contacts_of,
    window,
)

CODE = "WE204"
EVENT = True
SOME, ENOUGH_ROWS = 0.1, 50
"""Rows above this share of the largest force are the blow; over so many rows it is known to a percent."""
CHANCE = 0.4
"""The uncertainty of a blow that is over in one row, as a share of it."""


class Given(OfBody):
    """The bodies, and the impulse to expect."""

    other: Name = Field(description="what pushes it; `ground` is the world")
    min_n_s: float | None = Field(None, gt=0, description="least impulse, N s")
    max_n_s: float | None = Field(None, gt=0, description="largest impulse, N s")
    direction: Point | None = Field(None, description="direction of the world [x, y, z]; without it the size counts")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.min_n_s is None and self.max_n_s is None:
            raise ValueError("give min_n_s, max_n_s or both")
        if self.direction is not None and not any(self.direction):
            raise ValueError("a direction needs a length: [0, 0, 0] points nowhere")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the impulse."""
    body = body_index(trajectory, given.body)
    contacts = trajectory.contacts
    if contacts is None or contacts.force is None:
        raise UnknowableError("no contact forces were recorded")
    rows = window(trajectory, given.window_s, 2)
    mine = contacts_of(trajectory, given.body, given.other) & (contacts.row >= rows.start) & (contacts.row < rows.stop)
    force = np.zeros((rows.stop - rows.start, 3))
    sign = np.where(contacts.body2[mine] == body, 1.0, -1.0)
    np.add.at(force, contacts.row[mine] - rows.start, contacts.force[mine] * sign[:, None])
    total = (force[:-1] * np.diff(trajectory.t[rows])[:, None]).sum(axis=0)
    if given.direction is None:
        value = float(np.linalg.norm(total))
    else:
        value = float(total @ np.array(given.direction) / np.linalg.norm(given.direction))
    size = np.sqrt((force**2).sum(axis=1))
    blow = int((size > SOME * size.max(initial=0.0)).sum()) if size.any() else 0
    message = f"{given.other} gives {given.body} an impulse of {value:.4g} N s"
    found = between(value, given.min_n_s, given.max_n_s, "N s", message)
    if not 0 < blow < ENOUGH_ROWS:
        return found
    doubt = CHANCE * abs(value) / blow
    message += f" (within {doubt:.2g} N s: its blow is over in {blow} recorded rows)"
    if abs(found.margin) < doubt:
        needed = min(ENOUGH_ROWS, ceil(CHANCE * abs(value) / max(abs(found.margin), 1e-12)))
        finer = trajectory.interval_s * blow / needed
        raise UnknowableError(
            f"{message}; {found.expected} lies within that",
            next_move=f"rows of {finer:.2g} s would decide (a smaller time_step, every step recorded), or a softer contact, "
            "or a bound further from what is measured",
        )
    return found._replace(message=message)


GOOD = (
    (
        lambda: resting(seconds=2.0),
        {"body": "body", "other": "ground", "direction": [0, 0, 1], "min_n_s": 1.99 * G, "max_n_s": 2.01 * G},
    ),
)
BAD = (
    (lambda: resting(seconds=2.0), {"body": "body", "other": "ground", "min_n_s": 2.1 * G}),
    (lambda: resting(seconds=2.0), {"body": "body", "other": "ground", "direction": [0, 0, -1], "min_n_s": 1}),
    (lambda: falling(touches=[]), {"body": "body", "other": "ground", "min_n_s": 0.1}),
)
