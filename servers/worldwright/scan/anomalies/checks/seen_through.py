"""Two visible bodies pass through each other, and the engine never let them touch.

What it means: contact masks, an exclusion or disabled contacts keep them apart in the engine, while the picture shows one
inside the other. No contact is recorded, so penetration checks see nothing.

Formula: the recording's list of overlaps: the signed distance of visible geoms that cannot collide, at 24 instants; of a
foreign recording with its model beside it, at 96, less what overlaps equally all along.
Threshold: 2 mm, and 5 % of the smaller geom's radius (see `worldengine.recording.drawn_overlaps`), and what the plan lets
overlap (`topology.overlaps`). Blocking for a body of the plan, its parts included.
Source: the facts on staging (visible geoms that never collide).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ....model.recording.loads import Loads
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ...predicting.shown import overlaps
from ..declared import cast, drawn_only, hideable_m, overlap_m, weighs
from ..sign import Case, Context, Sign, SkipError
from ..wholes import head_names

CODE = "WS304"
STAGING = True
NEEDS = ("pos",)
THRESHOLD_M = 2e-3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each pair of bodies once, at its deepest."""
    names, told, head = cast(context), set(), head_names(trajectory)
    for seen in _overlaps(trajectory):
        pair = frozenset(seen["bodies"])
        if pair in told or any(drawn_only(context, trajectory.meta, n) for n in (*seen["bodies"], *seen["geoms"])):
            continue
        allowed = overlap_m(context, trajectory, *seen["bodies"])
        if allowed and seen["depth_m"] <= min(allowed, hideable_m(trajectory, seen["bodies"], seen["geoms"])):
            continue
        told.add(pair)
        mine = next((n for n in seen["bodies"] if n in names or head.get(n, n) in names), "")
        body = mine or max(reversed(seen["bodies"]), key=lambda n: _way(trajectory, n))
        one, other = seen["bodies"]
        declared = any(context.acts_on(n, ("parameter", "solver")) for n in pair)
        message = f"{one} and {other} overlap by {seen['depth_m']:.3g} m in plain sight: {seen['why']}"
        severity = weighs(context, declared, claimed=bool(mine))
        window = tuple(seen.get("window_s") or (seen["time_s"], seen["time_s"]))
        yield Sign(body, window, seen["depth_m"], THRESHOLD_M, "m", severity, message)


def _overlaps(trajectory: Trajectory) -> Sequence[dict[str, Any]]:
    if trajectory.loads is not None and trajectory.loads.overlaps is not None:
        return trajectory.loads.overlaps
    if trajectory.model is None:
        raise SkipError("neither a list of overlaps nor a model lies beside the recording")
    return overlaps(trajectory)


def _way(trajectory: Trajectory, name: str) -> float:
    """How far a body moves, m; 0 for the world."""
    if name not in trajectory.names:
        return -1.0
    return float(np.ptp(trajectory.pos[:, trajectory.names.index(name)], axis=0).max())


def carrying(overlaps: Sequence[dict[str, Any]] = (), **channels: Any) -> Loads:
    """Loads of a recording without constraints, as cases need them."""
    nothing = np.zeros((1, 0))
    given = {"eq_force": nothing, "eq_active": nothing.astype(bool), "tendon_force": nothing}
    given |= {"actuator_force": nothing, "ctrl": nothing}
    return Loads(**{**given, **channels}, overlaps=overlaps)


def _sunk(*overlaps: dict[str, Any]) -> Trajectory:
    return replace(analytic.resting(), loads=carrying(overlaps))


INSIDE = {"geoms": ["skin", "ground"], "bodies": ["body", "world"], "depth_m": 0.05, "time_s": 1.0, "why": "contype 0"}
GOOD = (lambda: Case("nothing overlaps", _sunk(), Context(planned=True, rests=("body",))),)
BAD = (lambda: Case("a body in the floor", _sunk(INSIDE), Context(planned=True, rests=("body",)), severity="blocking"),)
