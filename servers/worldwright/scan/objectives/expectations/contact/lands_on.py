"""A body in the air lands on a given body before it touches anything else.

Measures how much earlier its first touch with `support` comes than its first touch with anything else, seconds
(touching nothing else counts to the end of the window). Source: the engine's contacts.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, falling
from ....known.meetings import caught
from ....measuring.measured import Measured, Name, OfBody, UnknowableError, at_least, body_index, contacts_of, window

CODE = "WE147"
EVENT = True


class Given(OfBody):
    """The body, and what it lands on."""

    support: Name = Field(description="what it lands on; `ground` is the world")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure how much earlier it touches the support."""
    body = body_index(trajectory, given.body)
    contacts, touching = trajectory.contacts, trajectory.touching
    if contacts is None or touching is None:
        raise UnknowableError("no contacts were recorded")
    rows = window(trajectory, given.window_s, 2)
    t, end = trajectory.t, float(trajectory.t[rows.stop - 1])
    aloft = rows.start + int((~touching[rows, body]).argmax())
    if touching[aloft, body]:
        return at_least(-1e-9, 0.0, "s", f"{given.body} is never in the air")
    own = contacts.live & ((contacts.body1 == body) | (contacts.body2 == body))
    own &= (contacts.row >= aloft) & (contacts.row < rows.stop)
    row = contacts.row[own]
    right = contacts_of(trajectory, given.body, given.support)[own]
    if not right.any():
        return at_least(float(t[aloft]) - end - 1e-9, 0.0, "s", f"{given.body} never touches {given.support}")
    landed = float(t[row[right].min()])
    elsewhere = float(t[row[~right].min()]) if (~right).any() else end
    message = f"{given.body} lands on {given.support} at {landed:.3f} s"
    if elsewhere < landed:
        message += f", but touches something else at {elsewhere:.3f} s"
    return at_least(elsewhere - landed, 0.0, "s", message)


GOOD = (
    (lambda: bouncing(1.0, 0.8), {"body": "ball", "support": "ground"}),
    (caught, {"body": "ball", "support": "box"}),
)
BAD = (
    (caught, {"body": "ball", "support": "ground"}),
    (lambda: falling(touches=[]), {"body": "body", "support": "ground"}),
)
