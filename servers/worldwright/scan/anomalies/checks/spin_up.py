"""A body spins faster and faster, and nothing drives it.

What it means: a torque that is not in the model, negative damping, or an unstable integration. A body alone keeps its
angular momentum; its spin can change only by the ratio of its moments of inertia.

Formula: in stretches without contact, w over the last fifth against the first fifth, for a body without actuators,
springs or ties. Threshold: a factor of max(1.5, 1.2 times the ratio of the largest to the smallest moment), and a gain of
sqrt(g / r). Where the model is not known, a fivefold and lasting rise to over 10 sqrt(g / r) warns: it may be a motor.
Source: Euler's equations of a rigid body.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS128"
NEEDS = ("angvel",)
WHOLE = True
ROWS = 10


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that spin up."""
    facts, g = trajectory.mechanics, float(np.sqrt((trajectory.gravity**2).sum())) or 1.0
    known = facts.unforced is not None and trajectory.touching is not None
    alone = (
        flight.in_flight(trajectory) if known else np.repeat(trajectory.moves_freely[None], len(trajectory.t) - 1, 0)
    )
    slowest = np.sqrt(g / trajectory.size_m)
    for b in np.flatnonzero((survey(trajectory).spin.max(axis=0) > slowest) & alone.any(axis=0)):
        slow = float(slowest[b])
        ratio = 1.5
        if facts.inertia is not None and facts.inertia[b].min() > 0:
            ratio = max(ratio, 1.2 * float(facts.inertia[b].max() / facts.inertia[b].min()))
        for start, stop in spans(alone[:, b]):
            if stop - start < ROWS:
                continue
            spin = trajectory.spin[start : stop + 1, b]
            fifth = max(1, len(spin) // 5)
            first, last = float(spin[:fifth].mean()), float(spin[-fifth:].mean())
            name, window = trajectory.names[b], (trajectory.t[start], trajectory.t[stop])
            if known and last > ratio * first and last - first > slow:
                if not flight.certain(trajectory, int(b), int(start), int(stop)):
                    continue
                severity = "info" if context.acts_on(name, flight.PUSHES) else "blocking"
            elif not known and last > 5 * first and last > 10 * slow and last >= 0.85 * spin.max():
                severity = "warn"
            else:
                continue
            message = f"{name} spins up from {first:.3g} to {last:.3g} rad/s without anything that drives it"
            yield Sign(name, window, last, ratio * first, "rad/s", severity, message)
            break


def _spinning(end: float) -> Trajectory:
    t = analytic.clock(1.0)
    rate = 2.0 + (end - 2.0) * t
    angle = np.concatenate(([0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(t))))
    quat = np.stack([np.cos(angle / 2), 0 * t, 0 * t, np.sin(angle / 2)], axis=1)[:, None]
    spin = np.stack([0 * t, 0 * t, rate], axis=1)[:, None]
    pos = np.tile((0.0, 0.0, 2.0), (len(t), 1))
    return analytic.motion(t, pos, 0 * pos, quat=quat, angvel=spin, gravity=0.0)


GOOD = (
    lambda: Case("a steady spin", _spinning(2.0)),
    lambda: Case("a rolling ball", analytic.rolling()),
)
BAD = (
    lambda: Case("a spin that grows twentyfold", _spinning(40.0), severity="blocking"),
    lambda: Case(
        "the same, model not known",
        replace(_spinning(400.0), mechanics=replace(_spinning(400.0).mechanics, unforced=None)),
        severity="warn",
    ),
)
