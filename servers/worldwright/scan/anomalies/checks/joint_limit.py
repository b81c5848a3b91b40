"""A joint is past its limit.

What it means: the limit is not enforced (switched off, too soft for the load, or its range in the wrong unit), or the
pose was written.

Formula: a hinge's angle is the turn about its axis from the reference pose, unwrapped over time; a slide's, the way along
it. The excess is how far it lies outside its range. A limit is a spring: a blow may carry a joint a little past it.
Threshold: 5 degrees or 5 % of the range (for slides 5 % of the range) for at least 0.05 s, or three times that at once.
Source: the manual on joint limits, `range` and `solreflimit`.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.linkage import Joint
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum, spans

CODE = "WS121"
RELATIVE = True
NEEDS = ("mechanics.joints", "mechanics.parent")
SHARE, ANGLE_RAD, HELD_S = 0.05, np.radians(5.0), 0.05
BOUNCE_S = 0.25


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the joints past their limits."""
    rows = max(1, round(HELD_S / trajectory.interval_s))
    for joint in trajectory.mechanics.joints:
        value = coordinate(trajectory, joint)
        over = np.maximum(np.maximum(joint.low - value, value - joint.high), 0.0)
        limit = SHARE * (joint.high - joint.low)
        if joint.kind == "hinge":
            limit = max(limit, ANGLE_RAD)
        lasting = len(over) >= rows and (sliding_sum(over, rows) / rows).max() > limit
        if not (lasting or over.max() > 3 * limit):
            continue
        past = np.flatnonzero(over > limit)
        name, unit = trajectory.names[joint.body], "rad" if joint.kind == "hinge" else "m"
        message = f"joint {joint.name} of {name} is {over.max():.3g} {unit} past its range"
        window = (trajectory.t[past[0]], trajectory.t[past[-1]])
        # A stop is a spring: a joint that hits it hard goes past it and comes back.
        longest = max(trajectory.t[stop - 1] - trajectory.t[start] for start, stop in spans(over > limit))
        bounced = longest < BOUNCE_S and (over.max() < 3 * limit or _fast(trajectory, joint, past))
        yield Sign(name, window, over.max(), limit, unit, "warn" if bounced else "blocking", message)


def _fast(trajectory: Trajectory, joint: Joint, past: np.ndarray) -> bool:
    """Whether the body reached its stop at a speed that counts."""
    before = slice(max(0, past[0] - 3), past[0] + 2)
    rate = trajectory.speed[before, joint.body] + trajectory.spin[before, joint.body] * trajectory.size_m[joint.body]
    return bool(rate.max() > trajectory.speed_scale[joint.body])


def coordinate(trajectory: Trajectory, joint: Joint) -> np.ndarray:
    """(T,) rad or m: the joint's coordinate, from the reference pose."""
    parents = trajectory.mechanics.parent
    assert parents is not None
    parent = int(parents[joint.body])
    here = matrices(trajectory.quat[:, joint.body])
    above = matrices(trajectory.quat[:, parent]) if parent >= 0 else np.broadcast_to(np.eye(3), here.shape)
    base = trajectory.pos[:, parent] if parent >= 0 else np.zeros(3)
    home = matrices(joint.quat0)
    if joint.kind == "slide":
        moved = np.einsum("tji,tj->ti", above, trajectory.pos[:, joint.body] - base) - joint.pos0
        return moved @ (home @ joint.axis)
    turn = np.einsum(
        "ji,tkj,tkl->til", home, above, here
    )  # home^T above^T here: the turn in the body's reference frame
    cosine = (np.trace(turn, axis1=1, axis2=2) - 1) / 2
    axial = np.stack(
        [turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1
    )
    return np.unwrap(np.arctan2(axial @ joint.axis / 2, cosine))


def _door(angle_deg: float) -> Trajectory:
    still = analytic.tilting(angle_deg)
    joint = Joint("h", 0, "hinge", np.array([0.0, 1.0, 0.0]), -0.5, 0.5, np.zeros(3), np.array([1.0, 0, 0, 0]))
    return replace(still, mechanics=replace(still.mechanics, joints=(joint,)))


GOOD = (
    lambda: Case("a door within its range", _door(25.0)),
    lambda: Case("a door that strikes its stop softly", _door(31.0)),
)
BAD = (lambda: Case("a door 30 degrees past its stop", _door(58.6), severity="blocking"),)
