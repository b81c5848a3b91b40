"""What acts is not what the plan says acts: a stronger push than its law, a push before its time, another gravity.

What it means: an exception was declared so that it passes, and something else was done. Readers of the report read the
declaration; what is done must be what they read.

Formula: for a declared force, torque or velocity whose law states a number in that kind's unit, the largest magnitude in
the ledger against the first number stated, or the greater end of a range (kN and mN·m converted); velocities that are
given again and again are added up over a second. A law `along +X` against the direction of all that acts, summed; a law
that brakes or resists against the work done. The forces and torques of an author's own law (`solver` with a `file`) are
held to its row in the same way; of several bodies, one must go along its axis. A torque of which its row says nothing is held
to the force that it states, times how far its points ever are from the body. A control that the plan gives as a number
against the controls sent, and a motor of the plan, by what it exerts, against the number of its law in N or N·m (with the
word `constant`, at every instant). A force, torque or motor whose law says `constant` or `steady`, against the
time for which its trigger lets it act. What a vehicle's brakes and drive exert, and how it steers, against the plan's timed `inputs`. For a trigger that is a time (`at t = 2 s`, `from 1 s to 1.5 s`), the first act against the
earliest time stated and, where two are stated, the last act against the latest. The recording's gravity, and gravity written while it runs, against the plan's or
the law's m/s^2.
Threshold: 5 % and 1e-6 of the number; 20 ms, or three recorded rows, of time; a cosine of 0.7; 0.02 m/s^2 of gravity
(9.80665 or 9.81). Blocking.
Source: the architecture's "Interventions are recorded".
"""

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.plan import law_words
from ....model.plan.committed import Intervention, Plan, SimulationParameters, Topology
from ....model.plan.declaration import owner
from ....model.plan.declared_inputs import Beside
from ....model.plan.drives import Actuator
from ....model.recording.records import Interventions
from ....model.recording.shown_points import Lay, ShownPoints
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import kept_up, sent_inputs
from ..declared import times
from ..sign import Case, Context, Sign

CODE = "WS317"
STAGING = True
NEEDS = ("pos",)
SHARE, DELAY_S, GRAVITY, ASTRAY = 0.05, 0.02, 0.02, 0.7
INSTANTS = 64
"""At which is looked how far the points of a law are from its bodies."""
EACH = re.compile(r"\b(each|every|per)\b", re.IGNORECASE)
LAWS = {
    "gravity": ("gravity", "m/s^2"),
    "wind": ("velocity", "m/s"),
    "density": ("density", "kg/m^3"),
    "viscosity": ("viscosity", "Pa s"),
}
"""Options of the world that a plan can declare, with the kind of number that binds each and its unit."""
UNIT = {"force": "N", "torque": "N·m", "velocity": "m/s"}


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each declaration that the recording does not keep."""
    if context.plan is not None and trajectory.mechanics.gravity is not None:
        meant = np.asarray(context.plan.simulation_parameters.gravity_vector)
        off = float(np.sqrt(((trajectory.gravity - meant) ** 2).sum()))
        if off > GRAVITY:
            here = ", ".join(f"{v:.4g}" for v in trajectory.gravity)
            message = f"gravity is ({here}) m/s^2; the plan says ({', '.join(f'{v:.4g}' for v in meant)})"
            whole = (trajectory.t[0], trajectory.t[-1])
            yield Sign("world", whole, off, GRAVITY, "m/s^2", "blocking", message)
    ledger = trajectory.interventions
    if ledger is None:
        return
    kinds, targets = np.asarray(ledger.kind, dtype=str), np.asarray(ledger.target, dtype=str)
    for row in (part for whole in context.interventions for part in _parts(whole)):
        mine = np.array(
            [
                kind == row.kind and Context(interventions=(row,)).declares(str(kind), str(target))
                for kind, target in zip(kinds, targets, strict=True)
            ],
            dtype=bool,
        )
        if mine.any():
            yield from _stronger(trajectory, row, mine)
            if row.kind in ("force", "torque") and row.solver is None:
                size = np.sqrt((_acting(trajectory, row, mine) ** 2).sum(axis=1))
                yield from kept_up.check(trajectory, row, row.kind, targets[mine], np.asarray(ledger.time)[mine], size)
            yield from _astray(trajectory, row, mine)
            yield from _other_time(trajectory, row, mine)
            yield from _other_law(trajectory, row, mine)
    yield from _other_control(trajectory, context)
    yield from _other_motor(trajectory, context)
    if context.plan is not None:
        yield from sent_inputs.check(trajectory, context.plan)


def _parts(row: Intervention) -> tuple[Intervention, ...]:
    """A row by the kinds under which its acts stand in the ledger: an author's own law gives forces and torques."""
    if row.solver is None or not row.solver.file:
        return (row,)
    return tuple(row.model_copy(update={"kind": kind}) for kind in ("force", "torque"))


