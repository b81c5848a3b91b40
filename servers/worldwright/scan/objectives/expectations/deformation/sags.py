"""A row of parts sags: its lowest part hangs below the straight line between its ends.

Measures how far, vertically, at the end of the window (or at its deepest, with `ever`), metres. The first and the last
part in the recording's order are the ends. A simply supported beam under a load F in the middle sags by F l^3 / (48 E I).
Source: Euler-Bernoulli beam theory; the catenary.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import beam
from ....measuring.channels import OfParts, group
from ....measuring.measured import Measured, UnknowableError, at_least, window

CODE = "WE226"
EVENT = True


class Given(OfParts):
    """The row of parts, and the sag to reach."""

    min_m: float = Field(gt=0, description="least sag, m")
    ever: bool = Field(default=False, description="judge the deepest moment instead of the end")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the sag."""
    rows = window(trajectory, given.window_s)
    bodies = group(trajectory, given.parts)
    if len(bodies) < 3:
        raise UnknowableError("a row needs at least three parts", next_move="name more parts")
    path = trajectory.pos[rows][:, bodies]
    if not given.ever:
        path = path[-1:]
    flat = path[:, :, :2] - path[:, :1, :2]
    way = flat[:, -1:]
    length = (way**2).sum(axis=2)
    share = np.where(length > 0, (flat * way).sum(axis=2) / np.where(length > 0, length, 1), 0.5)
    chord = path[:, :1, 2] + share * (path[:, -1:, 2] - path[:, :1, 2])
    sag = float((chord - path[:, :, 2]).max())
    return at_least(sag, given.min_m, "m", f"{given.told()} sags by {sag:.4f} m")


GOOD = (
    (lambda: beam("keeps"), {"parts": "beam_*", "min_m": 0.0999}),
    (lambda: beam("returns"), {"parts": "beam_*", "min_m": 0.0999, "ever": True}),
)
BAD = (
    (lambda: beam("returns"), {"parts": "beam_*", "min_m": 0.01}),
    (lambda: beam("keeps", sag=-0.1), {"parts": "beam_*", "min_m": 0.01}),
)
