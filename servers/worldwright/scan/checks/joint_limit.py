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

from ...model.linkage import Joint
from ...model.mechanics import rotation
from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign, sliding_sum

CODE = "WS121"
NEEDS = ("mechanics.joints", "mechanics.parent")
SHARE, ANGLE_RAD, HELD_S = 0.05, np.radians(5.0), 0.05


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
        yield Sign(name, window, over.max(), limit, unit, "blocking", message)


def coordinate(trajectory: Trajectory, joint: Joint) -> np.ndarray:
    """(T,) rad or m from the reference pose."""
    parents = trajectory.mechanics.parent
    assert parents is not None
    parent = int(parents[joint.body])
    here = rotation(trajectory.quat[:, joint.body])
    above = rotation(trajectory.quat[:, parent]) if parent >= 0 else np.broadcast_to(np.eye(3), here.shape)
    base = trajectory.pos[:, parent] if parent >= 0 else np.zeros(3)
    home = rotation(joint.quat0)
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
