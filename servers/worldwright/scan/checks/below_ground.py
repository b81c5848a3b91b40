"""A body is below the ground, or falls out of the world.

What it means: its contact with the ground is switched off or missing, or it went through it between two steps.

Formula: the centre of its bounding box is deeper than its bounding radius under the world's level ground plane (the
whole body is under). Where no ground is known: it ends falling, 50 r and 5 m under everything's first position.
Threshold: the body's own size. Blocking with a known ground, else a warning.
Source: the manual on planes (a plane is infinite for collisions, whatever its drawn size).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign

CODE = "WS115"
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that end up under everything."""
    ground, size = trajectory.mechanics.ground_z, trajectory.size_m
    height = trajectory.pos[:, :, 2]
    for b in np.flatnonzero(trajectory.moves_freely):
        name = trajectory.names[b]
        if ground is not None:
            under = ground - height[:, b] - size[b]
            if under.max() <= 0 or height[0, b] < ground - size[b]:
                continue  # what starts below (a cellar, a pit) was put there
            start = int(np.argmax(under > 0))
            message = f"{name} goes through the ground, to {ground - height[:, b].min():.3g} m below it"
            window = (trajectory.t[start], trajectory.t[-1])
            yield Sign(name, window, under.max() + size[b], size[b], "m", "blocking", message)
            continue
        limit = max(50 * size[b], 5.0)
        depth = height[0].min() - height[-1, b]
        if depth > limit and trajectory.linvel[-1, b, 2] < -trajectory.speed_scale[b]:
            start = int(np.argmax(height[0].min() - height[:, b] > limit))
            message = f"{name} ends falling, {depth:.3g} m below where anything started"
            yield Sign(name, (trajectory.t[start], trajectory.t[-1]), depth, limit, "m", "warn", message)


def _no_ground() -> Case:
    fall = analytic.falling(seconds=2.0)
    made = replace(fall, mechanics=replace(fall.mechanics, ground_z=None))
    return Case("endless fall, ground unknown", made, severity="warn")


GOOD = (
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a fall that ends above the ground", analytic.falling(seconds=0.8)),
)
BAD = (lambda: Case("a fall through the ground", analytic.falling(1.0, 1.0), severity="blocking"), _no_ground)
