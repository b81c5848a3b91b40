"""A body passes through another one, or through a part of the scene.

What it means: it was too fast for the step, the two do not collide (masks, an exclusion, geometry that is only drawn),
or a pose was written. Solid bodies cannot be on both sides of each other.

Formula: the path of a body's centre, in the frame of another geom (its box, or a plane's half space), goes from one side
of the box's thinnest axis to the other and crosses the middle plane inside the box, going the same way from one face to
the other. Pairs are looked at only where the bounding spheres of their ways overlap.
Threshold: none: the middle of a solid cannot be crossed. Blocking, also for geometry that is not set to collide.
Source: the manual on collision filtering, and on speculative contacts.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS120"
SHOWN_AS = "position"
NEEDS = ("mechanics.geom_pos", "mechanics.half_extents", "mechanics.parent")
Array = np.ndarray
SOLID = frozenset({"box", "sphere", "capsule", "cylinder", "ellipsoid"})
LAP = 40
"""So many rows before and after are looked at, so that a passage is seen from face to face."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each pair of which one passes through the other."""
    facts = trajectory.mechanics
    if (
        len(trajectory.t) < 2
        or facts.geom_body is None
        or facts.geom_pos is None
        or facts.geom_half_extents is None
        or facts.half_extents is None
    ):
        return
    family = _families(facts.parent)
    solids = [
        g
        for g, kind in enumerate(facts.geom_type)
        if kind in SOLID and _meant(trajectory, g) and np.all(np.isfinite(facts.geom_half_extents[g]))
    ]
    seen: set[tuple[int, int]] = set()
    near = _Neighbours(trajectory, solids)
    other_of = facts.geom_body[np.asarray(solids, dtype=int)]
    for b in np.flatnonzero(trajectory.moves_freely):
        if not _is_solid(trajectory, int(b)):
            continue
        room = float(facts.half_extents[b].max()) if _hollow(trajectory, int(b)) else 0.0
        close = near.near(int(b)) & (other_of != b)
        for k in np.flatnonzero(close.any(axis=0)):
            g, other = solids[k], int(other_of[k])
            if (other >= 0 and family[other] == family[b]) or (other, int(b)) in seen:
                continue
            if facts.geom_half_extents[g].max() < room:
                continue  # small enough for the cavity that the centre of a hollow body lies in
            for rows in near.windows(int(b), int(k), close[:, k]):
                n = _crossing(trajectory, int(b), g, rows)
                if n is None:
                    continue
                seen.add((int(b), other))
                name = trajectory.names[b]
                through = trajectory.names[other] if other >= 0 else facts.geom_names[g]
                # Bodies that press against each other may slip round an edge from one row to the next.
                pressed = other >= 0 and _both_pressed(trajectory, int(b), other, n)
                severity = "info" if context.acts_on(name, ("pose",)) else "warn" if pressed else "blocking"
                message = f"{name} passes through {through}"
                speed = float(trajectory.speed[n, b])
                window = (trajectory.t[n], trajectory.t[n + 1])
                yield Sign(name, window, speed, 0.0, "m/s", severity, message)
                break


def _both_pressed(trajectory: Trajectory, b: int, other: int, n: int) -> bool:
    """Whether both touch something near the crossing and lose a good part of their speed: then they hit and did not pass."""
    touching = trajectory.touching
    if touching is None or trajectory.contacts is not None:
        return False
    rows = slice(max(0, n - 1), n + 3)
    relative = np.sqrt(((trajectory.linvel[rows, b] - trajectory.linvel[rows, other]) ** 2).sum(axis=1))
    return bool(touching[rows, b].any() and touching[rows, other].any() and relative[-1] < 0.7 * relative[0])


def _families(parent: np.ndarray | None) -> np.ndarray:
    """(B,) the topmost body above each: parts of one mechanism may be drawn through each other."""
    assert parent is not None
    top = np.arange(len(parent))
    for b in range(len(parent)):
        while parent[top[b]] >= 0:
            top[b] = parent[top[b]]
    return top


