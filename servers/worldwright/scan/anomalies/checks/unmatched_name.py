"""The recording has a body that the model beside it does not have.

What it means: the two are not of one world, a name was changed, or the recording holds something besides the simulation (a
camera's rig, a marker). Nothing but its poses can be judged; all the others are judged in full.

Formula: recorded names without a body of that name in the model; the world itself is none.
Threshold: none. A remark; a warning where the body moves.
Source: the interchange's definition, names are the model's.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS145"
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that the model does not know."""
    for name in trajectory.mechanics.unmatched:
        if name == "world":
            continue
        way = float(np.ptp(trajectory.pos[:, trajectory.names.index(name)], axis=0).max())
        message = f"{name} is not in the model beside the recording; only its poses are looked at"
        window = (trajectory.t[0], trajectory.t[-1])
        yield Sign(name, window, way, 0.0, "m", "warn" if way > 0 else "info", message)


def _named(*unmatched: str) -> Trajectory:
    made = analytic.resting()
    return replace(made, mechanics=replace(made.mechanics, unmatched=unmatched))


GOOD = (lambda: Case("every name is the model's", _named()),)
BAD = (lambda: Case("a body of another world", _named("body")),)
