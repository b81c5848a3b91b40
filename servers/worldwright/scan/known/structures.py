"""Joints, tendons, constraints and chains: recordings with generalised coordinates and loads."""

from typing import Any

import numpy as np

from ...model.coordinates import Coordinates
from ...model.loads import Loads
from ...model.trajectory import Trajectory
from ..analytic import G, clock, motion

Array = np.ndarray


def with_channels(
    trajectory: Trajectory,
    *,
    joints: dict[str, Array] | None = None,
    tendons: dict[str, tuple[Array, Array]] | None = None,
    equalities: dict[str, tuple[Array, Array]] | None = None,
    slides: tuple[str, ...] = (),
) -> Trajectory:
    """The recording with joint positions (rad or m), tendons (length m, tension N), equalities (active, force N)."""
    from dataclasses import replace

    rows = len(trajectory.t)
    joints, tendons, equalities = joints or {}, tendons or {}, equalities or {}

    def columns(values: list[Array]) -> Array:
        return np.column_stack(values) if values else np.zeros((rows, 0))

    meta = {
        "joints": [
            {"name": name, "type": "slide" if name in slides else "hinge", "qpos_address": k}
            for k, name in enumerate(joints)
        ],
        "tendons": [{"name": name} for name in tendons],
        "equalities": [{"name": name} for name in equalities],
    }
    qpos = columns(list(joints.values()))
    active = columns([a for a, _ in equalities.values()]).astype(bool)
    return replace(
        trajectory,
        meta={**trajectory.meta, **meta},
        coordinates=Coordinates(
            qpos=qpos,
            qvel=np.gradient(qpos, trajectory.t, axis=0) if qpos.shape[1] else qpos,
            tendon_length=columns([length for length, _ in tendons.values()]),
            eq_residual=np.where(active, 0.0, np.nan),
        ),
        loads=Loads(
            eq_force=columns([force for _, force in equalities.values()]),
            eq_active=active,
            tendon_force=columns([tension for _, tension in tendons.values()]),
            actuator_force=np.zeros((rows, 0)),
            ctrl=np.zeros((rows, 0)),
        ),
    )


def hinged(final_deg: float = 30.0, seconds: float = 1.0, **more: Any) -> Trajectory:
    """A bar of 1 m turning evenly about a `hinge` along +y at (0, 0, 1 m)."""
    t = clock(seconds)
    rate = np.radians(final_deg) / seconds
    angle = rate * t
    pos = np.stack([0.5 * np.cos(angle), 0 * t, 1 - 0.5 * np.sin(angle)], axis=1)
    vel = rate * np.stack([-0.5 * np.sin(angle), 0 * t, -0.5 * np.cos(angle)], axis=1)
    quat = np.stack([np.cos(angle / 2), 0 * t, np.sin(angle / 2), 0 * t], axis=1)[:, None]
    spin = np.tile((0.0, rate, 0.0), (len(t), 1))[:, None]
    made = motion(t, pos, vel, quat=quat, angvel=spin, names=("bar",), free=False, **more)
    return with_channels(made, joints={"hinge": angle})
