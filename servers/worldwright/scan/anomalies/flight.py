"""Free flight: when only gravity may act on a loose body, and what acts on it nevertheless.

A recording with an intervention ledger names every force, so whatever flight shows beyond the ledger is wrong. Foreign
recordings name none: there a force that is smooth (a planet's pull, a thruster, water) can be meant, while one that
sets in from one row to the next in mid-air, or changes a velocity within one row, cannot come from nature.
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from worldkit.turning import matrices

from ...model.recording.trajectory import Trajectory
from .sign import spans
from .survey import survey

Array = np.ndarray
PUSHES = ("force", "torque", "pose", "velocity", "control", "constraint")
_FLIGHT, _PUSHES = "_in_flight", "_pushes_in_flight"
SUDDEN_ROWS = 2
MOST = 60
"""So many stretches of one body are looked at; what it does sixty times need not be told again."""
LASTING_ROWS = 3


@dataclass(frozen=True)
class Push:
    """A stretch of flight in which a body's velocity does not change as gravity says."""

    body: int
    start: int
    """The first row of its first step."""
    stop: int
    """The last row of its last step."""
    change: float
    """The velocity gained beyond what gravity gives, m/s."""
    sudden: bool
    """It happens within a row or two."""
    sets_in: bool
    """It lasts, and has its full strength from its first step on, after free flight."""


def in_flight(trajectory: Trajectory) -> Array:
    """(T-1, B) bool: steps in which only gravity may act on a loose body; computed once for several checks."""
    known = trajectory.__dict__.get(_FLIGHT)
    if known is None:
        known = trajectory.__dict__[_FLIGHT] = _in_flight(trajectory)
    return np.asarray(known)


def _in_flight(trajectory: Trajectory) -> Array:
    touching, unforced = trajectory.touching, trajectory.mechanics.unforced
    if touching is None or unforced is None or len(trajectory.t) < 3:
        return np.zeros((max(0, len(trajectory.t) - 1), len(trajectory.names)), dtype=bool)
    apart = ~(touching[1:] | touching[:-1])
    if not trajectory.every_step:
        # Beside a recorded touch, another may hide between two sparse rows.
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


def certain(trajectory: Trajectory, b: int, start: int, stop: int) -> bool:
    """Whether steps `start` to `stop` of a body are flight even between rows: nothing was near enough to touch it."""
    return trajectory.every_step or not reachable(trajectory, b, slice(max(0, start - 1), stop + 2)).any()


def pushes(trajectory: Trajectory) -> tuple[Push, ...]:
    """Every stretch of flight that gravity does not explain, body by body; computed once for several checks."""
    known = trajectory.__dict__.get(_PUSHES)
    if known is None:
        known = trajectory.__dict__[_PUSHES] = tuple(_pushes(trajectory))
    return known


def _pushes(trajectory: Trajectory) -> Iterator[Push]:
    flying = in_flight(trajectory)
    if len(flying) < 2:
        return
    dt = np.diff(trajectory.t)[:, None]
    g = trajectory.gravity
    tolerance = 0.1 * max(float(np.sqrt((g**2).sum())), 1.0)
    for b in np.flatnonzero(survey(trajectory).off_gravity.any(axis=0) & flying.any(axis=0)):
        extra = np.diff(trajectory.com_velocity[:, b], axis=0) - g * dt
        size = np.sqrt((extra**2).sum(axis=1))
        scale = trajectory.speed_scale[b]
        off = flying[:, b] & (size > tolerance * dt[:, 0])
        for start, stop in spans(off, bridge=1)[:MOST]:
            change = float(np.sqrt((extra[start:stop].sum(axis=0) ** 2).sum()))
            sudden = stop - start <= SUDDEN_ROWS and change > 0.1 * scale + 0.02 * trajectory.speed[start, b]
            if trajectory.every_step:
                sudden = bool(size[start:stop].max() > 0.5 * scale)
            lasting = stop - start >= LASTING_ROWS and change > 0.1 * scale
            if not (sudden or lasting) or not certain(trajectory, int(b), int(start), int(stop)):
                continue
            before = flying[max(0, start - LASTING_ROWS) : start, b]
            free = len(before) == LASTING_ROWS and bool(before.all())
            usual = float(np.median(size[start:stop] / dt[start:stop, 0]))
            at_once = size[min(start + 1, stop - 1)] / dt[start, 0] > 0.7 * usual and _steady(
                extra[start:stop] / dt[start:stop]
            )
            yield Push(int(b), int(start), int(stop), change, sudden, bool(lasting and free and at_once))


def _steady(acceleration: Array) -> bool:
    """Whether an acceleration stays the same from step to step, within a fifth."""
    inner = acceleration[1:-1] if len(acceleration) > 4 else acceleration
    mean = inner.mean(axis=0)
    spread = np.sqrt(((inner - mean) ** 2).sum(axis=1)).max(initial=0.0)
    return bool(spread < 0.2 * np.sqrt((mean**2).sum()))


