"""Two bodies never touch.

Measures how many recorded rows hold a contact between them that pushes or overlaps. Source: the engine's contacts.
"""

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, falling
from ....measuring.measured import Measured, OfPair, pair_rows, window

CODE = "WE106"
LASTING = True


class Given(OfPair):
    """The two bodies."""


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of rows in contact."""
    part = window(trajectory, given.window_s)
    touching = pair_rows(trajectory, *given.bodies)[part]
    rows = int(touching.sum())
    pair = " and ".join(given.bodies)
    message = f"{pair} touch at {trajectory.t[part][touching.argmax()]:.3f} s" if rows else f"{pair} never touch"
    return Measured(rows, "no row in contact", -rows if rows else 1, "rows", message)


GOOD = ((lambda: falling(seconds=0.3, touches=[]), {"bodies": ["body", "ground"]}),)
BAD = ((collision, {"bodies": ["a", "b"]}),)
