"""A temperature is at absolute zero, or below it.

What it means: a solver beside the engine was told to take heat where none is left, such as by a source below 0 that never ends.
There is no such state, and whatever follows from it, in what touches it too, is nothing that happens.

Formula: T <= 0 K, or no number at all, of every channel `temperature` in K of a solver, body by body.
Threshold: none. Blocking.
Source: the third law of thermodynamics (Nernst).
"""

from collections.abc import Iterator

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ...known.warming import cooling
from ..sign import Case, Context, Sign

CODE = "WS148"
NEEDS = ("t",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body whose temperature comes there, with the coldest it is."""
    beside = trajectory.beside
    for name, values in beside.values.items():
        solver, _, channel = name.rpartition(".")
        if channel != "temperature" or beside.units.get(name) != "K":
            continue
        for body, own in zip(beside.bodies[solver], values.T, strict=True):
            if not len(cold := np.flatnonzero(~(own > 0))):
                continue
            first = float(trajectory.t[cold[0]])
            message = f"{body} has {own.min():.4g} K: {name} falls to absolute zero at {first:.3f} s"
            yield Sign(body, (first, float(trajectory.t[cold[-1]])), float(own.min()), 0.0, "K", "blocking", message)


GOOD = (
    lambda: Case("a body that cools towards space", cooling(300.0, 2.7)),
    lambda: Case("a world without heat", analytic.resting()),
)
BAD = (
    lambda: Case("a body that cools to what there is not", cooling(300.0, -20.0), severity="blocking"),
    lambda: Case("a body whose temperature is no number", cooling(float("nan"), 20.0), severity="blocking"),
    lambda: Case("a body that begins at 0 K", cooling(0.0, 20.0), severity="blocking"),
)
