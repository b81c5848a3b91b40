"""At the end a body rests on another: in contact with it, and held up by it.

Measures the mean vertical force that the support puts on the body over the last tenth of a second, relative to the
body's weight. Source: static equilibrium; the engine's contact forces.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, resting
from ....known.standing import on_flex
from ....measuring.measured import Measured, Name, OfBody, UnknowableError, body_index, contacts_of, last_rows, window

CODE = "WE114"


class Given(OfBody):
    """The body, and what carries it."""

    support: Name = Field(description="what carries it; `ground` is the world")
    min_share: float = Field(default=0.3, gt=0, description="least share of its weight that the support carries")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share of its weight that the support carries."""
    body = body_index(trajectory, given.body)
    contacts, mass = trajectory.contacts, trajectory.mechanics.mass
    if contacts is None or contacts.force is None or mass is None:
        raise UnknowableError("no contact forces or masses were recorded")
    rows = last_rows(trajectory, window(trajectory, given.window_s), 0.1)
    chosen = (
        contacts_of(trajectory, given.body, given.support) & (contacts.row >= rows.start) & (contacts.row < rows.stop)
    )
    sign = np.where(contacts.body2[chosen] == body, 1.0, -1.0)
    lift = float((contacts.force[chosen, 2] * sign).sum()) / (rows.stop - rows.start)
    weight = float(mass[body] * np.linalg.norm(trajectory.gravity))
    share = lift / weight if weight > 0 else 0.0
    message = f"{given.support} carries {share:.0%} of the weight of {given.body} at the end"
    return Measured(share, f"at least {given.min_share:.0%}", share - given.min_share, "1", message)


GOOD = ((lambda: resting(), {"body": "body", "support": "ground"}),)
BAD = (
    (lambda: falling(seconds=0.3, touches=[]), {"body": "body", "support": "ground"}),
    (on_flex, {"body": "body", "support": "ground"}),
)
