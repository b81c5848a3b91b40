"""Free flight: when only gravity may act on a loose body, and what acts on it nevertheless.

A recording with an intervention ledger names every force, so whatever flight shows beyond the ledger is wrong. Foreign
recordings name none: there a force that is smooth (a planet's pull, a thruster, water) can be meant, while one that
sets in from one row to the next in mid-air, or changes a velocity within one row, cannot come from nature.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..model.mechanics import rotation
from ..model.trajectory import Trajectory
from .sign import spans

Array = np.ndarray
PUSHES = ("force", "torque", "pose", "velocity", "control", "callback", "constraint")
SUDDEN_ROWS = 2
LASTING_ROWS = 3


@dataclass(frozen=True)
class Push:
    """A stretch of flight in which a body's velocity does not change as gravity says."""

    body: int
    start: int
    """First row of the first step."""
    stop: int
    """Last row of the last step."""
    change: float
    """m/s: the velocity gained beyond gravity's."""
    sudden: bool
    """Within a row or two."""
    sets_in: bool
    """Lasting, with its full strength from its first step on, after flight that was free."""


def in_flight(trajectory: Trajectory) -> Array:
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
    if not trajectory.every_step:
        for b in np.flatnonzero(flying.any(axis=0)):
            close = reachable(trajectory, int(b))
            flying[:, b] &= ~(close[1:] | close[:-1])
    return flying


def pushes(trajectory: Trajectory) -> Iterator[Push]:
    """Every stretch of flight that gravity does not explain, body by body."""
    flying = in_flight(trajectory)
    dt = np.diff(trajectory.t)[:, None]
    g = trajectory.gravity
    tolerance = 0.1 * max(float(np.sqrt((g**2).sum())), 1.0)
    for b in np.flatnonzero(flying.any(axis=0)):
        extra = np.diff(trajectory.com_velocity[:, b], axis=0) - g * dt
        size = np.sqrt((extra**2).sum(axis=1))
        scale = trajectory.speed_scale[b]
        off = flying[:, b] & (size > tolerance * dt[:, 0])
        for start, stop in spans(off, bridge=1):
            change = float(np.sqrt((extra[start:stop].sum(axis=0) ** 2).sum()))
            sudden = stop - start <= SUDDEN_ROWS and change > 0.1 * scale + 0.02 * trajectory.speed[start, b]
            if trajectory.every_step:
                sudden = bool(size[start:stop].max() > 0.5 * scale)
            lasting = stop - start >= LASTING_ROWS and change > 0.1 * scale
            if not (sudden or lasting):
                continue
            before = flying[max(0, start - LASTING_ROWS) : start, b]
            free = len(before) == LASTING_ROWS and bool(before.all())
            usual = float(np.median(size[start:stop] / dt[start:stop, 0]))
            at_once = size[min(start + 1, stop - 1)] / dt[start, 0] > 0.7 * usual and _steady(extra[start:stop] / dt[start:stop])
            yield Push(int(b), int(start), int(stop), change, sudden, bool(lasting and free and at_once))


def _steady(acceleration: Array) -> bool:
    """The same from step to step, within a fifth."""
    inner = acceleration[1:-1] if len(acceleration) > 4 else acceleration
    mean = inner.mean(axis=0)
    spread = np.sqrt(((inner - mean) ** 2).sum(axis=1)).max(initial=0.0)
    return bool(spread < 0.2 * np.sqrt((mean**2).sum()))


def reachable(trajectory: Trajectory, b: int) -> Array:
    """(T,) rows at which a body is so close to something that it may have touched it between rows.

    Bounding spheres, inflated by the way of two rows; False everywhere when sizes are not known.
    """
    facts = trajectory.mechanics
    close = np.zeros(len(trajectory.t), dtype=bool)
    if facts.half_extents is None or np.isnan(facts.half_extents[b]).any():
        return close
    centre = _centre(trajectory, b)
    radius = float(np.sqrt((facts.half_extents[b] ** 2).sum()))
    for other in range(len(trajectory.names)):
        if other == b or np.isnan(facts.half_extents[other]).any():
            continue
        gap = centre - _centre(trajectory, other)
        reach = radius + float(np.sqrt((facts.half_extents[other] ** 2).sum()))
        way = 2 * trajectory.interval_s * (trajectory.speed[:, b] + trajectory.speed[:, other])
        close |= np.sqrt((gap**2).sum(axis=1)) < reach + way
    way = 2 * trajectory.interval_s * trajectory.speed[:, b]
    if facts.geom_pos is None and facts.ground_z is not None:
        close |= centre[:, 2] - facts.ground_z < radius + way
    for g in _world_geoms(trajectory):
        close |= _distance_to_geom(trajectory, g, centre) < radius + way
    return close


def _centre(trajectory: Trajectory, b: int) -> Array:
    middle = trajectory.mechanics.center
    if middle is None or not np.any(middle[b]):
        return trajectory.pos[:, b]
    return trajectory.pos[:, b] + rotation(trajectory.quat[:, b]) @ middle[b]


def _world_geoms(trajectory: Trajectory) -> Array:
    facts = trajectory.mechanics
    if facts.geom_pos is None or facts.geom_body is None or facts.geom_collides is None:
        return np.zeros(0, dtype=int)
    return np.flatnonzero((facts.geom_body < 0) & facts.geom_collides)


def _distance_to_geom(trajectory: Trajectory, g: int, points: Array) -> Array:
    """(N,) m from points (N, 3) to the box of a geom of the world; 0 inside."""
    facts = trajectory.mechanics
    assert facts.geom_pos is not None and facts.geom_quat is not None and facts.geom_half_extents is not None
    local = (points - facts.geom_pos[g]) @ rotation(facts.geom_quat[g])
    if facts.geom_type[g] == "plane":
        return np.maximum(local[:, 2], 0.0)
    outside = np.maximum(np.abs(local) - facts.geom_half_extents[g], 0.0)
    return np.sqrt((outside**2).sum(axis=1))
