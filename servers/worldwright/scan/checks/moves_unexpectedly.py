"""A body moves that the plan does not expect to move.

What it means: it was placed unstably, is too light, was dragged along, or the plan forgot it. A body that the plan
fixes must never move at all.

Formula: the largest distance from its first position, against half of the bounding radius (a fixed body: 1e-6 of it).
Severity: blocking for a fixed body; otherwise a warning when it moves before anything that is expected to move has
touched it (or without any touch), else a remark: being hit is a reason to move.
Source: the reference paper's plan format, `motion_expectations`, `fixed`.
"""

from collections.abc import Iterator

import numpy as np

from ...model.finding import AnomalySeverity
from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign, SkipError

CODE = "WS112"
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that leave their places unasked."""
    if not context.movers and not context.fixed:
        raise SkipError("no plan says which bodies move")
    for b, name in enumerate(trajectory.names):
        fixed = name in context.fixed
        if not fixed and (name in context.movers or not context.movers or not trajectory.moves_freely[b]):
            continue
        away = np.sqrt(((trajectory.pos[:, b] - trajectory.pos[0, b]) ** 2).sum(axis=1))
        limit = (1e-6 if fixed else 0.5) * float(trajectory.size_m[b])
        if away.max() <= limit:
            continue
        start = int(np.argmax(away > limit))
        severity: AnomalySeverity
        if fixed:
            severity, why = "blocking", "although the plan fixes it"
        elif _was_hit(trajectory, context, b, start):
            severity, why = "info", "after being touched by what moves"
        else:
            severity, why = "warn", "although nothing that should move touched it and no step expects it"
        message = f"{name} moves {away.max():.3g} m, {why}"
        yield Sign(name, (trajectory.t[start], trajectory.t[-1]), away.max(), limit, "m", severity, message)


def _was_hit(trajectory: Trajectory, context: Context, b: int, row: int) -> bool:
    """Whether a chain of touches leads from an expected mover to the body before `row`."""
    contacts = trajectory.contacts
    if contacts is None:
        return True  # nobody recorded contacts, so nobody can say it was not
    early = contacts.take(contacts.live & (contacts.row <= row))
    reached = {trajectory.names.index(name) for name in context.movers if name in trajectory.names}
    links = {(int(i), int(j)) for i, j in zip(early.body1, early.body2, strict=True) if i >= 0 and j >= 0}
    grown = True
    while grown and b not in reached:
        found = {j for i, j in links if i in reached} | {i for i, j in links if j in reached}
        grown = not found <= reached
        reached |= found
    return b in reached


GOOD = (
    lambda: Case("only the mover moves", analytic.falling(), Context(planned=True, movers=("body",))),
    lambda: Case("a fixed body stays", analytic.resting(), Context(planned=True, fixed=("body",))),
)
BAD = (
    lambda: Case("a fixed body falls", analytic.falling(), Context(planned=True, fixed=("body",)), "blocking"),
    lambda: Case("another body falls", analytic.falling(), Context(planned=True, movers=("lamp",)), "warn"),
)
