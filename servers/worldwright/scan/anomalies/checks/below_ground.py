"""A body is below the ground, or falls out of the world.

What it means: its contact with the ground is switched off or missing, or it went through it between two steps.

Formula: the centre of its bounding box is deeper than its bounding radius under the world's level ground plane (the
whole body is under); or its lowest point, by the shape of its geoms, has been deeper than half its half-thickness for
0.25 s (a quarter of it is under). Where no ground is known: it ends falling, 50 r and 5 m under everything's first position.
Threshold: the body's own size. Blocking with a known ground, else a warning.
Source: the manual on planes (a plane is infinite for collisions, whatever its drawn size).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey
from .sliding_as_rolling import shaped

CODE = "WS115"
RELATIVE = True
ABOVE_GROUND = True
SHOWN_AS = "height"
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that end up under everything."""
    ground, size = trajectory.mechanics.ground_z, trajectory.size_m
    height, lowest = trajectory.pos[:, :, 2], survey(trajectory).low[:, :, 2].min(axis=0)
    for b in np.flatnonzero(trajectory.moves_freely):
        name = trajectory.names[b]
        if ground is not None:
            if lowest[b] >= ground + size[b]:
                continue
            if height[0, b] < ground - size[b]:
                continue  # what starts below (in a cellar, in a pit) was put there
            if ground - lowest[b] - size[b] <= 0:
                yield from _half_under(trajectory, int(b), ground)
                continue
            under = ground - height[:, b] - size[b]
            start = int(np.argmax(under > 0))
            message = f"{name} goes through the ground, to {ground - height[:, b].min():.3g} m below it"
            window = (trajectory.t[start], trajectory.t[-1])
            severity = "warn" if _partly_solid(trajectory, int(b)) else "blocking"
            yield Sign(name, window, under.max() + size[b], size[b], "m", severity, message)
            continue
        limit = max(50 * size[b], 5.0)
        depth = height[0].min() - height[-1, b]
        if depth > limit and trajectory.linvel[-1, b, 2] < -trajectory.speed_scale[b]:
            start = int(np.argmax(height[0].min() - height[:, b] > limit))
            message = f"{name} ends falling, {depth:.3g} m below where anything started"
            yield Sign(name, (trajectory.t[start], trajectory.t[-1]), depth, limit, "m", "warn", message)


def _partly_solid(trajectory: Trajectory, b: int) -> bool:
    """Whether some of a body's geoms collide and others are only drawn: its feet then tell more than its box."""
    facts = trajectory.mechanics
    if facts.geom_body is None or facts.geom_collides is None or trajectory.interventions is not None:
        return False
    own = facts.geom_collides[facts.geom_body == b]
    return bool(own.any() and not own.all())


def _half_under(trajectory: Trajectory, b: int, ground: float) -> Iterator[Sign]:
    facts = trajectory.mechanics
    thick = facts.half_thickness()
    if thick is None or np.isnan(thick[b]):
        return
    rows = max(1, round(0.25 / trajectory.interval_s))
    close = trajectory.size_m[b] - 0.5 * thick[b]
    if survey(trajectory).low[:, b, 2].min() - ground >= close:
        return
    near = trajectory.pos[:, b, 2] - ground < close
    if near.sum() < rows:
        return
    lowest = lowest_point(trajectory, b, near)
    if lowest is None:
        return
    depth = np.full(len(near), -np.inf)
    depth[near] = ground - lowest
    for start, stop in spans(depth > 0.5 * thick[b]):
        if stop - start >= rows:
            name, deepest = trajectory.names[b], float(depth[start:stop].max())
            message = f"{name} is {deepest:.3g} m deep in the ground"
            window = (trajectory.t[start], trajectory.t[stop - 1])
            yield Sign(name, window, deepest, 0.5 * float(thick[b]), "m", "blocking", message)
            return


def lowest_point(trajectory: Trajectory, b: int, rows: np.ndarray) -> np.ndarray | None:
    """(N,) m: height of the lowest point of a body's colliding geoms at `rows` (a mask); None when a shape is not simple."""
    facts = trajectory.mechanics
    if facts.geom_pos is None or facts.geom_body is None or facts.geom_half_extents is None:
        return None
    assert facts.geom_collides is not None and facts.geom_quat is not None
    lowest: np.ndarray | None = None
    turn = matrices(trajectory.quat[rows, b])
    for g in np.flatnonzero((facts.geom_body == b) & facts.geom_collides):
        half, kind = facts.geom_half_extents[g], facts.geom_type[g]
        up = (turn @ matrices(facts.geom_quat[g]))[:, 2, :]  # world z in the geom's frame
        centre = trajectory.pos[rows, b, 2] + (turn @ facts.geom_pos[g])[:, 2]
        if kind == "box":
            reach = np.abs(up) @ half
        elif kind in ("sphere", "ellipsoid"):
            reach = np.sqrt(((up * half) ** 2).sum(axis=1))
        elif kind == "capsule":
            reach = half[0] + np.abs(up[:, 2]) * (half[2] - half[0])
        elif kind == "cylinder":
            reach = half[0] * np.sqrt(np.clip(1 - up[:, 2] ** 2, 0, 1)) + np.abs(up[:, 2]) * half[2]
        else:
            return None
        lowest = centre - reach if lowest is None else np.minimum(lowest, centre - reach)
    return lowest


def _no_ground() -> Case:
    fall = analytic.falling(seconds=2.0)
    made = replace(fall, mechanics=replace(fall.mechanics, ground_z=None))
    return Case("endless fall, ground unknown", made, severity="warn")


GOOD = (
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a fall that ends above the ground", analytic.falling(seconds=0.8)),
)


def _buried() -> Case:
    still = shaped(analytic.resting(), "box", 0.5)
    pos = still.pos.copy()
    pos[:, 0, 2] -= np.minimum(0.06 * still.t, 0.06)
    return Case("a box sunk to its middle", replace(still, pos=pos), severity="blocking")


BAD = (_buried, lambda: Case("a fall through the ground", analytic.falling(1.0, 1.0), severity="blocking"), _no_ground)