def _acting(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> np.ndarray:
    """(N, 3) the acts under a declaration, in the unit of its kind (N, N·m, m/s)."""
    ledger = trajectory.interventions
    assert ledger is not None
    value = np.asarray(ledger.value)[mine]
    return value[:, 3:] if row.kind == "torque" and np.any(value[:, 3:]) else value[:, :3]


def _stronger(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    ledger, most = trajectory.interventions, law_words.limit(row.law, row.kind)
    assert ledger is not None
    if most is None and row.kind == "torque" and row.solver is not None and law_words.limit(row.law, "force"):
        yield from _levered(trajectory, row, mine)
    if most is None:
        return
    size = np.sqrt((_acting(trajectory, row, mine) ** 2).sum(axis=1))
    times_s = np.asarray(ledger.time)[mine]
    if row.kind == "velocity" and not EACH.search(row.law):
        total = np.concatenate(([0.0], np.cumsum(size)))
        size = total[1:] - total[np.searchsorted(times_s, times_s - 1.0, side="right")]
    worst = int(np.argmax(size))
    if size[worst] <= most * (1 + SHARE) + 1e-6:
        return
    unit, time = UNIT[row.kind], float(times_s[worst])
    target = str(np.asarray(ledger.target, dtype=str)[mine][worst])
    body = row.bodies[0] if row.solver is None else target if target in row.bodies else owner(target)
    message = f"the {row.kind} on {body} reaches {size[worst]:.3g} {unit}; its declared law says {most:.3g}"
    yield Sign(body, (time, time), size[worst], most, unit, "blocking", message)


def _levered(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    """Find a torque of an author's own law that the force it states could not give from where its points are."""
    ledger, force = trajectory.interventions, law_words.limit(row.law, "force")
    assert ledger is not None and row.solver is not None and force is not None
    if (shown := row.solver.shown_by) not in trajectory.media.names:
        return
    lay = trajectory.media.of(shown)
    size = np.sqrt((np.asarray(ledger.value)[mine][:, 3:] ** 2).sum(axis=1))
    targets = np.asarray(ledger.target, dtype=str)[mine]
    for body in {*row.bodies} & {*trajectory.names}:
        whose = np.array([target == body or owner(target) == body for target in targets], dtype=bool)
        if not whose.any():
            continue
        rows = np.unique(np.linspace(0, len(trajectory.t) - 1, INSTANTS).astype(int))
        at = trajectory.pos[:, trajectory.index(body)]
        reach = max(float(np.sqrt(((lay.at(trajectory.t[n]) - at[n]) ** 2).sum(axis=1)).max()) for n in rows)
        worst = int(np.argmax(size * whose))
        if size[worst] > (most := force * reach) * (1 + SHARE) + 1e-6:
            time = float(np.asarray(ledger.time)[mine][worst])
            said = f"its declared law says {force:.3g} N, and its points reach {reach:.3g} m: {most:.3g} N·m"
            message = f"the torque on {body} reaches {size[worst]:.3g} N·m; {said}"
            yield Sign(body, (time, time), size[worst], most, "N·m", "blocking", message)


def _astray(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    """Find acts in another direction than the law's: off its axis, or driving what it should brake."""
    ledger, axis = trajectory.interventions, law_words.direction(row.law)
    assert ledger is not None
    if row.kind not in UNIT:
        return
    acting, work = _acting(trajectory, row, mine), np.asarray(ledger.work_j)[mine]
    times_s = np.asarray(ledger.time)[mine]
    whole = (float(times_s.min()), float(times_s.max()))
    if axis is not None and "wind" not in row.bodies and (row.solver is None or row.kind == "force"):
        cosine = _along(acting, np.asarray(axis), _by_body(trajectory, row, mine))
        if cosine < ASTRAY:
            message = f"the {row.kind} on {row.bodies[0]} acts another way than its declared law says: {row.law}"
            yield Sign(row.bodies[0], whole, cosine, ASTRAY, "cosine", "blocking", message)
    gained, spent = float(work[work > 0].sum()), float(-work[work < 0].sum())
    if law_words.BRAKES.search(row.law) and gained > max(spent, 1e-6):
        message = f"the {row.kind} on {row.bodies[0]} drives it by {gained:.3g} J; its declared law brakes: {row.law}"
        yield Sign(row.bodies[0], whole, gained, spent, "J", "blocking", message)


def _by_body(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> np.ndarray:
    """(N,) whose each act is: what a law's points take from one body they may give to another; else all are of one."""
    ledger = trajectory.interventions
    assert ledger is not None
    targets = np.asarray(ledger.target, dtype=str)[mine]
    return targets if row.solver is not None else np.zeros(len(targets), int)


def _along(acting: np.ndarray, axis: np.ndarray, whose: np.ndarray) -> float:
    """The best cosine of the sums of what acts on each with an axis; 1 where nothing is left of any."""
    totals = np.array([acting[whose == one].sum(axis=0) for one in np.unique(whose)])
    sizes = np.sqrt((totals**2).sum(axis=1))
    return float((totals[sizes > 0] @ axis / sizes[sizes > 0]).max()) if (sizes > 0).any() else 1.0


def _other_law(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    """Find gravity, wind or a medium that is written to anything but what the law states in its unit."""
    ledger = trajectory.interventions
    assert ledger is not None
    targets = np.asarray(ledger.target, dtype=str)
    for name, (kind, unit) in LAWS.items():
        written = mine & np.array([t.startswith(f"opt.{name}") for t in targets.tolist()], dtype=bool)
        if not written.any():
            continue
        meant = [float(np.sqrt((trajectory.gravity**2).sum()))] if name == "gravity" else [0.0]
        low, high = law_words.interval(row.law, kind)
        said = np.array([*law_words.numbers(row.law, kind), *meant])
        size = np.sqrt((np.asarray(ledger.value)[written, :3] ** 2).sum(axis=1))
        off = np.abs(size[:, None] - said).min(axis=1) * ~((low <= size) & (size <= high))
        worst = int(np.argmax(off))
        if off[worst] > SHARE * size[worst] + 1e-9:
            message = f"the {name} is made {size[worst]:.4g} {unit}, which its declared law does not say: {row.law}"
            window = (float(np.asarray(ledger.time)[written][worst]),) * 2
            yield Sign("world", window, float(size[worst]), float(said.max()), unit, "blocking", message)


def _other_control(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Find controls that the plan gives as one number and that are sent as another."""
    plan, ledger = context.plan, trajectory.interventions
    if plan is None or ledger is None:
        return
    kinds, targets = np.asarray(ledger.kind, dtype=str), np.asarray(ledger.target, dtype=str)
    constants = plan.simulation_parameters.constants
    for row in plan.topology.actuators:
        known = (
            constants[row.control].value if isinstance(row.control, str) and row.control in constants else row.control
        )
        if not isinstance(known, (int, float)):
            continue
        mine = (kinds == "control") & np.array([t.rsplit("/", 1)[-1] == row.name for t in targets.tolist()], dtype=bool)
        sent = np.asarray(ledger.value)[mine, 0]
        off = np.abs(sent - known) if len(sent) else np.zeros(1)
        worst = int(np.argmax(off))
        if off[worst] > SHARE * abs(known) + 1e-6 and abs(sent[worst]) > 1e-9:
            time = float(np.asarray(ledger.time)[mine][worst])
            message = f"{row.name} is told {sent[worst]:.4g}; the plan's control is {known:.4g}"
            yield Sign(
                row.name, (time, time), float(abs(sent[worst])), abs(known), "of the control", "blocking", message
            )


def _other_motor(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Find motors of the plan that exert more than their law says, or that change though it says `constant`."""
    plan, ledger = context.plan, trajectory.interventions
    if plan is None or ledger is None:
        return
    hinges = {row.name for row in plan.topology.joints if row.type == "hinge"}
    targets = {
        row.name: "torque" if row.joint in hinges else "force" for row in plan.topology.actuators if row.kind == "motor"
    }
    for (kind, target), rows in ledger.groups.items():
        name = target.rsplit("/", 1)[-1]
        if kind != "control" or name not in targets:
            continue
        exerted = np.asarray(ledger.value)[rows, 1]
        for row in (one for one in context.interventions if one.kind == "control" and {*one.bodies} & {name, target}):
            law, most = row.law, law_words.limit(row.law, targets[name])
            if most is None:
                continue
            off = np.abs(exerted) - most
            if kept_up.constant(law) and len(exerted):
                sign = exerted[np.argmax(np.abs(exerted))]
                off = np.where(exerted == 0, 0.0, np.abs(exerted - np.copysign(most, sign)))
                own = np.full(len(rows), name)
                times_s = np.asarray(ledger.time)[rows]
                yield from kept_up.check(trajectory, row, targets[name], own, times_s, np.abs(exerted))
            worst, unit = int(np.argmax(off)), UNIT[targets[name]]
            if off[worst] > SHARE * most + 1e-6:
                time = float(np.asarray(ledger.time)[rows[worst]])
                message = f"{name} exerts {exerted[worst]:.4g} {unit}; its declared law says {most:.4g}: {law}"
                yield Sign(name, (time, time), float(abs(exerted[worst])), most, unit, "blocking", message)


def _other_time(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    ledger = trajectory.interventions
    assert ledger is not None
    begin, end = times(row.trigger)
    acted = np.asarray(ledger.time)[mine]
    first, last, slack = float(acted.min()), float(acted.max()), max(DELAY_S, 3 * trajectory.interval_s)
    early, late = begin - first, last - end
    if max(early, late) <= slack:
        return
    message = f"the {row.kind} on {row.bodies[0]} acts from {first:.3g} s to {last:.3g} s; declared: {row.trigger}"
    yield Sign(row.bodies[0], (first, last), max(early, late), slack, "s", "blocking", message)


def _pushed(value: float, law: str = "5 N along +x", trigger: str = "always") -> Case:
    row = Intervention(kind="force", bodies=("body",), law=law, trigger=trigger, source="the prompt")
    push = replace(analytic.resting(), interventions=analytic.pushed(value=value))
    return Case(f"{value:g} N declared as {law}, {trigger}", push, Context(planned=True, interventions=(row,)))


def _own_law(value: float, law: str = "a band of 200 N/m, at most 5 N", kind: str = "force") -> Case:
    beside = Beside(name="band", file="laws/band.py", shown_by="band")
    row = Intervention(kind="solver", bodies=("body", "post"), law=law, source="its catalogue", solver=beside)
    push = replace(analytic.resting(), interventions=analytic.pushed(kind, value=value))
    return Case(f"an own law: {value:g} of {kind} under {law}", push, Context(planned=True, interventions=(row,)))


def _lever(value: float) -> Case:
    """A torque of a law that states 5 N and has a point 0.2 m above the body."""
    case, lay = _own_law(value, "at most 5 N", "torque"), Lay(np.zeros(1), np.array([[0.0, 0.0, 0.25]]))
    trajectory = case.trajectory
    ledger = trajectory.interventions
    assert ledger is not None
    turning = replace(ledger, value=np.roll(np.asarray(ledger.value), 3, axis=1))
    return replace(case, trajectory=replace(trajectory, interventions=turning, media=ShownPoints({"band": lay})))


def _gravity(z: float) -> Case:
    plan = Plan.model_construct(
        plan_type="scene",
        simulation_parameters=SimulationParameters(time_step=0.001, simulation_duration=1.0, gravity=z),
        objectives=(),
        scene_objects=(),
        assets=(),
    )
    return Case(f"the plan says {z:g} m/s^2", analytic.resting(), Context(planned=True, plan=plan))


def _motor(*exerted: float, law: str = "constant force of 2 N along +X", trigger: str = "while it is held") -> Case:
    row = Intervention(kind="control", bodies=("push",), law=law, trigger=trigger, source="the prompt")
    plan = _gravity(-analytic.G).context.plan
    assert plan is not None
    drives = Topology.model_construct(joints=(), actuators=(Actuator(name="push", joint="rails"),))
    plan = plan.model_copy(update={"topology": drives})
    value = np.zeros((len(exerted), 6))
    value[:, 0] = value[:, 1] = exerted
    count = len(exerted)
    times_s = np.linspace(0.1, 0.5, count)
    sent = Interventions(times_s, ["control"] * count, ["push"] * count, value, np.zeros(count))
    context = Context(planned=True, plan=plan, interventions=(row,))
    return Case(f"a motor that exerts {exerted} N: {law}", replace(analytic.resting(), interventions=sent), context)


def _steady(share: float, law: str = "a constant wind of 5 N along +X", trigger: str = "always") -> Case:
    """A push that acts for a share of every tenth of a second."""
    push = analytic.resting()
    row = Intervention(kind="force", bodies=("body",), law=law, trigger=trigger, source="the prompt")
    step = push.time_step or push.interval_s
    at = np.arange(push.t[0], push.t[-1], step)
    at = at[(at / 0.1) % 1.0 < share]
    value = np.tile((5.0, 0, 0, 0, 0, 0), (len(at), 1))
    acts = Interventions(at, ["force"] * len(at), ["body"] * len(at), value, np.zeros(len(at)))
    context = Context(planned=True, interventions=(row,))
    return Case(f"{share:.0%} of the time: {law}, {trigger}", replace(push, interventions=acts), context)


GOOD = (
    lambda: _steady(1.0),
    lambda: _steady(0.5, "gusts of 5 N along +X"),
    lambda: _steady(0.5, "5 N along +X by a spring constant of 200 N/m"),
    lambda: _steady(0.5, trigger="when the body is in the tunnel"),
    lambda: _steady(0.5, trigger="height of body < 0.1 m"),
    lambda: _motor(2.0, 2.0, 0.0),
    lambda: _motor(2.0, 1.0, law="constant pull of 2 N, less 4 N·s/m of the speed"),
    lambda: _motor(2.0, 0.4, law="keeps a constant speed of 0.3 m/s with 2 N"),
    lambda: _pushed(5.0),
    lambda: _pushed(40.0, "as the wind: rho c A v^2 / 2, v = 3 m/s"),
    lambda: _pushed(60.0, "at most 0.06 kN, less 40 N·s/m of the speed"),
    lambda: _pushed(5.0, "from 2 N to 5 N, far below its weight"),
    lambda: _pushed(5.0, trigger="t in 0.1..0.11 s"),
    lambda: _pushed(5.0, trigger="until 0.8 s"),
    lambda: _gravity(-analytic.G),
    lambda: _own_law(5.0),
    lambda: _own_law(5.0, "at most 5 N along +X"),
    lambda: _own_law(40.0, "a damper of 10 N s/m, at most 50 N"),
    lambda: _own_law(40.0, "a damper of 10 N/(m/s), at most 50 N"),
    lambda: _own_law(40.0, "a spring of 20 N per m, at most 50 N"),
    lambda: _own_law(40.0, "a spring of 5 N m/rad, at most 50 N m", "torque"),
    lambda: _lever(0.9),
)
BAD = (
    lambda: replace(_steady(0.5), severity="blocking"),
    lambda: replace(_steady(0.5, trigger="once the gate is open"), severity="blocking"),
    lambda: replace(_steady(0.8, "a steady 5 N along +X"), severity="blocking"),
    lambda: replace(_motor(2.0, 2.0, trigger="always"), severity="blocking"),
    lambda: replace(_motor(40.0, 2.0, -40.0), severity="blocking"),
    lambda: replace(_motor(2.0, 0.5), severity="blocking"),
    lambda: replace(_motor(2.0, -2.0), severity="blocking"),
    lambda: replace(_motor(3.0, 0.4, law="keeps a constant speed of 0.3 m/s with 2 N"), severity="blocking"),
    lambda: replace(_motor(2.0, 0.4, law="a constant force of 2 N, at a constant speed"), severity="blocking"),
    lambda: replace(_motor(3.0, law="pushes with at most 2 N"), severity="blocking"),
    lambda: replace(_pushed(40.0, "a breeze of 1 N, far below its weight of 49 N"), severity="blocking"),
    lambda: replace(_pushed(5.0, "5 N along -X"), severity="blocking"),
    lambda: replace(_pushed(5.0, "brakes with 5 N against the motion"), severity="blocking"),
    lambda: replace(_pushed(50.0), severity="blocking"),
    lambda: replace(_pushed(5.0, trigger="at t = 2 s"), severity="blocking"),
    lambda: replace(_pushed(5.0, trigger="from 0.02 s to 0.05 s"), severity="blocking"),
    lambda: replace(_gravity(-1.62), severity="blocking"),
    lambda: replace(_own_law(40.0), severity="blocking"),
    lambda: replace(_own_law(40.0, "at most 2 N m", "torque"), severity="blocking"),
    lambda: replace(_own_law(40.0, "a spring of 200 N per m, at most 5 N"), severity="blocking"),
    lambda: replace(_own_law(40.0, "a spring of 50 N m/rad, at most 5 N m", "torque"), severity="blocking"),
    lambda: replace(_lever(1.5), severity="blocking"),
    lambda: replace(_own_law(40.0, "at most 5 N per wheel"), severity="blocking"),
    lambda: replace(_own_law(5.0, "at most 5 N along -X"), severity="blocking"),
    lambda: replace(_own_law(5.0, "brakes with 5 N against the motion"), severity="blocking"),
)
