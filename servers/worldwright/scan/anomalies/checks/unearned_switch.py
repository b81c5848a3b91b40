"""A constraint lets go, or takes hold, without the threshold that the plan gives as its trigger being crossed then.

What it means: the plan says `load > 400 N`, and the recording shows that the load was below it at that moment, or had
passed it long before: a clock did it. A force or control that waits for `height of crate > 5 m` acts, and the crate never
was that high. What acts `while hand touches box` does so when they do not touch.

Formula: for a switch (`constraint` in the ledger) declared with a trigger `QUANTITY [of NAME] > NUMBER UNIT`, the recorded
quantity at the switch against the number, and the time since it first crossed it. A crack is faster than a step, and what breaks
loads the others: where a bond's stress was above the number, others of the same `breaks` row may go in that instant that share a
piece with such a bond, or carried a tenth of the number themselves, or a fiftieth next to a piece of such a bond.
Quantities: `load` (force of the equality that is switched, N), `stress` (of a bond that is switched, Pa), `tension` (of a
tendon, N), `contact force` (summed on a body, N), `speed` (m/s), `height` (m), `distance` is not known. `while A touches B`:
the time from each entry of the ledger that is not nil to their nearest contact, before or after.
Threshold: 2 % of the number (of one unit where it is nil); 20 ms, or three recorded rows, of delay. Blocking.
Source: the facts on staging (fasteners released at 3.0 and 5.2 s, although the load passed the threshold at 0.97 s). Of 278 bonds
that `worldkit.breaking` let go in four panes, 8 shared no piece with one above its strength; each carried over a quarter of it. In
a fifth one did that carried a seventeenth: splinters next to it, whose bonds with it had broken before, struck it in that step.
"""

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.errors import NotFoundError
from ....model.plan.committed import Intervention
from ....model.plan.trigger import Threshold, threshold, touching
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from .seen_through import carrying

CODE = "WS310"
STAGING = True
NEEDS = ("loads", "interventions")
TOLERANCE, DELAY_S, LOADED, LOADED_BESIDE = 0.02, 0.02, 0.1, 0.02
PIECE = re.compile(r".+_\d+")


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each switch that came too early or too late."""
    yield from _other_acts(trajectory, context)
    yield from _apart(trajectory, context)
    ledger, seen = trajectory.interventions, set()
    assert ledger is not None
    pieces = _pieces(trajectory, context)
    earned: dict[tuple[float, str], set[str]] = {}
    early: list[tuple[float, Sign, float]] = []
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
        carried = value[{"load": 1, "stress": 2}.get(asked.quantity, 0)]
        if asked.quantity in ("load", "stress") and carried > 0:  # when it was let go, which no row shows
            history = history.copy()
            history[min(now + 1, len(history) - 1)] = carried
        beyond = _beyond(history, asked)
        clearly = np.flatnonzero(beyond[: now + 1] > TOLERANCE)
        said = f"{name} is switched at {time:.3f} s, though its {asked.quantity}"
        if not (beyond[: now + 2] >= -TOLERANCE).any():
            was = max(float(history[now]), float(carried)) if asked.rising else float(history[now])
            message = f"{said} is {was:.4g}, not {'>' if asked.rising else '<'} {asked.number:g}"
            found = Sign(name, (time, time), was, asked.number, asked.quantity, "blocking", message)
            early.append((time, found, float(carried) / asked.number if asked.number else 0.0))
        elif len(clearly) and time - trajectory.t[clearly[0]] > max(DELAY_S, 3 * trajectory.interval_s):
            first = float(trajectory.t[clearly[0]])
            message = f"{said} passed {asked.number:g} at {first:.3f} s"
            yield Sign(name, (first, time), time - first, DELAY_S, "s", "blocking", message)
        elif asked.quantity == "stress":
            thing, held = pieces.get(name, (name, set()))
            earned.setdefault((time, thing), set()).update(held)
    for time, early_sign, share in early:
        thing, held = pieces.get(early_sign.body, ("", set()))
        cracked = earned.get((time, thing), set()) if early_sign.unit == "stress" else set()
        beside = {piece for of, ends in pieces.values() if of == thing and ends & cracked for piece in ends}
        if not cracked or not (cracked & held or share >= (LOADED_BESIDE if beside & held else LOADED)):
            yield early_sign


def _beyond(history: np.ndarray, asked: Threshold) -> np.ndarray:
    """(T,) how far a quantity is past the number, as a share of it; in its own unit where the number is nil."""
    past: np.ndarray = (1.0 if asked.rising else -1.0) * (history - asked.number) / (abs(asked.number) or 1.0)
    return past


def _pieces(trajectory: Trajectory, context: Context) -> dict[str, tuple[str, set[str]]]:
    """By a bond's name the thing that it is of, and the pieces of that which it holds; what holds the thing is none of them.

    The plan says what breaks into which pieces; where there is none, they are told by their names, `pane_1` to `pane_48`.
    """
    broken = {} if context.plan is None else context.plan.broken
    things = {piece: name for name, row in broken.items() for piece in row.instances}
    found = {}
    for row in trajectory.meta.get("equalities") or ():
        ends = row.get("bodies") or ()
        if context.plan is None:
            things |= {end: end.rpartition("_")[0] for end in ends if PIECE.fullmatch(end)}
        if of := [things[end] for end in ends if end in things][:1]:
            found[row["name"]] = (of[0], {end for end in ends if things.get(end) == of[0]})
    return found


def _other_acts(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Find pushes, controls and other acts that wait for something in the world and act although it never came."""
    ledger = trajectory.interventions
    assert ledger is not None
    rows = list(zip(ledger.time, ledger.kind, ledger.target, strict=True))
    for row in context.interventions:
        asked = None if row.kind == "constraint" else threshold(row.trigger)
        history = measured(trajectory, asked, row.bodies[0]) if asked else None
        if asked is None or history is None:
            continue
        own = Context(interventions=(row,))
        acts = [float(time) for time, kind, target in rows if kind == row.kind and own.declares(str(kind), str(target))]
        if not acts:
            continue
        now = max(0, int(np.searchsorted(trajectory.t, acts[0] - 1e-9)) - 1)
        if not (_beyond(history[: now + 2], asked) >= -TOLERANCE).any():
            sign = ">" if asked.rising else "<"
            message = (
                f"the {row.kind} on {row.bodies[0]} acts at {acts[0]:.3f} s, though the {asked.quantity} it waits for is "
                f"{history[now]:.4g}, not {sign} {asked.number:g}"
            )
            window = (acts[0], acts[0])
            yield Sign(row.bodies[0], window, float(history[now]), asked.number, asked.quantity, "blocking", message)


