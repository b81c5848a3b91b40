"""The system's mechanical energy rises although nothing did work on it.

What it means: a wrong contact or integrator feeds energy in, bodies started inside each other and burst apart, or
something pushed unseen. Friction, impacts and damping may only take energy out.

Formula: E = potential + kinetic - (recorded work of interventions). Dips shorter than 0.15 s are closed first (a soft
contact or a stop stores energy that the engine's E leaves out, and gives it back), and rows where contacts store more
than 1 % (sum of force times depth) are left out. The gain is E minus its smallest earlier value, relative to
max(kinetic) + range(potential).
Threshold: 3 % warns (an undamped pendulum's energy swings by about w dt / 2, some tenths of a percent); 15 % blocks.
Source: the work-energy theorem; the manual on the energy flag.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.plan.committed import Intervention
from ....model.recording.records import Interventions
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign, SkipError

CODE = "WS109"
SHOWN_AS = "energy"
NEEDS = ("energy",)
DIP_S = 0.15
WARN, BLOCK = 0.03, 0.15
AT_ONCE = ("pose", "velocity", "mocap", "parameter", "constraint")
UNACCOUNTED = {"fluid", "surface velocity", "plugins", "flexes", "gravity compensation", "adhesion"}


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the largest rise of energy, if it is one."""
    energy = trajectory.energy
    if energy is None or len(energy) < 10:
        return
    if not np.any(energy) and trajectory.speed.max() > 0:
        raise SkipError("the energy was not computed (the model's energy flag is off)")
    working = UNACCOUNTED & set(trajectory.mechanics.drives)
    if working:
        raise SkipError(f"work is done that the recording does not account for: {', '.join(sorted(working))}")
    scale = energy[:, 1].max() + np.ptp(energy[:, 0])
    if scale <= _noise(trajectory):
        return
    total = energy.sum(axis=1) - _work(trajectory)
    quiet = _quiet(trajectory, scale)
    if quiet.sum() < 10:
        return
    rows = np.flatnonzero(quiet)
    level = _close_dips(total[rows], round(DIP_S / trajectory.interval_s))
    gain = level - np.minimum.accumulate(level)
    end = int(np.argmax(gain))
    share = gain[end] / scale
    if share <= WARN:
        return
    driven = trajectory.mechanics.dynamic is None  # without a model nobody can tell whether motors drive it
    unnamed = trajectory.interventions is None and (driven or _pushed(trajectory))
    start = int(np.argmin(level[: end + 1]))
    window = (trajectory.t[rows[start]], trajectory.t[rows[end]])
    message = f"the mechanical energy rises by {gain[end]:.3g} J ({share:.0%} of its scale) without recorded work"
    severity: AnomalySeverity = "blocking" if share > BLOCK and not unnamed else "warn"
    if unnamed:
        message += "; the recording names no forces, and what drives it may be meant"
    yield Sign("world", window, share, WARN, "of the energy scale", severity, message)
    if trajectory.interventions is None:
        gains, own = _own_gains(trajectory, int(rows[start]), int(rows[end]))
        if gains[own] > 0:
            name = trajectory.names[own]
            told = f"of the energy that the system gains, most is in the motion of {name}"
            yield Sign(name, window, share, WARN, "of the energy scale", "warn", told)


def _own_gains(trajectory: Trajectory, start: int, end: int) -> tuple[np.ndarray, int]:
    """(B,) J: what each body gains between two rows by speed, spin and height; and the index of the one that gains most."""
    mass = trajectory.mechanics.mass
    weight = np.ones(len(trajectory.names)) if mass is None else np.nan_to_num(mass)
    swing = trajectory.speed[[start, end]] ** 2 / 2 + (trajectory.size_m * trajectory.spin[[start, end]]) ** 2 / 5
    lift = -trajectory.pos[[start, end]] @ trajectory.gravity
    total = weight * (swing + lift)
    gains = np.where(trajectory.moves_freely, total[1] - total[0], -np.inf)
    return gains, int(np.argmax(gains))


def _pushed(trajectory: Trajectory) -> bool:
    """Whether a smooth force acts on something in flight (a thruster, a planet)."""
    return any(not push.sudden and not push.sets_in for push in flight.pushes(trajectory))


def _noise(trajectory: Trajectory) -> float:
    """The energy that lifts everything by a 50th of its size, J: less is the last jitter of bodies at rest."""
    mass = trajectory.mechanics.mass
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    return 0.0 if mass is None else float((mass * g * trajectory.size_m * trajectory.moves_freely).sum()) * 0.02


