"""A round body travels over the ground without turning, and friction does not mind.

What it means: the motion was scripted, or the turning was lost on its way to the picture. Friction turns a sliding ball
until it rolls, within v / (3.5 mu g). One that turns without travelling is WS143's.

Formula: a body whose only colliding geom is a sphere, in contact and on a level way, for 0.4 s:
|w x r| < 0.1 v, with v > 0.3 sqrt(g r) and the deceleration less than a fifth of mu g.
Threshold: a tenth of rolling. Skipped where friction is under 0.05.
Source: Goldstein, Classical Mechanics, rolling constraint v = w x r.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS125"
RELATIVE = True
NEEDS = ("touching", "mechanics.geom_type", "mechanics.geom_friction", "mechanics.unforced")
WHOLE = True
HELD_S = 0.4
FRICTION = 0.05


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the round bodies that slide as if on ice."""
    facts, touching = trajectory.mechanics, trajectory.touching
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    if facts.geom_friction is None or facts.unforced is None or touching is None or g == 0:
        return
    rows = max(4, round(HELD_S / trajectory.interval_s))
    long = survey(trajectory).touches.sum(axis=0) >= rows - 1
    for b in np.flatnonzero(trajectory.moves_freely & facts.unforced & long):
        radius, friction = _round(trajectory, int(b))
        if radius is None or friction < FRICTION or not _stays_down(touching[:, b], rows):
            continue
        for start, stop in spans(steady_slide(trajectory, int(b), friction * g), bridge=1):
            if stop - start < rows:
                continue
            part = slice(start, stop)
            turning = np.sqrt((trajectory.angvel[part, b] ** 2).sum(axis=1)) * radius
            speed = trajectory.speed[part, b]
            if np.median(turning / speed) > 0.1:
                continue
            name = trajectory.names[b]
            message = f"{name} is round and travels at {np.median(speed):.3g} m/s without turning or slowing down"
            window = (trajectory.t[start], trajectory.t[stop - 1])
            share = float(np.median(turning / speed))
            severity = "info" if context.acts_on(name, ("pose", "velocity", "force")) else "blocking"
            yield Sign(name, window, share, 0.1, "of rolling", severity, message)
            break


def _stays_down(touching: np.ndarray, rows: int) -> bool:
    """Whether some contact lasts for so many rows."""
    runs = spans(touching, bridge=1)
    return len(runs) > 0 and int(np.diff(runs, axis=1).max()) >= rows - 1


def steady_slide(trajectory: Trajectory, b: int, slowing: float) -> np.ndarray:
    """(T,) bool: rows in which a body moves level, in contact, and loses less speed than friction (`slowing`) takes."""
    touching = trajectory.touching
    assert touching is not None
    speed = trajectory.speed[:, b]
    level = np.abs(trajectory.linvel[:, b, 2]) < 0.1 * speed
    moving = speed > 0.3 * trajectory.speed_scale[b]
    rate = np.gradient(speed, trajectory.t)
    return np.asarray(touching[:, b] & level & moving & (np.abs(rate) < 0.2 * slowing))


def _round(trajectory: Trajectory, b: int) -> tuple[float | None, float]:
    facts = trajectory.mechanics
    assert facts.geom_body is not None and facts.geom_collides is not None and facts.geom_half_extents is not None
    assert facts.geom_friction is not None
    own = np.flatnonzero((facts.geom_body == b) & facts.geom_collides)
    if len(own) != 1 or facts.geom_type[own[0]] != "sphere":
        return None, 0.0
    return float(facts.geom_half_extents[own[0]].min()), float(facts.geom_friction[own[0]])


def shaped(trajectory: Trajectory, kind: str, friction: float) -> Trajectory:
    """The motion of one body on a ground plane, with a geom of the given shape and friction."""
    half = trajectory.mechanics.half_extents
    assert half is not None
    facts = replace(
        trajectory.mechanics,
        geom_names=("ground", "body"),
        geom_body=np.array([-1, 0]),
        geom_type=("plane", kind),
        geom_pos=np.zeros((2, 3)),
        geom_quat=np.tile((1.0, 0, 0, 0), (2, 1)),
        geom_half_extents=np.stack([np.full(3, np.inf), half[0]]),
        geom_collides=np.array([True, True]),
        geom_friction=np.array([friction, friction]),
    )
    return replace(trajectory, mechanics=facts)


def _on_the_spot() -> Case:
    turning = analytic.rolling()
    still = replace(
        turning, pos=np.repeat(turning.pos[:1], len(turning.t), axis=0), linvel=np.zeros_like(turning.linvel)
    )
    return Case("a ball that spins on the spot", shaped(still, "sphere", 0.5))


GOOD = (
    _on_the_spot,
    lambda: Case("a rolling ball", shaped(analytic.rolling(), "sphere", 0.5)),
    lambda: Case("a ball braked by friction", shaped(analytic.sliding(3.0, 4.9), "sphere", 0.5)),
    lambda: Case("a ball on ice", shaped(analytic.sliding(3.0), "sphere", 0.01)),
)
BAD = (lambda: Case("a ball drawn along", shaped(analytic.rolling(slip=1.0), "sphere", 0.5), severity="blocking"),)
