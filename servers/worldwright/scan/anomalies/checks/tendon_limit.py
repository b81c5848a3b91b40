"""A rope is longer than it can be, or a rod is not as long as it is.

What it means: the limit of the tendon is too soft for its load, the step is too long, or a body was put beyond its reach.
A rope in the pictures that stretches by a tenth is rubber.

Formula: the way from site to site, less the upper limit of the tendon's range, or the lower limit less that way; where it wraps around a geom the way is
longer still. A limit is a spring: a jerk may carry it a little past.
Threshold: 2 % of the limit for at least 0.05 s warns, 5 % blocks.
Source: the manual on tendon limits, `range` and `solreflimit`.
"""

import itertools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.linkage import Rope
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum

CODE = "WS133"
RELATIVE = True
NEEDS = ("mechanics.ropes",)
WARN, BLOCK, HELD_S = 0.02, 0.05, 0.05


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the ropes that stretch."""
    rows = max(1, round(HELD_S / trajectory.interval_s))
    for rope in trajectory.mechanics.ropes:
        long = length(trajectory, rope)
        over = np.maximum(long - rope.longest_m, rope.shortest_m - long)
        if len(over) < rows:
            continue
        level = float((sliding_sum(over, rows) / rows).max())
        if level <= WARN * rope.longest_m:
            continue
        past = np.flatnonzero(over > WARN * rope.longest_m)
        window = (trajectory.t[past[0]], trajectory.t[past[-1]])
        severity = "blocking" if level > BLOCK * rope.longest_m else "warn"
        holder = next((trajectory.names[b] for b in reversed(rope.bodies) if b >= 0), "world")
        far = f"beyond the {rope.longest_m:.3g} m it may be long"
        if rope.shortest_m and rope.shortest_m - long[past[0]] > 0:
            far = f"below the {rope.shortest_m:.3g} m that it has to be long"
        message = f"{rope.name} is {level:.3g} m {far}"
        yield Sign(holder, window, level, WARN * rope.longest_m, "m", severity, message)


def length(trajectory: Trajectory, rope: Rope) -> np.ndarray:
    """(T,) m: the length of a rope from site to site."""
    way = [
        np.broadcast_to(point, (len(trajectory.t), 3))
        if body < 0
        else trajectory.pos[:, body] + matrices(trajectory.quat[:, body]) @ point
        for body, point in zip(rope.bodies, rope.points, strict=True)
    ]
    return np.asarray(sum(np.sqrt(((b - a) ** 2).sum(axis=1)) for a, b in itertools.pairwise(way)))


def _hung(stretch: float, short: float = 0.0) -> Case:
    swing = analytic.swinging()
    points = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    reach = float(length(swing, Rope("rope", (-1, 0), points, 1.0)).max())
    rope = Rope("rope", (-1, 0), points, reach / (1 + stretch), reach * short)
    facts = replace(swing.mechanics, ropes=(rope,))
    return Case(f"a rope stretched by {stretch:.0%}", replace(swing, mechanics=facts))


GOOD = (lambda: _hung(0.0), lambda: _hung(0.01))
BAD = (
    lambda: replace(_hung(0.03), severity="warn"),
    lambda: replace(_hung(0.2), severity="blocking"),
    lambda: replace(_hung(0.0, short=1.2), severity="blocking"),
)
