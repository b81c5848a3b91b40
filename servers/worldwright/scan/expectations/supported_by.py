"""At the end a body rests on another: in contact with it, and held up by it.

Measures the mean vertical force that the support puts on the body over the last tenth of a second, relative to the
body's weight. Source: static equilibrium; the engine's contact forces.
"""

import numpy as np
from pydantic import Field

from ...model.trajectory import Trajectory
from ..analytic import falling, resting
from ..measured import Measured, OfBody, UnknowableError, body_index

CODE = "WE114"


class Given(OfBody):
    """support: what carries it (`ground` is the world); min_share: of its weight that the support must carry."""

    support: str
    min_share: float = Field(default=0.3, gt=0)


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The share of its weight that the support carries."""
    body, support = body_index(trajectory, given.body), trajectory.index(given.support)
    contacts, mass = trajectory.contacts, trajectory.mechanics.mass
    if contacts is None or contacts.force is None or mass is None:
        raise UnknowableError("no contact forces or masses were recorded")
    rows = trajectory.rows(float(trajectory.t[-1]) - 0.1, None)
    chosen = contacts.of_pair(body, support) & (contacts.row >= rows.start) & (contacts.row < rows.stop)
    sign = np.where(contacts.body2[chosen] == body, 1.0, -1.0)
    lift = float((contacts.force[chosen, 2] * sign).sum()) / (rows.stop - rows.start)
    weight = float(mass[body] * np.linalg.norm(trajectory.gravity))
    share = lift / weight if weight > 0 else 0.0
    message = f"{given.support} carries {share:.0%} of the weight of {given.body} at the end"
    return Measured(share, f"at least {given.min_share:.0%}", share - given.min_share, "1", message)


GOOD = ((lambda: resting(), {"body": "body", "support": "ground"}),)
BAD = ((lambda: falling(seconds=0.3, touches=[]), {"body": "body", "support": "ground"}),)
