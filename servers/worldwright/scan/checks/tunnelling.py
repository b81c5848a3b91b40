"""A body passes through another one, or through a part of the scene.

What it means: it was too fast for the step, the two do not collide (masks, an exclusion, geometry that is only drawn),
or a pose was written. Solid bodies cannot be on both sides of each other.

Formula: the path of a body's centre, in the frame of another geom (its box, or a plane's half space), goes from one side
of the box's thinnest axis to the other and crosses the middle plane inside the box, going on the same way from one face to the other . Pairs are looked at only where the bounding spheres of their ways overlap.
Threshold: none: the middle of a solid cannot be crossed. Blocking, also for geometry that is not set to collide.
Source: the manual on collision filtering, and on speculative contacts.
"""

import itertools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.mechanics import rotation
from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign

CODE = "WS120"
NEEDS = ("mechanics.geom_pos", "mechanics.half_extents", "mechanics.parent")
SOLID = frozenset({"box", "sphere", "capsule", "cylinder", "ellipsoid"})
ROWS, LAP = 48, 40


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each pair of which one passes through the other."""
    facts = trajectory.mechanics
    if (
        facts.geom_body is None
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
    near = _Neighbours(trajectory)
    for b in np.flatnonzero(trajectory.moves_freely):
        if not _is_solid(trajectory, int(b)):
            continue
        for g in solids:
            other = int(facts.geom_body[g])
            if other == b or (other >= 0 and family[other] == family[b]) or (other, int(b)) in seen:
                continue
            for rows in near.windows(int(b), g):
                n = _crossing(trajectory, int(b), g, rows)
                if n is None:
                    continue
                seen.add((int(b), other))
                name = trajectory.names[b]
                through = trajectory.names[other] if other >= 0 else facts.geom_names[g]
                severity = "info" if context.acts_on(name, ("pose",)) else "blocking"
                message = f"{name} passes through {through}"
                speed = float(trajectory.speed[n, b])
                window = (trajectory.t[n], trajectory.t[n + 1])
                yield Sign(name, window, speed, 0.0, "m/s", severity, message)
                break


def _families(parent: np.ndarray | None) -> np.ndarray:
    """(B,) the topmost body above each: within one mechanism parts may be drawn through each other."""
    assert parent is not None
    top = np.arange(len(parent))
    for b in range(len(parent)):
        while parent[top[b]] >= 0:
            top[b] = parent[top[b]]
    return top


def _meant(trajectory: Trajectory, g: int) -> bool:
    """Whether a geom stands for something solid: it collides, or nothing of its body does although it moves."""
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


class _Neighbours:
    """Stretches of time in which a body's way comes near a geom: a coarse search over boxes around the ways."""

    def __init__(self, trajectory: Trajectory) -> None:
        facts = trajectory.mechanics
        assert facts.half_extents is not None and facts.geom_body is not None
        assert facts.geom_pos is not None and facts.geom_half_extents is not None
        count = len(trajectory.t)
        edges = np.unique(np.append(np.arange(0, count, ROWS), count - 1))
        cores = [slice(int(a), int(z) + 1) for a, z in itertools.pairwise(edges)]
        # Parts overlap, so that a passage is not cut in two.
        self.parts = [slice(max(0, core.start - LAP), min(count, core.stop + LAP)) for core in cores]
        self.low = np.array([trajectory.pos[core].min(axis=0) for core in cores])
        self.high = np.array([trajectory.pos[core].max(axis=0) for core in cores])
        offset = facts.com if facts.com is not None else np.zeros((len(trajectory.names), 3))
        self.offset = np.sqrt((offset**2).sum(axis=1))
        self.facts = facts

    def windows(self, b: int, g: int) -> Iterator[slice]:
        """The parts to look at closely."""
        facts = self.facts
        assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_half_extents is not None
        other = int(facts.geom_body[g])
        # The centre of the one must come into the box of the other.
        size = float(np.sqrt((facts.geom_half_extents[g] ** 2).sum())) + float(self.offset[b])
        if other >= 0:
            low, high = self.low[:, other], self.high[:, other]
            size += float(np.sqrt((facts.geom_pos[g] ** 2).sum()))
        else:
            low = high = facts.geom_pos[g][None]
        apart = np.maximum(low - size - self.high[:, b], self.low[:, b] - high - size).max(axis=1)
        for k in np.flatnonzero(apart < 0):
            yield self.parts[int(k)]


def _crossing(trajectory: Trajectory, b: int, g: int, rows: slice) -> int | None:
    """The row before which the body's centre crosses the middle of the geom's box, or None."""
    facts = trajectory.mechanics
    assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_quat is not None
    assert facts.geom_half_extents is not None
    other = int(facts.geom_body[g])
    centre = trajectory.com[rows, b]
    if other >= 0:
        frame = rotation(trajectory.quat[rows, other])
        centre = np.einsum("tji,tj->ti", frame, centre - trajectory.pos[rows, other])
    local = (centre - facts.geom_pos[g]) @ rotation(facts.geom_quat[g])
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
