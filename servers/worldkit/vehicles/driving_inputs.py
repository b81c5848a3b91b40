"""What a driver does (steering, throttle, brake) as controls of a car's actuators.

A brake's moment is `brake` times its most, against the wheel's turning, whatever the speed: the damper's share is set so. A wheel that
stands is held. The engine's moment falls with speed where its power says so.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .car_numbers import CORNERS, Car
from .four_wheels import BRAKE_GAIN, ackermann

if TYPE_CHECKING:
    import mujoco

POWER_W = 90_000.0
STILL_RAD_S = 1e-6


@dataclass(frozen=True)
class Commands:
    """Of a driver at one instant."""

    steering_deg: float = 0.0
    """Of the front wheels in the middle, to the left; kept within the car's most."""
    throttle: float = 0.0
    """-1 (backwards) to 1, of the drive's most."""
    brake: float = 0.0
    """0 to 1, of the brakes' most."""


def pedals(
    car: Car,
    model: "mujoco.MjModel",  # noqa: ARG001 (as `control` is called)
    data: "mujoco.MjData",
    name: str,
    *,
    steering_deg: float = 0.0,
    throttle: float = 0.0,
    brake: float = 0.0,
    power_w: float = POWER_W,
) -> None:
    """Write a driver's commands into `data.ctrl`; call it in `control(model, data)` at every step.

    The plan declares controls of `NAME_steer_fl`, `NAME_steer_fr`, `NAME_drive` and the four `NAME_brake_…`.
    """
    from math import radians

    most = car.steering_deg
    angles = ackermann(car, radians(min(max(steering_deg, -most), most)))
    for corner, angle in zip(CORNERS[:2], angles, strict=True):
        data.actuator(f"{name}_steer_{corner}").ctrl[0] = angle
    spins = {corner: float(data.joint(f"{name}_{corner}_axle").qvel[0]) for corner in CORNERS}
    turning = max(abs(spins[corner]) for corner in car.driven_wheels)
    moment = min(max(throttle, -1.0), 1.0) * car.drive_n_m
    if abs(moment) * turning > power_w:
        moment *= power_w / (abs(moment) * turning)
    data.actuator(f"{name}_drive").ctrl[0] = moment
    share = min(max(brake, 0.0), 1.0)
    for corner, spin in spins.items():
        data.actuator(f"{name}_brake_{corner}").ctrl[0] = (
            min(share / (BRAKE_GAIN * max(abs(spin), STILL_RAD_S)), 1.0) if share else 0.0
        )
