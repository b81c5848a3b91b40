"""The angular momentum of a body in free flight changes: something turns it that is not there.

What it means: an invisible torque, such as one that keeps a figure upright. It can do next to no work, so an energy
audit misses it. Gravity acts at the centre of mass and cannot turn a loose body.

Formula: H = R I R^T w about the centre of mass, over each stretch of flight; |H(t) - H(0)| / (max|H| + H0), with
H0 = 0.2 I_max sqrt(g / r), the slow turning that cannot be told from nothing.
Threshold: 0.1 warns, 0.3 blocks. The engine's own error on a tumbling body is of the order of w dt per turn.
Source: Euler's equations; the facts on staging (a torque of 77 N m on a figure in flight).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..flight import PUSHES, certain, in_flight
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS114"
SHOWN_AS = "spin"
NEEDS = ("touching", "mechanics.unforced", "mechanics.inertia", "mechanics.inertia_quat")
WHOLE = True
MINIMUM_ROWS = 5
WARN, BLOCK = 0.1, 0.3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that are turned in flight."""
    flying = in_flight(trajectory)
    g = float(np.sqrt((trajectory.gravity**2).sum())) or 1.0
    inertia = trajectory.mechanics.inertia
    assert inertia is not None
    turning = survey(trajectory).spin.max(axis=0) >= 0.02 * np.sqrt(g / trajectory.size_m)
    for b in np.flatnonzero(turning & flying.any(axis=0)):
        floor = 0.2 * float(inertia[b].max()) * np.sqrt(g / trajectory.size_m[b])
        for start, stop in spans(flying[:, b]):
            still = trajectory.spin[start : stop + 1, b].max() < 0.02 * np.sqrt(g / trajectory.size_m[b])
            if stop - start < MINIMUM_ROWS or still:
                continue
            momentum = angular_momentum(trajectory, b, slice(start, stop + 1))
            change = np.sqrt(((momentum - momentum[0]) ** 2).sum(axis=1))
            share = change / (np.sqrt((momentum**2).sum(axis=1)).max() + floor)
            worst = int(np.argmax(share))
            if share[worst] <= WARN or not certain(trajectory, int(b), int(start), int(stop)):
                continue
            name = trajectory.names[b]
            declared = context.acts_on(name, PUSHES)
            severity = "info" if declared else "blocking" if share[worst] > BLOCK else "warn"
            message = f"{name} touches nothing, yet its angular momentum changes by {share[worst]:.0%}"
            window = (trajectory.t[start], trajectory.t[start + worst])
            yield Sign(name, window, share[worst], WARN, "of the angular momentum", severity, message)
            break


def angular_momentum(trajectory: Trajectory, b: int, rows: slice) -> np.ndarray:
    """(N, 3) kg·m^2/s: the angular momentum of a body about its own centre of mass, world frame."""
    facts = trajectory.mechanics
    assert facts.inertia is not None and facts.inertia_quat is not None
    axes = matrices(trajectory.quat[rows, b]) @ matrices(facts.inertia_quat[b])
    local = np.einsum("tji,tj->ti", axes, trajectory.angvel[rows, b])
    return np.einsum("tij,tj->ti", axes, local * facts.inertia[b])


def _spun_up() -> Case:
    fall = analytic.falling()
    rate = 30 * fall.t
    angle = 15 * fall.t**2
    quat = np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], axis=1)[:, None]
    spin = np.stack([0 * rate, 0 * rate, rate], axis=1)[:, None]
    return Case("a falling body spins up", replace(fall, quat=quat, angvel=spin), severity="blocking")


def _spinning() -> Case:
    fall = analytic.falling()
    angle = 20 * fall.t
    quat = np.stack([np.cos(angle / 2), np.sin(angle / 2), 0 * angle, 0 * angle], axis=1)[:, None]
    spin = np.tile((20.0, 0.0, 0.0), (len(fall.t), 1))[:, None]
    return Case("a body spinning steadily as it falls", replace(fall, quat=quat, angvel=spin))


GOOD = (lambda: Case("free fall", analytic.falling()), _spinning)
BAD = (_spun_up,)
