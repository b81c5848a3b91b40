"""Nothing sinks into anything by more than so much.

Measures the deepest contact of the whole recording, metres. A soft contact dips in by about its impact speed times its
time constant. Source: the engine's contacts.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....measuring.measured import Arguments, Measured, UnknowableError

CODE = "WE113"
OF_MOVERS = False
LASTING = True


class Given(Arguments):
    """The depth that is allowed."""

    max_m: float = Field(gt=0, description="deepest contact allowed, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the deepest contact."""
    contacts = trajectory.contacts
    if contacts is None and trajectory.max_penetration is None:
        raise UnknowableError("no contacts were recorded")
    if contacts is None:
        deepest, who = float(np.max(trajectory.max_penetration)), "the deepest contact"
    elif not len(contacts.depth_m):
        deepest, who = 0.0, "nothing touches; the deepest contact"
    else:
        index = int(contacts.depth_m.argmax())
        names = [trajectory.names[b] if b >= 0 else "ground" for b in (contacts.body1[index], contacts.body2[index])]
        deepest, who = max(float(contacts.depth_m[index]), 0.0), f"{names[0]} in {names[1]}"
        who += f" at {trajectory.t[contacts.row[index]]:.3f} s"
    message = f"{who}: {deepest * 1000:.2f} mm"
    return Measured(deepest, f"at most {given.max_m * 1000:g} mm", given.max_m - deepest, "m", message)


GOOD = ((resting, {"max_m": 0.001}),)
BAD = ((resting, {"max_m": 1e-6}),)
