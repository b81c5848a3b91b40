"""A body in free flight does not fall with gravity: it floats, hovers, brakes or is pushed by nothing.

What it means: an invisible force, a pose or velocity that is written, an undeclared gravity compensation, or a body
left hanging without support. Touching nothing and tied to nothing, only gravity may act.

Formula: for a loose body in rows without contact, a = dv/dt of its centre of mass; |a - g| > 0.1 max(|g|, 1) over at
least three rows whose sum |sum (a - g) dt| exceeds 0.1 sqrt(g r); or, when every step was recorded, one single step
with |dv - g dt| > 0.5 sqrt(g r). Rows with a recorded force, torque, velocity or pose on the body are the ledger's.
Severity: blocking where the recording has a ledger, or where the force sets in with full strength in mid-flight; a
smooth force in a recording that names no forces (a planet's pull, a thruster, water) warns.
Threshold: a tenth of gravity; free flight of the engine agrees to 1e-9.
Source: Newton's second law; the facts on staging (forces on airborne bodies).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign

CODE = "WS113"
NEEDS = ("touching", "mechanics.unforced")
WHOLE = True


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies whose flight is not free."""
    told = trajectory.interventions is not None or trajectory.every_step
    seen = set()
    for push in flight.pushes(trajectory):
        name = trajectory.names[push.body]
        if name in seen or (push.sudden and not told):  # velocity_jump reports it
            continue
        seen.add(name)
        start, stop = push.start, push.stop
        seconds = trajectory.t[stop] - trajectory.t[start]
        message = (
            f"{name} touches nothing, yet its velocity changes by {push.change:.3g} m/s more than gravity explains"
        )
        if trajectory.speed[start:stop, push.body].max() < 1e-6:
            message = f"{name} hangs in the air for {seconds:.2g} s, touching nothing"
        certain = told or push.sets_in
        if not certain:
            message += "; the recording names no forces, so whether this one is meant cannot be told"
        severity = "info" if context.acts_on(name, flight.PUSHES) else "blocking" if certain else "warn"
        tolerance = 0.1 * max(float(np.sqrt((trajectory.gravity**2).sum())), 1.0)
        window = (trajectory.t[start], trajectory.t[stop])
        yield Sign(name, window, push.change / seconds, tolerance, "m/s^2", severity, message)


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