def _meant(trajectory: Trajectory, g: int) -> bool:
    """Whether a geom stands for something solid: it collides, or its body moves and nothing of it collides."""
    facts = trajectory.mechanics
    assert facts.geom_collides is not None and facts.geom_body is not None
    if facts.geom_collides[g]:
        return True
    body = int(facts.geom_body[g])
    if body < 0 or facts.free is None or not facts.free[body]:
        return False
    if facts.visual_only is not None and facts.visual_only[body]:
        return False
    return not facts.geom_collides[facts.geom_body == body].any()


def _is_solid(trajectory: Trajectory, b: int) -> bool:
    facts = trajectory.mechanics
    assert facts.geom_body is not None
    return any(_meant(trajectory, int(g)) for g in np.flatnonzero(facts.geom_body == b))


def _hollow(trajectory: Trajectory, b: int) -> bool:
    """Whether the centre of a body's mass lies in none of its geoms: in a ring, a bowl or a pipe other things may be there."""
    facts = trajectory.mechanics
    assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_half_extents is not None
    own = np.flatnonzero(facts.geom_body == b)
    if facts.com is None or facts.geom_quat is None or len(own) < 2:
        return False
    away = facts.com[b] - facts.geom_pos[own]
    local = np.einsum("gji,gj->gi", matrices(facts.geom_quat[own]), away)
    half = facts.geom_half_extents[own]
    collides = facts.geom_collides[own] if facts.geom_collides is not None else np.ones(len(own), dtype=bool)
    return bool(collides.any() and not (np.abs(local) <= half).all(axis=1)[collides].any())


class _Neighbours:
    """Stretches of time in which a body's centre may come into the middle of a geom's box."""

    def __init__(self, trajectory: Trajectory, solids: list[int]) -> None:
        facts = trajectory.mechanics
        assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_half_extents is not None
        self.trajectory, self.look = trajectory, survey(trajectory)
        self.solids = np.asarray(solids, dtype=int)
        self.body = facts.geom_body[self.solids]
        half, offset = facts.geom_half_extents[self.solids], np.sqrt((facts.geom_pos[self.solids] ** 2).sum(axis=1))
        # A path that crosses the middle plane inside nine tenths of the box comes this near to the box's centre.
        across = np.sqrt((half**2).sum(axis=1) - half.min(axis=1) ** 2)
        self.reach = across + np.where(self.body >= 0, offset, 0.0)
        com = facts.com if facts.com is not None else np.zeros((len(trajectory.names), 3))
        self.offset = np.sqrt((com**2).sum(axis=1))
        fixed = facts.geom_pos[self.solids]
        moving = np.maximum(self.body, 0)
        self.low = np.where((self.body >= 0)[:, None], self.look.low[:, moving], fixed)
        self.high = np.where((self.body >= 0)[:, None], self.look.high[:, moving], fixed)

    def near(self, b: int) -> Array:
        """(K, G) bool: stretches in which the boxes around the two paths are near enough."""
        gap = np.maximum(self.low - self.look.high[:, b, None], self.look.low[:, b, None] - self.high)
        way = np.minimum(np.maximum(gap, 0.0), 1e100)
        close = np.asarray((way**2).sum(axis=2) < (self.reach + self.offset[b]) ** 2)
        for k in np.flatnonzero((self.body < 0) & close.any(axis=0)):
            close[:, k] &= self._through_middle(b, int(k))
        return close

    def _through_middle(self, b: int, k: int) -> Array:
        """(K,) bool: stretches in which the box around a path meets the middle plane of a fixed geom, inside its box."""
        facts, g = self.trajectory.mechanics, int(self.solids[k])
        assert facts.geom_pos is not None and facts.geom_quat is not None and facts.geom_half_extents is not None
        turn, half = matrices(facts.geom_quat[g]), facts.geom_half_extents[g].copy()
        half[np.argmin(half)] = 0.0
        middle = ((self.look.low[:, b] + self.look.high[:, b]) / 2 - facts.geom_pos[g]) @ turn
        # A stretch ends one row before its last step does; that step is no longer than what this allows for.
        slack = self.offset[b] + 2 * self.trajectory.interval_s * self.look.speed[:, b, None]
        around = (self.look.high[:, b] - self.look.low[:, b]) / 2 @ np.abs(turn)
        return np.asarray((np.abs(middle) <= half + around + slack).all(axis=1))

    def windows(self, b: int, k: int, stretches: Array) -> Iterator[slice]:
        """The rows to look at closely, for the k-th solid, within the stretches (K,) that are near."""
        count, rows = len(self.trajectory.t), self.look.rows
        for first, last in spans(stretches):
            start, stop = max(0, first * rows - LAP), min(count, last * rows + LAP)
            if self.body[k] < 0:
                yield slice(start, stop)
                continue
            between = self.trajectory.com[start:stop, b] - self.trajectory.pos[start:stop, self.body[k]]
            distance = np.sqrt((between**2).sum(axis=1))
            step = np.abs(np.diff(distance, append=distance[-1:]))
            close = distance < self.reach[k] + step.max(initial=0.0)
            for begin, end in spans(close, bridge=2 * LAP):
                yield slice(max(start, start + begin - LAP), min(stop, start + end + LAP))


