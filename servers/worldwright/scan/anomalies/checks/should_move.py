"""A body that the plan expects to move does not.

What it means: the cause never reaches it (a gap, a missing joint, a fixed body, a recording too short), so whatever the
picture shows, the event did not happen.

Formula: the largest distance from its first position, and the largest turn from its first orientation.
Threshold: 2 % of the bounding radius and 2 degrees: less cannot be seen. Blocking: the plan lists the body under
`motion_expectations`. A part that is welded to another body moves as far as that carries it, and turns as it does; a flex
moves where one of its points does, and what breaks where one of its pieces does. A claim that less would hold is told of the plan
(`WP134`); how far a body gets, a rehearsal tells before the plan is approved.
Source: the reference paper's plan format, `motion_expectations`.
"""

from collections.abc import Iterator

import numpy as np

from ....model.recording.trajectory import Trajectory
from ....model.recording.travel import TURN_RAD, least_m, stays_put, travel
from ...known import analytic
from ..sign import Case, Context, Sign, SkipError

CODE = "WS111"
FROM_THE_START = True
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the expected movers that stay where they are."""
    if not context.movers:
        raise SkipError("no plan says which bodies move")
    whole = (trajectory.t[0], trajectory.t[-1])
    still = _whole_things_that_stay(trajectory, context)
    for name in context.movers:
        if name in still and not still[name]:
            continue
        if points := trajectory.flex_points.get(name):
            yield from _of_flex(trajectory, name, points)
            continue
        if name not in trajectory.names:
            message = f"the plan expects {name} to move, but the recording has no such body"
            yield Sign(name, whole, 0.0, 1.0, "bodies", "blocking", message)
            continue
        b = trajectory.names.index(name)
        if stays_put(trajectory, b):
            moved, turned = travel(trajectory, b)
            limit = least_m(trajectory, b)
            turns = f"{np.degrees(turned):.2g} degrees"
            message = f"the plan expects {name} to move, but it moves {moved:.3g} m and turns {turns}"
            message += f"; from {limit:.2g} m or {np.degrees(TURN_RAD):.0f} degrees on it counts as moving"
            yield Sign(name, whole, moved, limit, "m", "blocking", message)


def _whole_things_that_stay(trajectory: Trajectory, context: Context) -> dict[str, bool]:
    """Of each piece of what breaks, whether it is the one to tell of: none of all moves, and it is the first."""
    told: dict[str, bool] = {}
    for name in context.plan.broken if context.plan is not None else ():
        assert context.plan is not None
        pieces = [p for p in context.plan.families[name] if p in trajectory.names]
        moves = any(not stays_put(trajectory, trajectory.names.index(piece)) for piece in pieces)
        told |= {piece: not moves and piece == pieces[0] for piece in pieces}
    return told


def _of_flex(trajectory: Trajectory, name: str, points: tuple[str, ...]) -> Iterator[Sign]:
    """A sign where no point of a flex moves: a pinned edge stays, the rest hangs, swings or is squashed."""
    bodies = [trajectory.names.index(point) for point in points]
    if all(stays_put(trajectory, b) for b in bodies):
        moved = max(travel(trajectory, b)[0] for b in bodies)
        message = f"the plan expects {name} to move, but none of its {len(bodies)} points moves more than {moved:.3g} m"
        whole = (trajectory.t[0], trajectory.t[-1])
        yield Sign(name, whole, moved, max(least_m(trajectory, b) for b in bodies), "m", "blocking", message)


GOOD = (
    lambda: Case("a falling mover", analytic.falling(), Context(planned=True, movers=("body",))),
    lambda: Case("a mover that only turns", analytic.tilting(45.0), Context(planned=True, movers=("body",))),
)
BAD = (
    lambda: Case("a mover at rest", analytic.resting(), Context(planned=True, movers=("body",)), "blocking"),
    lambda: Case("a mover that is missing", analytic.falling(), Context(planned=True, movers=("hammer",)), "blocking"),
)