def reachable(trajectory: Trajectory, b: int, rows: slice) -> Array:
    """(N,) bool: rows at which a body is so close to something that it may have touched it between rows.

    The bounding spheres are inflated by the way of two rows; all False when sizes are not known.
    """
    facts = trajectory.mechanics
    speed = trajectory.speed[rows]
    close = np.zeros(len(speed), dtype=bool)
    if facts.half_extents is None or np.isnan(facts.half_extents[b]).any():
        return close
    centre = _centre(trajectory, b, rows)
    radii = np.sqrt((facts.half_extents**2).sum(axis=1))
    every = 2 * trajectory.interval_s
    # Only those others count whose origins come within reach of the stretch's bounding box.
    low, high = centre.min(axis=0), centre.max(axis=0)
    path = trajectory.pos[rows]
    offset = 0.0 if facts.center is None else np.sqrt((np.nan_to_num(facts.center) ** 2).sum(axis=1))
    reach = radii[b] + radii + offset + every * (speed[:, b].max() + speed.max(axis=0))
    apart = np.maximum(low - path.max(axis=0), path.min(axis=0) - high).max(axis=1)
    for other in np.flatnonzero(~np.isnan(radii) & (apart < reach)):
        if other == b:
            continue
        gap = centre - _centre(trajectory, int(other), rows)
        way = every * (speed[:, b] + speed[:, other])
        close |= np.sqrt((gap**2).sum(axis=1)) < radii[b] + radii[other] + way
    way = every * speed[:, b]
    if facts.geom_pos is None and facts.ground_z is not None:
        close |= centre[:, 2] - facts.ground_z < radii[b] + way
    for g in _world_geoms(trajectory):
        close |= _distance_to_geom(trajectory, g, centre) < radii[b] + way
    return close


def sleeps_supported(trajectory: Trajectory, b: int, row: int) -> bool:
    """Whether a body that stands still to the last bit may simply sleep on something: then the engine computes no contacts.

    The world lets bodies sleep, and the lowest corner of the body's box lies within a fiftieth of its size of something.
    """
    flags = trajectory.meta.get("flags") or {}
    facts = trajectory.mechanics
    if "SLEEP" not in {str(name).upper() for name in flags.get("enabled", ())} or facts.half_extents is None:
        return False
    after = min(row + 1, len(trajectory.t) - 1)
    if not (trajectory.pos[row, b] == trajectory.pos[after, b]).all() or np.isnan(facts.half_extents[b]).any():
        return False
    here = slice(row, row + 1)
    signs = np.array(list(itertools.product((-1, 1), repeat=3)))
    corners = _centre(trajectory, b, here) + (signs * facts.half_extents[b]) @ matrices(trajectory.quat[here, b])[0].T
    near = 0.02 * trajectory.size_m[b]
    lowest = corners[corners[:, 2] < corners[:, 2].min() + near]
    if any((_distance_to_geom(trajectory, g, lowest) < near).any() for g in _world_geoms(trajectory)):
        return True
    others = [other for other in range(len(trajectory.names)) if other != b]
    return any(_inside_box(trajectory, other, row, lowest, near) for other in others)


def _inside_box(trajectory: Trajectory, b: int, row: int, points: Array, near: float) -> bool:
    """Whether one of the points (N, 3) lies within `near` of a body's box."""
    half = trajectory.mechanics.half_extents
    if half is None or np.isnan(half[b]).any():
        return False
    here = slice(row, row + 1)
    local = (points - _centre(trajectory, b, here)) @ matrices(trajectory.quat[here, b])[0]
    return bool((np.abs(local) < half[b] + near).all(axis=1).any())


def _centre(trajectory: Trajectory, b: int, rows: slice) -> Array:
    middle = trajectory.mechanics.center
    if middle is None or not np.any(middle[b]):
        return trajectory.pos[rows, b]
    return trajectory.pos[rows, b] + matrices(trajectory.quat[rows, b]) @ middle[b]


def _world_geoms(trajectory: Trajectory) -> Array:
    facts = trajectory.mechanics
    if facts.geom_pos is None or facts.geom_body is None or facts.geom_collides is None:
        return np.zeros(0, dtype=int)
    return np.flatnonzero((facts.geom_body < 0) & facts.geom_collides)


def _distance_to_geom(trajectory: Trajectory, g: int, points: Array) -> Array:
    """(N,) m: distance of points (N, 3) from the box of one of the world's geoms; 0 inside."""
    facts = trajectory.mechanics
    assert facts.geom_pos is not None and facts.geom_quat is not None and facts.geom_half_extents is not None
    local = (points - facts.geom_pos[g]) @ matrices(facts.geom_quat[g])
    if facts.geom_type[g] == "plane":
        return np.maximum(local[:, 2], 0.0)
    outside = np.maximum(np.abs(local) - facts.geom_half_extents[g], 0.0)
    return np.sqrt((outside**2).sum(axis=1))
