"""A body that the plan expects to move does not.

What it means: the cause never reaches it (a gap, a missing joint, a fixed body, a recording too short), so whatever the
picture shows, the event did not happen.

Formula: the largest distance from its first position, and the largest turn from its first orientation.
Threshold: 2 % of the bounding radius and 2 degrees: less cannot be seen. Blocking: the plan lists the body under
`motion_expectations`.
Source: the reference paper's plan format, `motion_expectations`.
"""

from collections.abc import Iterator

import numpy as np

from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign, SkipError

CODE = "WS111"
NEEDS = ("pos",)
SIZE_FRACTION = 0.02
TURN_RAD = np.radians(2.0)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the expected movers that stay where they are."""
    if not context.movers:
        raise SkipError("no plan says which bodies move")
    whole = (trajectory.t[0], trajectory.t[-1])
    for name in context.movers:
        if name not in trajectory.names:
            message = f"the plan expects {name} to move, but the recording has no such body"
            yield Sign(name, whole, 0.0, 1.0, "bodies", "blocking", message)
            continue
        b = trajectory.names.index(name)
        moved, turned = travel(trajectory, b)
        limit = SIZE_FRACTION * float(trajectory.size_m[b])
        if moved < limit and turned < TURN_RAD:
            turns = f"{np.degrees(turned):.2g} degrees"
            message = f"the plan expects {name} to move, but it moves {moved:.3g} m and turns {turns}"
            yield Sign(name, whole, moved, limit, "m", "blocking", message)


def travel(trajectory: Trajectory, b: int) -> tuple[float, float]:
    """How far a body gets from its first position (m) and orientation (rad)."""
    away = trajectory.pos[:, b] - trajectory.pos[0, b]
    cosine = np.abs(trajectory.quat[:, b] @ trajectory.quat[0, b])
    return float(np.sqrt((away**2).sum(axis=1)).max()), float(2 * np.arccos(np.clip(cosine.min(), 0.0, 1.0)))


GOOD = (
    lambda: Case("a falling mover", analytic.falling(), Context(planned=True, movers=("body",))),
    lambda: Case("a mover that only turns", analytic.tilting(45.0), Context(planned=True, movers=("body",))),
)
BAD = (
    lambda: Case("a mover at rest", analytic.resting(), Context(planned=True, movers=("body",)), "blocking"),
    lambda: Case("a mover that is missing", analytic.falling(), Context(planned=True, movers=("hammer",)), "blocking"),
)
