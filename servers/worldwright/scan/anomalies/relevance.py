"""A finding matters when a claim rests on it or a viewer can see it; otherwise it becomes a remark.

A claim rests on what its expectations and its cause name, and on whatever these touch, through however many others, before
the last of its effects is over: the rest of the world may do as it likes. Joints, ties and tendons join as a touch does. A
viewer sees what measures two pixels in one of the planned pictures, for two frames (`in_picture`).

Checks that want this set `RELATIVE`. Staging, and faults of the recording itself, always matter.
"""

from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from typing import NamedTuple

import numpy as np

from ...model.finding import Anomaly
from ...model.plan.committed import Plan
from ...model.plan.in_view import mentioned
from ...model.recording.trajectory import Trajectory
from ..objectives.claims import EXPECTATIONS
from .in_picture import seen
from .wholes import head_names

OF_LINKS = ("constraint_drift", "tendon_limit")
"""Checks whose finding names one end of what it is about, and whose message begins with the name of that."""


class Rests(NamedTuple):
    """A claim that rests on a body, and until when."""

    objective: int
    until_s: float


def weighed(anomalies: Iterable[Anomaly], trajectory: Trajectory, plan: Plan) -> Iterator[Anomaly]:
    """The findings: a blocking one names the claim or picture that it spoils; without one it becomes a remark."""
    listed = list(anomalies)
    if not any(a.severity == "blocking" for a in listed):
        yield from listed
        return
    resting = claimed(trajectory, plan)
    for anomaly in listed:
        if anomaly.severity != "blocking":
            yield anomaly
            continue
        held = _ends(anomaly, trajectory)
        names = held or {part for part in anomaly.body.replace(",", " ").split() if part != "and"}
        claim = next(
            (resting[n] for n in sorted(names) if n in resting and anomaly.window_s[0] <= resting[n].until_s), None
        )
        bodies = tuple(trajectory.names.index(name) for name in sorted(names) if name in trajectory.names)
        together: list[tuple[int, ...]] = [(b,) for b in bodies] if held else [bodies]
        if claim is not None:
            why = f"objective {claim.objective} rests on it"
        elif not bodies:
            yield anomaly  # it is about the world as a whole
            continue
        elif shown := next(filter(None, (seen(anomaly, one, trajectory, plan) for one in together)), None):
            why = str(shown)
        else:
            why = "no claim rests on it and no planned picture shows it"
            yield anomaly.model_copy(update={"severity": "info", "message": f"{anomaly.message}; {why}"})
            continue
        yield anomaly.model_copy(update={"message": f"{anomaly.message}; {why}"})


def _ends(anomaly: Anomaly, trajectory: Trajectory) -> set[str]:
    """All bodies that the tie or rope of a finding holds, any of which shows it; empty of any other finding."""
    links = (*trajectory.mechanics.ties, *trajectory.mechanics.ropes) if anomaly.name in OF_LINKS else ()
    told = [link for link in links if anomaly.message.startswith(f"{link.name} ")]
    return {trajectory.names[b] for link in told for b in link.bodies if b >= 0}


def claimed(trajectory: Trajectory, plan: Plan) -> dict[str, Rests]:
    """Bodies on which claims rest, each with the claim that does so longest."""
    from ..audits.moment import event_s
    from ..objectives.expecting import named

    found = dict[str, Rests]()
    end = float(trajectory.t[-1])
    for index, objective in enumerate(plan.objectives):
        until, names = 0.0, mentioned(objective.cause)
        for row in objective.expect:
            for name, given in row.items():
                names |= mentioned(given)
                event = name in EXPECTATIONS and EXPECTATIONS[name].EVENT
                moment = event_s(trajectory, name, named(given)) if event else None
                until = max(until, end if moment is None else moment)
        for b in _touched_bodies(trajectory, _named_bodies(trajectory, names), until):
            name = trajectory.names[b]
            if name not in found or found[name].until_s < until:
                found[name] = Rests(index, until)
    return found


def _named_bodies(trajectory: Trajectory, names: set[str]) -> set[int]:
    """Bodies that a claim means by these names: their own or their whole's, a pattern, a flex, what a part of theirs is called."""
    said = names | {b for flex, points in trajectory.flex_points.items() if flex in names for b in points}
    for kind in ("geoms", "joints", "tendons", "actuators", "equalities"):
        for row in trajectory.meta.get(kind) or ():
            if row.get("name") in names:
                said |= {str(row.get("body", "")), *row.get("bodies", ())}
    head, patterns = head_names(trajectory), [name for name in names if "*" in name or "?" in name]
    return {
        b
        for b, name in enumerate(trajectory.names)
        if not said.isdisjoint({name, head[name]}) or any(fnmatchcase(name, pattern) for pattern in patterns)
    }


def _touched_bodies(trajectory: Trajectory, start: set[int], until_s: float) -> set[int]:
    """Bodies that by then touch one of these, or one that does, and so on; what stands still passes nothing on."""
    pairs = _joined(trajectory)
    if (contacts := trajectory.contacts) is not None:
        early = trajectory.t[contacts.row] <= until_s
        touches = np.unique(np.stack([contacts.body1[early], contacts.body2[early]], axis=1), axis=0)
        pairs |= {(one, other) for one, other in touches.tolist()}
    beside: dict[int, set[int]] = {}
    for one, other in pairs:
        beside.setdefault(one, set()).add(other)
        beside.setdefault(other, set()).add(one)
    moves = np.maximum(*(np.ptp(way, axis=0).max(axis=1) for way in (trajectory.pos, trajectory.quat))) > 1e-6
    found, new = set(start), {b for b in start if moves[b] or trajectory.moves_freely[b]}
    while new:
        reached = {b for a in new for b in beside.get(a, ()) if b >= 0}
        found |= (fresh := reached - found)
        new = {b for b in fresh if moves[b]}
    return found


def _joined(trajectory: Trajectory) -> set[tuple[int, int]]:
    """Pairs of bodies that a joint, a tie or a tendon joins."""
    parent = trajectory.mechanics.parent
    found = set() if parent is None else {(b, int(above)) for b, above in enumerate(parent)}
    number = {name: b for b, name in enumerate(trajectory.names)}
    for kind in ("equalities", "tendons"):
        for row in trajectory.meta.get(kind) or ():
            ends = [number[name] for name in row.get("bodies") or () if name in number]
            found |= {(ends[0], other) for other in ends[1:]}
    return found
