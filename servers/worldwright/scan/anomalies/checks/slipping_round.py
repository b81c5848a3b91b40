"""A round body slips where it touches, and friction does nothing about it: no rolling, no slowing, or wheels that turn
backwards.

What it means: contacts without friction (condim 1, a friction of nothing), a motion that was written, a recording whose
spin is another body's. Friction at a slipping contact changes spin and speed until the body rolls.

Formula: for a sphere, or a lying cylinder or capsule, of radius r: slip = v - w r in the plane of its motion. Loose
bodies: for 0.4 s in contact the slip exceeds 0.3 of the larger of v and w r, and 0.3 sqrt(g r), while r dw/dt stays under
0.05 g. Wheels on joints: for 1 s in contact, w r is turned against the travel, by more than 0.3 v, and v keeps within a
tenth.
Threshold: friction of 0.1 would give a ball 0.25 g. A warning: ice may be meant.
Source: Goldstein, Classical Mechanics, rolling constraint v = w x r; slip of a ball, r dw/dt = 5/2 mu g.
"""

from collections.abc import Iterator
from functools import cache

import numpy as np

from worldkit.turning import matrices

from ....model.recording.trajectory import Trajectory
from ...known import modelled
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS143"
NEEDS = ("touching", "mechanics.geom_type", "mechanics.geom_pos", "mechanics.unforced")
HELD_S, LONG_S, SHARE, TURNING = 0.4, 1.0, 0.3, 0.05
ROUND = {"sphere": None, "cylinder": 2, "capsule": 2}


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the round bodies that slip for nothing."""
    touching, facts = trajectory.touching, trajectory.mechanics
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    if (
        touching is None
        or g == 0
        or facts.unforced is None
        or {"surface velocity", "flexes", "mocap"} & set(facts.drives)
    ):
        return
    rows = max(4, round(HELD_S / trajectory.interval_s))
    long = survey(trajectory).touches.sum(axis=0) >= rows
    for b in np.flatnonzero(trajectory.moves_freely & long):
        radius, axis = _round(trajectory, int(b))
        if radius is None:
            continue
        for first, last in spans(touching[:, b], bridge=2):
            if last - first >= rows and (sign := _slips(trajectory, context, int(b), slice(first, last), radius, axis)):
                yield sign
                break


def _slips(
    trajectory: Trajectory, context: Context, b: int, held: slice, radius: float, axis: np.ndarray | None
) -> Sign | None:
    """Judge a round body over a stretch of touch by its radius (m) and its axis in its own frame (None: a sphere)."""
    t, facts = trajectory.t[held], trajectory.mechanics
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    spin, velocity, speed = trajectory.angvel[held, b], trajectory.linvel[held, b], trajectory.speed[held, b]
    lying = np.ones(len(spin), dtype=bool)
    if axis is not None:
        lying = np.abs((matrices(trajectory.quat[held, b]) @ axis)[:, 2]) < 0.3
    ahead = velocity / np.maximum(speed, 1e-9)[:, None]
    up = np.array([0.0, 0.0, 1.0]) - ahead[:, 2:] * ahead
    up /= np.maximum(np.sqrt((up**2).sum(axis=1)), 1e-9)[:, None]
    rolling = (spin * np.cross(up, ahead)).sum(axis=1) * radius
    across = np.sqrt((spin[:, :2] ** 2).sum(axis=1)) * radius
    still = speed < 0.1 * trajectory.speed_scale[b]
    slip = np.where(still, across, np.abs(speed - rolling))
    fast = np.maximum(speed, across)
    touching = trajectory.touching
    slipping = lying & (slip > SHARE * fast) & (slip > SHARE * trajectory.speed_scale[b])
    if touching is not None:
        slipping &= touching[held, b]
    loose = facts.unforced is not None and bool(facts.unforced[b])
    if loose:
        slipping &= np.sqrt((np.gradient(spin, t, axis=0) ** 2).sum(axis=1)) * radius < TURNING * g
    else:
        slipping &= (rolling < -SHARE * speed) & ~still
    least = max(4, round((HELD_S if loose else LONG_S) / trajectory.interval_s))
    for start, stop in spans(slipping, bridge=2):
        part = slice(start, stop)
        if stop - start < least or (not loose and np.ptp(speed[part]) > 0.5 * speed[part].mean()):
            continue
        name = trajectory.names[b]
        severity = "info" if context.acts_on(name, ("pose", "velocity", "force", "torque", "control")) else "warn"
        message = (
            f"{name} is round and slips at {np.median(slip[part]):.3g} m/s where it touches, and neither its spin nor "
            "its speed takes notice"
        )
        share = float(np.median(slip[part] / np.maximum(fast[part], 1e-9)))
        return Sign(name, (t[start], t[stop - 1]), share, SHARE, "of rolling", severity, message)
    return None


def _round(trajectory: Trajectory, b: int) -> tuple[float | None, np.ndarray | None]:
    """Radius (m) and axis in the body's frame (None for a sphere) of a body whose only solid geom is round and central."""
    facts = trajectory.mechanics
    if (
        facts.geom_body is None
        or facts.geom_half_extents is None
        or facts.geom_collides is None
        or facts.geom_pos is None
    ):
        return None, None
    own = np.flatnonzero((facts.geom_body == b) & facts.geom_collides)
    if len(own) != 1 or facts.geom_type[own[0]] not in ROUND or facts.geom_quat is None:
        return None, None
    half = facts.geom_half_extents[own[0]]
    if np.sqrt((facts.geom_pos[own[0]] ** 2).sum()) > 0.1 * half.min():
        return None, None
    if facts.geom_type[own[0]] == "sphere":
        return float(half[0]), None
    return float(half[0]), matrices(facts.geom_quat[own[0]])[:, 2]


@cache
def _thrown(friction: float) -> Trajectory:
    ball = f'<body name="ball" pos="0 0 0.1"><freejoint/><geom size="0.1" mass="1" friction="{friction}"/></body>'

    def start(model: object, data: "modelled.Any") -> None:
        data.qvel[0] = 3.0

    xml = modelled.scene(ball).replace('type="plane"', f'type="plane" friction="{friction}"')
    return modelled.run(xml, 1.5, start)


GOOD = (lambda: Case("a ball that slides until it rolls", _thrown(0.5)),)
BAD = (lambda: Case("a ball on a floor without friction", _thrown(0.0), severity="warn"),)
