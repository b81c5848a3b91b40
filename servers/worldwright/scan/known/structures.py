"""Joints, tendons, constraints and chains: recordings with generalised coordinates and loads."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...model.recording.coordinates import Coordinates
from ...model.recording.loads import Loads
from ...model.recording.trajectory import Trajectory
from .analytic import G, clock, motion

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


PROFILES = {
    "returns": lambda s: np.sin(np.pi * s) ** 2,
    "keeps": lambda s: np.minimum(2 * s, 1.0),
    "rings": lambda s: np.sin(3 * np.pi * s),
}
"""A deformation by the share of time passed: it returns, stays, or goes to and fro."""


def beam(profile: str = "returns", sag: float = 0.1, parts: int = 11, drift: float = 0.0, **more: Any) -> Trajectory:
    """A row of parts `beam_0` … along x, 1 m long, that sags as a parabola by up to `sag`; it may drift and turn.

    With `drift` the whole moves along x by so much (m) and turns about z by as many radians, which is no deformation.
    """
    t = clock(1.0)
    amount = PROFILES[profile](t)
    x = np.linspace(-0.5, 0.5, parts)
    shape = np.zeros((len(t), parts, 3))
    shape[:, :, 0] = x
    shape[:, :, 2] = 1.0 - sag * amount[:, None] * (1 - 4 * x**2)
    angle = drift * t
    turned = shape.copy()
    turned[:, :, 0] = np.cos(angle)[:, None] * shape[:, :, 0] + drift * t[:, None]
    turned[:, :, 1] = np.sin(angle)[:, None] * shape[:, :, 0]
    names = tuple(f"beam_{k}" for k in range(parts))
    return motion(t, turned, np.gradient(turned, t, axis=0), names=names, size_m=0.02, free=False, **more)


def stretched(strain: float = 0.2, profile: str = "keeps", tension: float = 50.0, **more: Any) -> Trajectory:
    """A `rope` (tendon) of 1 m between `left` and `right`, drawn out along x by the strain, with a tension in proportion."""
    t = clock(1.0)
    length = 1.0 + strain * PROFILES[profile](t)
    pos = np.zeros((len(t), 2, 3))
    pos[:, 1, 0], pos[:, :, 2] = length, 1.0
    made = motion(t, pos, np.gradient(pos, t, axis=0), names=("left", "right"), free=False, **more)
    return with_channels(made, tendons={"rope": (length, tension * np.abs(length - 1.0) / max(abs(strain), 1e-9))})


def breaking(load_n: float | None = 100.0, rate: float = 200.0, **more: Any) -> Trajectory:
    """Two bodies hung from each other: `bolt` carries a load growing at `rate` N/s and lets go at `load_n`; `pin` holds.

    Afterwards `lower` falls freely. With None nothing breaks.
    """
    t = clock(1.0)
    moment = np.inf if load_n is None else load_n / rate
    whole = t <= moment
    fallen = np.where(whole, 0.0, t - moment) if np.isfinite(moment) else 0 * t
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    pos[:, 0, 2], pos[:, 1, 2] = 10.0, 9.8 - G * fallen**2 / 2
    vel[:, 1, 2] = -G * fallen
    made = motion(t, pos, vel, names=("upper", "lower"), free=False, **more)
    load = np.where(whole, rate * t, 0.0)
    always = np.ones(len(t), dtype=bool)
    return with_channels(made, equalities={"bolt": (whole, load), "pin": (always, 10.0 + 0 * t)})


def stressed(stress_pa: float) -> Trajectory:
    """As `breaking` at 100 N, where the bolt is a bond whose stress grows with its force, up to `stress_pa`."""
    made = breaking(100.0)
    assert made.loads is not None
    return replace(made, loads=replace(made.loads, eq_stress=made.loads.eq_force * stress_pa / 100.0))


def twisted(torque_nm: float, rate: float = 200.0) -> Trajectory:
    """As `breaking` at 100 N, where the bolt is a weld whose torque grows with its force, up to `torque_nm`."""
    made = breaking(100.0, rate)
    assert made.loads is not None
    return replace(made, loads=replace(made.loads, eq_torque=made.loads.eq_force * torque_nm / 100.0))