def _apart(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """What acts while two things touch, and does so although they do not."""
    ledger, contacts = trajectory.interventions, trajectory.contacts
    assert ledger is not None
    for row in context.interventions:
        pair = touching(row.trigger)
        if pair is None or contacts is None:
            continue
        try:
            one, other = (trajectory.members(trajectory.index(name)) for name in pair)
        except NotFoundError:
            continue  # the linter names what the plan does not have
        mine = np.isin(contacts.body1, one) & np.isin(contacts.body2, other)
        mine |= np.isin(contacts.body1, other) & np.isin(contacts.body2, one)
        met = np.unique(trajectory.t[contacts.row[mine & contacts.live]])
        own = Context(interventions=(row,))
        acts = np.array(
            [
                float(time)
                for time, kind, target, value in zip(ledger.time, ledger.kind, ledger.target, ledger.value, strict=True)
                if kind == row.kind and np.any(value) and own.declares(str(kind), str(target))
            ]
        )
        late = max(DELAY_S, 3 * trajectory.interval_s)
        for time in acts:
            at = int(np.searchsorted(met, time))
            away = float(np.abs(met[max(0, at - 1) : at + 1] - time).min(initial=np.inf))
            if away > late:
                when = "never touch" if not len(met) else f"touch {away:.3f} s before or after"
                message = f"the {row.kind} on {row.bodies[0]} acts at {time:.3f} s, though {' and '.join(pair)} {when}"
                far = min(away, float(trajectory.duration_s) + late)
                yield Sign(row.bodies[0], (float(time), float(time)), far, late, "s", "blocking", message)
                break


def measured(trajectory: Trajectory, asked: Threshold, switched: str) -> np.ndarray | None:
    """(T,) the quantity of a trigger, in its unit; None when the recording does not hold it."""
    loads, name = trajectory.loads, asked.name or switched
    if loads is None:
        return None
    if asked.quantity in ("load", "stress", "tension"):
        ties = loads.eq_stress if asked.quantity == "stress" else loads.eq_force
        for key, forces in (("equalities", ties), ("tendons", loads.tendon_force)):
            if forces is None:
                continue
            names = [row["name"] for row in trajectory.meta.get(key) or ()]
            if name in names and forces.shape[1] == len(names):
                return np.abs(forces[:, names.index(name)])
        if name != switched and asked.quantity in ("load", "stress"):
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


def _crack(stress_pa: float, other: str = "a_2/a_3", other_pa: float = 0.0, frame: str = "", third: str = "") -> Case:
    """Two bonds go at 1 s: one above 40 MPa, or so much, the `other` under `other_pa`; a `frame` holds its last piece and `a_1`, and a
    `third` bond holds.
    """
    case = _fastener(1.0, "stress > 40 MPa")
    still, row = case.trajectory, case.context.interventions[0]
    assert still.loads is not None
    one = analytic.pushed("constraint", "a_1/a_2", 1, 0.0)
    values = np.zeros((2, one.value.shape[1]))
    values[:, 2] = stress_pa, other_pa
    both = replace(
        one,
        time=np.array([1.0, 1.0]),
        kind=("constraint", "constraint"),
        target=("a_1/a_2", other),
        value=values,
        work_j=np.zeros(2),
    )
    holds = (f"a_1/{frame}", f"{other.partition('/')[2]}/{frame}") if frame else ()
    names = ("a_1/a_2", other, *holds, *([third] if third else []))
    none = np.zeros((len(still.t), len(names)))
    ties = [{"name": name, "type": "weld", "bodies": name.split("/"), "active": True} for name in names]
    loads = replace(carrying(eq_force=none), eq_stress=none)
    moved = replace(still, interventions=both, loads=loads, meta={"equalities": ties})
    own = row.model_copy(update={"bodies": tuple({end for name in names[:2] for end in name.split("/")})})
    said = f"a crack at {stress_pa:g} Pa, and {other} goes at {other_pa:g} Pa"
    return Case(said, moved, Context(planned=True, interventions=(own,)))


def _push(trigger: str) -> Case:
    still = analytic.resting()
    moved = replace(still, interventions=analytic.pushed(), loads=carrying(eq_force=np.zeros((len(still.t), 0))))
    row = Intervention(kind="force", bodies=("body",), law="5 N along +x", trigger=trigger, source="the prompt")
    return Case(f"pushed, {trigger}", moved, Context(planned=True, interventions=(row,)), severity=None)


def _held(trigger: str, until_s: float) -> Case:
    """A push at 0.1 s on a body that lies on the ground until then, and is in the air afterwards."""
    made = _push(trigger)
    still = made.trajectory
    assert still.contacts is not None
    kept = still.contacts.take(still.t[still.contacts.row] < until_s)
    return replace(made, trajectory=replace(still, contacts=kept))


GOOD = (
    lambda: _held("while body touches ground", 2.0),
    lambda: _push("height of body < 5 m"),
    lambda: _fastener(0.002, "load > 0 N"),
    lambda: _fastener(1.0),
    lambda: _crack(4.5e7),
    lambda: _crack(4.5e7, "a_3/a_4", 1e7),
    lambda: _crack(4.5e7, "a_3/a_4", 2e6, third="a_2/a_3"),
    lambda: _fastener(1.6, "at t = 1.6 s"),
)
BAD = (
    lambda: replace(_crack(2e7), severity="blocking"),
    lambda: replace(_crack(4.5e7, "a_3/a_4"), severity="blocking"),
    lambda: replace(_crack(4.5e7, "a_3/a_4", 2e6), severity="blocking"),
    lambda: replace(_crack(4.5e7, "a_3/a_4", third="a_2/a_3"), severity="blocking"),
    lambda: replace(_crack(4.5e7, "b_1/b_2", 1e7, "frame"), severity="blocking"),
    lambda: replace(_held("while body touches ground", 0.05), severity="blocking"),
    lambda: replace(_push("height of body > 5 m"), severity="blocking"),
    lambda: replace(_push("height of body < 0 m"), severity="blocking"),
    lambda: replace(_fastener(1.6, "load > 0 N"), severity="blocking"),
    lambda: replace(_fastener(1.6), severity="blocking"),
    lambda: replace(_fastener(0.5), severity="blocking"),
    lambda: replace(_fastener(1.6, "load on bolt exceeds 0.005 kN"), severity="blocking"),
)
