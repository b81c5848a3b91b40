"""A body moves that the plan does not expect to move.

What it means: it was placed unstably, is too light, was dragged along, or the plan forgot it. A body that the plan
fixes must never move at all. A part is expected to move where the body that it is welded to is, and the other way round.

Formula: the largest distance from its first position, against half of the bounding radius (a fixed body: 1e-6 of it).
Severity: blocking for a fixed body; otherwise a warning when it moves before anything that is expected to move has
touched it (or without any touch), else a remark: being hit is a reason to move. A flex is one thing, not its points: it
moves where their mean does, against half of its reach; what touches it is not recorded by name, so that is a remark.
Source: the reference paper's plan format, `motion_expectations`, `fixed`.
"""

from collections.abc import Collection, Iterator

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.plan.imported import all_of, is_sculpt
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, SkipError
from ..wholes import asked_of_wholes, assembled

CODE = "WS112"
RELATIVE = True
FROM_THE_START = True
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that leave their places unasked."""
    if not context.movers and not context.fixed:
        raise SkipError("no plan says which bodies move")
    for b in (trajectory.names.index(name) for name in context.fixed if name in trajectory.names):
        yield from _moves(trajectory, b, 1e-6 * float(trajectory.size_m[b]), "blocking", "although the plan fixes it")
    asked, whole = asked_of_wholes(context, trajectory), assembled(trajectory)
    carried = _carried(context, asked.movers, whole.names)
    soft = {point for points in trajectory.flex_points.values() for point in points}
    if context.movers:
        yield from _flexes(trajectory, context)
    for b, name in enumerate(whole.names):
        if (
            not context.movers
            or name in soft
            or name in context.fixed
            or name in asked.movers
            or name in carried
            or not whole.moves_freely[b]
        ):
            continue
        limit = 0.5 * float(whole.size_m[b])
        away = _away(whole, b)
        if away.max() <= limit:
            continue
        if _was_hit(whole, asked, b, int(np.argmax(away > limit))):
            yield from _moves(whole, b, limit, "info", "after being touched by what moves")
        else:
            why = "although nothing that should move touched it and no step expects it"
            yield from _moves(whole, b, limit, "warn", why)


def _carried(context: Context, movers: Collection[str], names: Collection[str]) -> set[str]:
    """What models, vehicles and sculptures that are expected to move bring along; a sculpture's parts are known by their names alone."""
    plan = context.plan
    if plan is None:
        return set()
    found = {body for instance, _, facts in all_of(plan) if instance in movers for body in facts.bodies}
    shaped = tuple(f"{i}_" for row in plan.assets if is_sculpt(row) for i in row.instances if i in movers)
    own = {i for row in (*plan.scene_objects, *plan.assets) for i in row.instances}
    return found | {name for name in names if name.startswith(shaped) and name not in own}


def _flexes(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """A remark on each flex that leaves its place as a whole and that no step expects to move."""
    for name, points in trajectory.flex_points.items():
        if not points or name in context.movers or set(points) & set(context.movers):
            continue
        pos = trajectory.pos[:, [trajectory.names.index(point) for point in points]]
        middle = pos.mean(axis=1)
        limit = 0.5 * float(np.sqrt(((pos[0] - middle[0]) ** 2).sum(axis=1)).max())
        away = np.sqrt(((middle - middle[0]) ** 2).sum(axis=1))
        if away.max() > limit:
            window = (trajectory.t[int(np.argmax(away > limit))], trajectory.t[-1])
            message = (
                f"{name}, a flex of {len(points)} points, moves {away.max():.3g} m as a whole, and no step expects it"
            )
            yield Sign(name, window, away.max(), limit, "m", "info", message)


def _away(trajectory: Trajectory, b: int) -> np.ndarray:
    """(T,) m: the distance of a body from its first position."""
    return np.sqrt(((trajectory.pos[:, b] - trajectory.pos[0, b]) ** 2).sum(axis=1))


def _moves(trajectory: Trajectory, b: int, limit: float, severity: AnomalySeverity, why: str) -> Iterator[Sign]:
    away, name = _away(trajectory, b), trajectory.names[b]
    if away.max() > limit:
        window = (trajectory.t[int(np.argmax(away > limit))], trajectory.t[-1])
        yield Sign(name, window, away.max(), limit, "m", severity, f"{name} moves {away.max():.3g} m, {why}")


def _was_hit(trajectory: Trajectory, context: Context, b: int, row: int) -> bool:
    """Whether a chain of touches leads from an expected mover to the body before `row`."""
    contacts = trajectory.contacts
    if contacts is None:
        return True  # without recorded contacts nobody can say that it was not
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
