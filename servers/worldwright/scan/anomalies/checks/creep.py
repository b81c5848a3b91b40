"""A body creeps on, slowly and steadily, where friction would hold it or stop it.

What it means: contacts too soft for their load, a friction that regularisation turned into a thick fluid, an impedance far
under one: the load goes down the slope a millimetre at a time. Dry friction knows no steady slow sliding: it stops a
body or lets it gather speed.

Formula: in contact for 1 s, its speed stays within a fifth of its mean and that mean is under 0.15 sqrt(g r), it does not turn
(w r < 0.3 v), and it goes further than 0.005 r (and a millimetre). Its acceleration is under a hundredth of g. Bodies that
actuators move or that rest on a moving surface, a mocap body or on something that moves along are left out.
Threshold: 0.005 r within the recording, a way that can be seen. A warning.
Source: Coulomb's law of friction; the manual on `impratio`, `solimp` and `noslip_iterations` (slip of soft contacts).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS137"
NEEDS = ("linvel", "touching")
WHOLE = True
HELD_S, SLOW, WAY, STEADY = 1.0, 0.15, 0.005, 0.2
LEAST_M = 1e-3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that creep."""
    touching, g = trajectory.touching, float(np.sqrt((trajectory.gravity**2).sum()))
    rows = max(4, round(HELD_S / trajectory.interval_s))
    if touching is None or g == 0 or len(trajectory.t) <= rows:
        return
    if {"surface velocity", "fluid", "flexes", "plugins"} & set(trajectory.mechanics.drives):
        return
    long = survey(trajectory).touches.sum(axis=0) >= rows
    loose = trajectory.mechanics.unforced
    for b in np.flatnonzero(trajectory.moves_freely & long):
        if loose is not None and not loose[b]:
            continue
        speed, limit = trajectory.speed[:, b], SLOW * trajectory.speed_scale[b]
        least = max(WAY * trajectory.size_m[b], LEAST_M)
        slow = touching[:, b] & (speed < limit) & (speed > 0.3 * least / trajectory.duration_s)
        for start, stop in spans(slow, bridge=2):
            if stop - start < rows:
                continue
            part = slice(
                start + rows // 4, stop
            )  # a body that comes to rest or starts has a speed of its own for a moment
            if _creeps(trajectory, int(b), part, least, g):
                name = trajectory.names[b]
                way = float(np.sqrt(((trajectory.pos[stop - 1, b] - trajectory.pos[start, b]) ** 2).sum()))
                mean = float(speed[part].mean())
                message = f"{name} creeps {way:.3g} m at a steady {mean:.3g} m/s, where friction would hold it"
                severity = "info" if context.acts_on(name, ("force", "pose", "velocity")) else "warn"
                window = (trajectory.t[start], trajectory.t[stop - 1])
                yield Sign(name, window, way, least, "m", severity, message)
                break


def _creeps(trajectory: Trajectory, b: int, part: slice, least: float, g: float) -> bool:
    speed, mean = trajectory.speed[part, b], float(trajectory.speed[part, b].mean())
    if np.percentile(np.abs(speed - mean), 90) > STEADY * mean:
        return False
    way = trajectory.pos[part.stop - 1, b] - trajectory.pos[part.start, b]
    if np.sqrt((way**2).sum()) < max(least, 0.8 * mean * (trajectory.t[part.stop - 1] - trajectory.t[part.start])):
        return False
    if np.median(trajectory.spin[part, b]) * trajectory.size_m[b] > 0.3 * mean:
        return False
    # It is carried along if something else goes the same way as fast.
    velocity = trajectory.linvel[part].mean(axis=0)
    others = np.sqrt(((velocity - velocity[b]) ** 2).sum(axis=1)) < 0.3 * mean
    others[b] = False
    return not others.any() and bool(abs(velocity[b][2]) < 0.95 * mean or abs(velocity[b] @ trajectory.gravity) > 0)


def _creeping(speed: float) -> Trajectory:
    made = analytic.resting(2.0)
    slope = np.array([np.cos(0.3), 0.0, -np.sin(0.3)])
    way = speed * made.t[:, None, None] * slope
    return replace(made, pos=made.pos + way, linvel=np.broadcast_to(speed * slope, made.linvel.shape).copy())


GOOD = (
    lambda: Case("a body at rest", analytic.resting()),
    lambda: Case("a body braked by friction", analytic.sliding(1.0, 2.0)),
    lambda: Case("a slide too slow to be seen", _creeping(2e-5)),
)
BAD = (lambda: Case("a box creeps down a slope", _creeping(0.01), severity="warn"),)
