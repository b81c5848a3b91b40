"""Two bodies touch at some moment.

Measures how many recorded rows hold a contact between them that pushes or overlaps. Source: the engine's contacts.
"""

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, falling, resting
from ....known.standing import on_flex
from ....measuring.measured import Measured, OfPair, pair_rows, window

CODE = "WE105"
EVENT = True


class Given(OfPair):
    """The two bodies."""


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of rows in contact."""
    part = window(trajectory, given.window_s)
    touching = pair_rows(trajectory, *given.bodies)[part]
    rows = int(touching.sum())
    pair = " and ".join(given.bodies)
    message = f"{pair} first touch at {trajectory.t[part][touching.argmax()]:.3f} s" if rows else f"{pair} never touch"
    return Measured(rows, "at least 1 row in contact", rows - 1 if rows else -1, "rows", message)


GOOD = ((collision, {"bodies": ["a", "b"]}), (resting, {"bodies": ["body", "ground"]}))
BAD = (
    (lambda: falling(seconds=0.3, touches=[]), {"bodies": ["body", "ground"]}),
    (on_flex, {"bodies": ["body", "ground"]}),
)