def _work(trajectory: Trajectory) -> np.ndarray:
    """(T,) work of interventions done before each row, J; actuators without a recorded work cannot be judged."""
    total = np.zeros(len(trajectory.t))
    ledger = trajectory.interventions
    pushes = ledger is not None and len(ledger.time) > 0
    if {"actuators", "mocap"} & set(trajectory.mechanics.drives) and not pushes:
        raise SkipError("actuators or mocap bodies may do work, and none of it is recorded")
    if ledger is None or not pushes:
        return total
    unmeasured = {"control", "mocap", "constraint", "parameter", "pose", "velocity"} & set(ledger.kind)
    if not np.all(np.isfinite(ledger.work_j)) or (unmeasured and not np.any(ledger.work_j)):
        raise SkipError("interventions act on the system, and their work is not recorded")
    # A force works from its row to the next; a written velocity or pose already shows in the state of its own row.
    at_once = np.isin(np.asarray(ledger.kind, dtype=str), AT_ONCE)
    when = np.asarray(ledger.time) + np.where(at_once, -1e-9, 1e-12)
    done = np.searchsorted(trajectory.t, when, side="left")
    np.add.at(total, np.minimum(done, len(total) - 1), ledger.work_j)
    return np.cumsum(total)


def _quiet(trajectory: Trajectory, scale: float) -> np.ndarray:
    """(T,) bool: rows at which contacts store next to no energy."""
    contacts = trajectory.contacts
    force, deepest = trajectory.contact_force_sum, trajectory.max_penetration
    if contacts is None and force is not None and deepest is not None:
        # Each contact pushes two bodies at most, so this bounds what all of them store.
        return np.asarray(force.sum(axis=1) * deepest < 0.01 * scale)
    if contacts is None:
        if trajectory.ncon is None or (trajectory.ncon == 0).mean() < 0.2:
            return np.ones(len(trajectory.t), dtype=bool)
        return trajectory.ncon == 0
    stored = np.zeros(len(trajectory.t))
    np.add.at(stored, contacts.row, np.maximum(contacts.normal_force * contacts.depth_m, 0.0))
    return stored < 0.01 * scale


def _close_dips(values: np.ndarray, rows: int) -> np.ndarray:
    """Fill dips narrower than `rows` (a morphological closing: sliding maximum, then sliding minimum)."""
    width = min(rows, len(values) // 4)
    if width < 2:
        return values
    view = np.lib.stride_tricks.sliding_window_view
    padded = np.pad(values, (width // 2, width - 1 - width // 2), mode="edge")
    highest = view(padded, width).max(axis=1)
    padded = np.pad(highest, (width - 1 - width // 2, width // 2), mode="edge")
    return view(padded, width).min(axis=1)


def _with_energy(trajectory: Trajectory, kinetic: float = 1.0) -> Trajectory:
    height, speed = trajectory.pos[:, 0, 2], trajectory.speed[:, 0]
    return replace(trajectory, energy=np.stack([analytic.G * height, kinetic * speed**2 / 2], axis=1))


def _lively_ball() -> Case:
    ball = analytic.bouncing(restitution=1.1, height=0.3, seconds=2.0)
    return Case("a ball that bounces higher each time", _with_energy(ball), severity="blocking")


def _burst() -> Case:
    t = analytic.clock(1.0)
    pos = np.stack([np.maximum(t - 0.3, 0) * 3, 0 * t, 0 * t + 0.05], axis=1)
    vel = np.stack([(t > 0.3) * 3.0, 0 * t, 0 * t], axis=1)
    return Case("a body shoots off by itself", _with_energy(analytic.motion(t, pos, vel)), severity="blocking")


def _launched() -> Case:
    burst = _burst().trajectory
    assert burst.energy is not None
    row = int(np.argmax(burst.linvel[:, 0, 0] > 0))
    work = float(burst.energy[row].sum() - burst.energy[row - 1].sum())
    ledger = Interventions(
        time=burst.t[row : row + 1],
        kind=("velocity",),
        target=("body",),
        value=np.zeros((1, 6)),
        work_j=np.array([work]),
    )
    meant = Intervention(kind="velocity", bodies=("body",), law="a shot", trigger="t = 0.3 s", source="the prompt")
    told = Context(planned=True, movers=("body",), interventions=(meant,))
    return Case("a body shoots off by a velocity that the ledger has", replace(burst, interventions=ledger), told)


GOOD = (
    _launched,
    lambda: Case("free fall", _with_energy(analytic.falling())),
    lambda: Case("a bouncing ball", _with_energy(analytic.bouncing())),
    lambda: Case("a body braked by friction", _with_energy(analytic.sliding(1.0, 1.0))),
)
BAD = (_lively_ball, _burst)
