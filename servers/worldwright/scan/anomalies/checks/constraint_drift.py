"""Two bodies that a weld or a connection holds together come apart while it still holds.

What it means: the constraint is too soft for its load, the step is too long, or two constraints contradict each other.
A connection that breaks is another thing: the gap is small until it breaks, and then the bodies part for good.

Formula: the distance of the two anchor points, less what it was at the start. Judged up to a break: the row at which the
recording switches it off or, where it does not say, the last row at which the gap was small and after which it only
grows, past the size of the smaller body.
Threshold: 5 % of the smaller body's bounding radius warns, 10 % blocks, for at least 0.05 s.
Source: the manual on equality constraints; Baumgarte, Stabilization of constraints (1972).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.linkage import Tie
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum

CODE = "WS122"
RELATIVE = True
NEEDS = ("mechanics.ties",)
WARN, BLOCK, HELD_S = 0.05, 0.1, 0.05


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the ties that drift."""
    rows = max(1, round(HELD_S / trajectory.interval_s))
    for tie in trajectory.mechanics.ties:
        gap = distance(trajectory, tie)
        size = min(float(trajectory.size_m[b]) for b in tie.bodies if b >= 0) if max(tie.bodies) >= 0 else 1.0
        off = _switched_off(trajectory, tie)
        held = _until_break(gap, size) if off is None else gap[:off]
        if len(held) < rows or not len(held):
            continue
        level = float((sliding_sum(held, rows) / rows).max())
        if level <= WARN * size:
            continue
        names = " and ".join(trajectory.names[b] if b >= 0 else "world" for b in tie.bodies)
        # A finding has one name: of the two bodies the one that gives way, which moves more.
        ends = [b for b in tie.bodies if b >= 0]
        name = trajectory.names[max(ends, key=lambda b: float(np.ptp(trajectory.pos[:, b], axis=0).max()))]
        posed = trajectory.mechanics.mocap is not None and any(trajectory.mechanics.mocap[b] for b in ends)
        past = np.flatnonzero(held > WARN * size)
        window = (trajectory.t[past[0]], trajectory.t[past[-1]])
        # A body that follows a posed one trails it: that is how following works.
        severity = "blocking" if level > BLOCK * size and not posed else "warn"
        message = f"{tie.name} lets {names} come {level:.3g} m apart while it holds them"
        yield Sign(name, window, level, WARN * size, "m", severity, message)


def distance(trajectory: Trajectory, tie: Tie) -> np.ndarray:
    """(T,) m: the distance of the anchors, less that at the start."""
    points = []
    for body, anchor in zip(tie.bodies, tie.anchors, strict=True):
        if body < 0:
            points.append(np.broadcast_to(anchor, (len(trajectory.t), 3)))
        else:
            points.append(trajectory.pos[:, body] + matrices(trajectory.quat[:, body]) @ anchor)
    apart = np.sqrt(((points[0] - points[1]) ** 2).sum(axis=1))
    return np.abs(apart - apart[0])


def _switched_off(trajectory: Trajectory, tie: Tie) -> int | None:
    """The first row at which the recording says that the tie does not hold; None when it does not say."""
    called = [str(row.get("name", "")) for row in trajectory.meta.get("equalities") or ()]
    if trajectory.loads is None or tie.name not in called:
        return None
    active = np.asarray(trajectory.loads.eq_active)[:, called.index(tie.name)].astype(bool)
    # The row before the switch already shows the step that strained it to breaking.
    return len(active) if active.all() else max(0, int(np.argmin(active)) - 1)


def _until_break(gap: np.ndarray, size: float) -> np.ndarray:
    """The gap, m, before the two part for good; all of it when they never do."""
    if gap[-1] < size:
        return gap
    small = np.flatnonzero(gap < BLOCK * size)
    last = int(small[-1]) + 1 if len(small) else 0
    apart = gap[last:]
    # Parting takes a few rows, a drift goes on for as long as the constraint gives way.
    quick = len(apart) and np.argmax(apart > size) <= max(3, 0.1 * len(gap))
    return gap[: max(0, last - 1)] if quick else gap


def _pulled(gap_m: np.ndarray) -> Case:
    t = analytic.clock(2.0)
    pos = np.zeros((len(t), 2, 3))
    pos[:, 1, 0] = 0.2 + gap_m
    vel = np.gradient(pos, t, axis=0)
    made = analytic.motion(t, pos, vel, names=("a", "b"), size_m=0.2, free=False, gravity=0.0)
    tie = Tie("weld", (0, 1), np.array([[0.1, 0, 0], [-0.1, 0, 0]]))
    return Case("two welded boxes", replace(made, mechanics=replace(made.mechanics, ties=(tie,))))


def _clock() -> np.ndarray:
    return analytic.clock(2.0)


GOOD = (
    lambda: _pulled(0 * _clock()),
    lambda: _pulled(np.where(_clock() < 1.0, 0.0, 5.0 * (_clock() - 1.0) ** 2 + 2 * np.maximum(_clock() - 1.0, 0))),
)
BAD = (
    lambda: replace(_pulled(0.06 * np.minimum(_clock(), 1.0)), severity="blocking"),
    lambda: replace(_pulled(0.015 * np.minimum(_clock(), 1.0)), severity="warn"),
)