def _crossing(trajectory: Trajectory, b: int, g: int, rows: slice) -> int | None:
    """The row before which the body's centre crosses the middle of the geom's box, or None."""
    facts = trajectory.mechanics
    assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_quat is not None
    assert facts.geom_half_extents is not None
    other = int(facts.geom_body[g])
    centre = trajectory.com[rows, b]
    if other >= 0:
        frame = matrices(trajectory.quat[rows, other])
        centre = np.einsum("tji,tj->ti", frame, centre - trajectory.pos[rows, other])
    local = (centre - facts.geom_pos[g]) @ matrices(facts.geom_quat[g])
    half = facts.geom_half_extents[g]
    k = int(np.argmin(half))
    z = local[:, k]
    flips = np.flatnonzero((z[:-1] < 0) != (z[1:] < 0))
    across = [axis for axis in range(3) if axis != k]
    for n in flips:
        share = z[n] / (z[n] - z[n + 1])
        point = local[n] + share * (local[n + 1] - local[n])
        if not np.all(np.abs(point[across]) < 0.9 * half[across]):
            continue
        first, last = n, n + 1
        while first > 0 and abs(z[first]) < half[k]:
            first -= 1
        while last < len(z) - 1 and abs(z[last]) < half[k]:
            last += 1
        way = np.diff(z[first : last + 1]) * (z[n + 1] - z[n])
        if abs(z[first]) >= half[k] and abs(z[last]) >= half[k] and np.all(way > 0):
            return int(rows.start + n)
    return None


def _through(bounces: bool) -> Case:
    t = analytic.clock(1.0)
    x = -1.0 + 2.0 * t
    v = np.full_like(t, 2.0)
    if bounces:
        hit = t > 0.4
        x, v = np.where(hit, -0.2 - 2.0 * (t - 0.4), x), np.where(hit, -2.0, v)
    zero = np.zeros_like(t)
    touch: list[analytic.Touch] = [(-1, 0, np.abs(t - 0.4) < 0.003, 1e-4, 500.0)] if bounces else []
    path, speed = np.stack([x, zero, zero + 1], axis=1), np.stack([v, zero, zero], axis=1)
    made = analytic.motion(t, path, speed, gravity=0.0, touches=touch)
    facts = replace(
        made.mechanics,
        geom_names=("body", "wall"),
        geom_body=np.array([0, -1]),
        geom_type=("sphere", "box"),
        geom_pos=np.array([[0.0, 0, 0], [0.0, 0, 1.0]]),
        geom_quat=np.tile((1.0, 0, 0, 0), (2, 1)),
        geom_half_extents=np.array([[0.05, 0.05, 0.05], [0.02, 1.0, 1.0]]),
        geom_collides=np.array([True, True]),
    )
    return Case("a ball and a wall", replace(made, mechanics=facts))


GOOD = (lambda: _through(True),)
BAD = (lambda: replace(_through(False), severity="blocking"),)
