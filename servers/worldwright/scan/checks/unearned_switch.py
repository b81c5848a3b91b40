"""A constraint lets go, or takes hold, without the threshold that the plan gives as its trigger being crossed then.

What it means: the plan says `load > 400 N`, and the recording shows that the load was below it at that moment, or had
passed it long before: a clock did it.

Formula: for a switch (`constraint` in the ledger) declared with a trigger `QUANTITY [of NAME] > NUMBER UNIT`, the recorded
quantity at the switch against the number, and the time since it first crossed it. Quantities: `load` (force of the
equality that is switched, N), `tension` (of a tendon, N), `contact force` (summed on a body, N), `speed` (m/s), `height`
(m), `distance` is not known.
Threshold: 2 % of the number; 20 ms, or three recorded rows, of delay. Blocking.
Source: the facts on staging (fasteners released at 3.0 and 5.2 s, although the load passed the threshold at 0.97 s).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.plan import Intervention
from ...model.trajectory import Trajectory
from ...model.trigger import Threshold, threshold
from .. import analytic
from ..sign import Case, Context, Sign
from .seen_through import carrying

CODE = "WS310"
NEEDS = ("loads", "interventions")
TOLERANCE, DELAY_S = 0.02, 0.02


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each switch that came too early or too late."""
    ledger, seen = trajectory.interventions, set()
    assert ledger is not None
    for time, kind, target, value in zip(ledger.time, ledger.kind, ledger.target, ledger.value, strict=True):
        name = str(target)
        if kind != "constraint" or name in seen:
            continue
        seen.add(name)
        asked = _declared(trajectory, context, name)
        history = measured(trajectory, asked, name) if asked else None
        if asked is None or history is None:
            continue
        now = max(0, int(np.searchsorted(trajectory.t, time - 1e-9)) - 1)  # the row before the switch took effect
        if asked.quantity == "load" and value[1] > 0:  # what it carried in the moment it was let go, which no row shows
            history = history.copy()
            history[min(now + 1, len(history) - 1)] = value[1]
        sign = 1.0 if asked.rising else -1.0
        beyond = sign * (history / asked.number - 1.0)
        clearly = np.flatnonzero(beyond[: now + 1] > TOLERANCE)
        said = f"{name} is switched at {time:.3f} s, though its {asked.quantity}"
        if not (beyond[: now + 2] >= -TOLERANCE).any():
            message = f"{said} is {history[now]:.4g}, not {'>' if asked.rising else '<'} {asked.number:g}"
            yield Sign(name, (time, time), float(history[now]), asked.number, asked.quantity, "blocking", message)
        elif len(clearly) and time - trajectory.t[clearly[0]] > max(DELAY_S, 3 * trajectory.interval_s):
            first = float(trajectory.t[clearly[0]])
            message = f"{said} passed {asked.number:g} at {first:.3f} s"
            yield Sign(name, (first, time), time - first, DELAY_S, "s", "blocking", message)


def measured(trajectory: Trajectory, asked: Threshold, switched: str) -> np.ndarray | None:
    """(T,) the quantity that a trigger looks at; None when the recording does not hold it."""
    loads, name = trajectory.loads, asked.name or switched
    if loads is None:
        return None
    if asked.quantity in ("load", "tension"):
        for key, forces in (("equalities", loads.eq_force), ("tendons", loads.tendon_force)):
            names = [row["name"] for row in trajectory.meta.get(key) or ()]
            if name in names and forces.shape[1] == len(names):
                return np.abs(forces[:, names.index(name)])
        if name != switched and asked.quantity == "load":
            return measured(trajectory, asked._replace(name=switched), switched)
        return None
    if name not in trajectory.names:
        return None
    body = trajectory.names.index(name)
    if asked.quantity == "speed":
        return trajectory.speed[:, body]
    if asked.quantity == "height":
        return trajectory.pos[:, body, 2]
    touches = trajectory.contacts
    if touches is None:
        return None
    members = trajectory.members(body)  # what touches a welded part touches the body
    mine = np.isin(touches.body1, members) | np.isin(touches.body2, members)
    return np.bincount(touches.row[mine], touches.normal_force[mine], minlength=len(trajectory.t))


def _declared(trajectory: Trajectory, context: Context, name: str) -> Threshold | None:
    """The threshold of the plan's row about a constraint (or about a body it holds)."""
    ties = {row["name"]: row.get("bodies") or () for row in trajectory.meta.get("equalities") or ()}
    for row in context.interventions:
        if row.kind == "constraint" and {name, *ties.get(name, ())}.intersection(row.bodies):
            return threshold(row.trigger)
    return None


def _fastener(release_s: float, trigger: str = "load > 5 N") -> Case:
    still = analytic.resting()
    load = 10.0 * still.t[:, None] / 2.0  # 5 N at 1 s
    switch = replace(analytic.pushed("constraint", "bolt", 1, 0.0), time=np.array([release_s]))
    moved = replace(
        still,
        interventions=switch,
        loads=carrying(eq_force=np.where(still.t[:, None] < release_s, load, 0.0)),
        meta={"equalities": [{"name": "bolt", "type": "weld", "bodies": ["body", "world"], "active": True}]},
    )
    row = Intervention(kind="constraint", bodies=("bolt",), law="it breaks", trigger=trigger, source="data sheet")
    return Case(f"let go at {release_s} s", moved, Context(planned=True, interventions=(row,)), severity=None)


GOOD = (
    lambda: _fastener(1.0),
    lambda: _fastener(1.6, "at t = 1.6 s"),
)
BAD = (
    lambda: replace(_fastener(1.6), severity="blocking"),
    lambda: replace(_fastener(0.5), severity="blocking"),
    lambda: replace(_fastener(1.6, "load on bolt exceeds 0.005 kN"), severity="blocking"),
)
