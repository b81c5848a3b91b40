"""A body in free flight does not fall with gravity: it floats, hovers, brakes or is pushed by nothing.

What it means: an invisible force, a pose or velocity that is written, an undeclared gravity compensation, or a body
left hanging without support. Touching nothing and tied to nothing, only gravity may act.

Formula: for a loose body in rows without contact, a = dv/dt of its centre of mass; |a - g| > 0.1 max(|g|, 1) over at
least three rows whose sum |sum (a - g) dt| exceeds 0.1 sqrt(g r); or, when every step was recorded, one single step
with |dv - g dt| > 0.5 sqrt(g r). Rows with a recorded force, torque, velocity or pose on the body are the ledger's.
Threshold: a tenth of gravity; free flight of the engine agrees to 1e-9.
Source: Newton's second law; the facts on staging (forces on airborne bodies).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign, spans

CODE = "WS113"
NEEDS = ("touching", "mechanics.unforced")
PUSHES = ("force", "torque", "pose", "velocity", "control", "callback", "constraint")


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies whose flight is not free."""
    flying = in_flight(trajectory)
    dt = np.diff(trajectory.t)[:, None]
    g = trajectory.gravity
    tolerance = 0.1 * max(float(np.sqrt((g**2).sum())), 1.0)
    for b in np.flatnonzero(flying.any(axis=0)):
        extra = np.diff(trajectory.com_velocity[:, b], axis=0) - g * dt
        size = np.sqrt((extra**2).sum(axis=1))
        scale = trajectory.speed_scale[b]
        off = flying[:, b] & (size > tolerance * dt[:, 0])
        name = trajectory.names[b]
        for start, stop in spans(off, bridge=1):
            change = float(np.sqrt((extra[start:stop].sum(axis=0) ** 2).sum()))
            lasting = stop - start >= 3 and change > 0.1 * scale
            if not lasting and not (trajectory.every_step and size[start:stop].max() > 0.5 * scale):
                continue
            seconds = trajectory.t[stop] - trajectory.t[start]
            message = f"{name} touches nothing, yet its velocity changes by {change:.3g} m/s more than gravity explains"
            if trajectory.speed[start:stop, b].max() < 1e-6:
                message = f"{name} hangs in the air for {seconds:.2g} s, touching nothing"
            severity = "info" if context.acts_on(name, PUSHES) else "blocking"
            yield Sign(
                name, (trajectory.t[start], trajectory.t[stop]), change / seconds, tolerance, "m/s^2", severity, message
            )
            break


def in_flight(trajectory: Trajectory) -> np.ndarray:
    """(T-1, B) steps in which only gravity may act on a loose body."""
    touching, unforced = trajectory.touching, trajectory.mechanics.unforced
    if touching is None or unforced is None or len(trajectory.t) < 3:
        return np.zeros((max(0, len(trajectory.t) - 1), len(trajectory.names)), dtype=bool)
    apart = ~(touching[1:] | touching[:-1])
    if not trajectory.every_step:
        # A touch may hide between two sparse rows beside one that was seen.
        near = apart.copy()
        near[1:] &= apart[:-1]
        near[:-1] &= apart[1:]
        apart = near
    flying = apart & unforced & trajectory.moves_freely
    ledger = trajectory.interventions
    if ledger is not None and len(ledger.time):
        step = np.clip(np.searchsorted(trajectory.t, np.asarray(ledger.time) + 1e-12) - 1, 0, len(flying) - 1)
        for row, kind, target in zip(step, ledger.kind, ledger.target, strict=True):
            if kind in PUSHES:
                body = str(target).replace("/", ".").split(".")[0]
                column = trajectory.names.index(body) if body in trajectory.names else slice(None)
                flying[max(0, row - 1) : row + 2, column] = False
    return flying


def _floating() -> Case:
    t = analytic.clock(1.0)
    pos = np.tile((0.0, 0.0, 2.0), (len(t), 1))
    return Case("a cup hangs in the air", analytic.motion(t, pos, 0 * pos), severity="blocking")


def _braked() -> Case:
    fall = analytic.falling(seconds=0.8)
    t = fall.t
    speed = fall.linvel.copy()
    speed[:, 0, 2] = np.where(t < 0.4, -analytic.G * t, -analytic.G * 0.4 + 5 * (t - 0.4))
    pos = fall.pos.copy()
    pos[:, 0, 2] = 5 + np.concatenate(([0], np.cumsum((speed[1:, 0, 2] + speed[:-1, 0, 2]) / 2 * np.diff(t))))
    return Case("a fall braked by nothing", replace(fall, pos=pos, linvel=speed), severity="blocking")


def _turned_back() -> Case:
    ball = analytic.bouncing()
    assert ball.contacts is not None
    nothing = ball.contacts.take(ball.contacts.row > len(ball.t))
    return Case("a ball bounces off nothing", replace(ball, contacts=nothing), severity="blocking")


GOOD = (
    lambda: Case("free fall", analytic.falling()),
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a body at rest", analytic.resting()),
    lambda: Case("a pendulum, which is not loose", analytic.swinging()),
)
BAD = (_floating, _braked, _turned_back)
