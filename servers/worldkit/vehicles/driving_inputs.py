"""What a driver does (steering, throttle, brake) as controls of a vehicle's actuators.

A brake's moment is `brake` times its most, against the wheel's turning, whatever the speed: the damper's share is set so. A wheel that
stands is held. The engine's moment falls with speed where its power says so.
"""

import itertools
from dataclasses import dataclass
from math import radians, tan
from typing import TYPE_CHECKING

from .adding import Vehicle
from .axles import OnAxles
from .bicycle_numbers import Bicycle
from .two_wheels import balanced
from .wheeled import BRAKE_GAIN, ackermann

if TYPE_CHECKING:
    import mujoco

    from .found_cars import FoundCar

STILL_RAD_S = 1e-6
STEERING_GAIN_S_M = 8.0
"""Of a tracked vehicle's driver: its whole moment where an eighth of a metre a second is lacking between its sides."""


@dataclass(frozen=True)
class Commands:
    """Of a driver at one instant."""

    steering_deg: float = 0.0
    """Of the front wheels in the middle, to the left; kept within the vehicle's most."""
    throttle: float = 0.0
    """-1 (backwards) to 1, of the drive's most."""
    brake: float = 0.0
    """0 to 1, of the brakes' most."""


@dataclass(frozen=True)
class Timed:
    """A driver who does what a list says: `(t_s, commands)`, in order; between two of them from the one to the other in a line.

    Raises ValueError where the times do not grow.
    """

    steps: tuple[tuple[float, Commands], ...]

    def __post_init__(self) -> None:
        times = [t for t, _ in self.steps]
        if not times or any(b < a for a, b in itertools.pairwise(times)):
            raise ValueError(f"a driver's inputs need times that grow, got {times}")

    def commands(self, data: "mujoco.MjData", name: str) -> Commands:  # noqa: ARG002 (as another driver is asked)
        """What to do now."""
        now, before = float(data.time), self.steps[0]
        for after in self.steps:
            if now < after[0]:
                share = (now - before[0]) / (after[0] - before[0]) if after[0] > before[0] else 1.0
                share = min(max(share, 0.0), 1.0)
                pairs = zip(vars(before[1]).values(), vars(after[1]).values(), strict=True)
                return Commands(*(a + share * (b - a) for a, b in pairs))
            before = after
        return before[1]


def pedals(
    vehicle: "Vehicle | FoundCar",
    model: "mujoco.MjModel",  # noqa: ARG001 (as `control` is called)
    data: "mujoco.MjData",
    name: str,
    *,
    steering_deg: float = 0.0,
    throttle: float = 0.0,
    brake: float = 0.0,
    power_w: float | None = None,
) -> None:
    """Write a driver's commands into `data.ctrl`; call it in `control(model, data)` at every step.

    A bicycle's rider balances besides; a tracked vehicle steers by its belts. The plan declares controls of all
    `vehicle.actuators(NAME)`, or has the vehicle as a row.
    """
    spins = {corner: float(data.joint(f"{name}_{corner}_axle").qvel[0]) for corner in vehicle.corners}
    throttle, steering_deg = min(max(throttle, -1.0), 1.0), _within(steering_deg, vehicle.steering_deg)
    power = power_w or vehicle.power_w
    if isinstance(vehicle, Bicycle):
        data.actuator(f"{name}_steer_f").ctrl[0] = balanced(vehicle, data, name, steering_deg)
        data.actuator(f"{name}_drive").ctrl[0] = _within_power(throttle * vehicle.drive_n_m, abs(spins["r"]), power)
    elif vehicle.belts:
        _belts(vehicle, data, name, spins, steering_deg, throttle, power)
    else:
        _on_axles(vehicle, data, name, spins, steering_deg, throttle, power)
    share = min(max(brake, 0.0), 1.0)
    for corner, spin in spins.items():
        data.actuator(f"{name}_brake_{corner}").ctrl[0] = (
            min(share / (BRAKE_GAIN * max(abs(spin), STILL_RAD_S)), 1.0) if share else 0.0
        )


def _on_axles(
    vehicle: "OnAxles | FoundCar",
    data: "mujoco.MjData",
    name: str,
    spins: dict[str, float],
    steering_deg: float,
    throttle: float,
    power: float,
) -> None:
    if steered := vehicle.steered_wheels:
        for corner, angle in zip(steered, ackermann(vehicle, radians(steering_deg)), strict=True):
            data.actuator(f"{name}_steer_{corner}").ctrl[0] = angle
    for drive, corners in vehicle.drives.items():
        turning = max(abs(spins[corner]) for corner in corners)
        data.actuator(f"{name}_{drive}").ctrl[0] = _within_power(throttle * vehicle.drive_n_m, turning, power)


def _belts(
    vehicle: "OnAxles | FoundCar",
    data: "mujoco.MjData",
    name: str,
    spins: dict[str, float],
    steering_deg: float,
    throttle: float,
    power: float,
) -> None:
    """Motors of two belts: half of the throttle's moment each, and against each other what lets it turn as its driver wants.

    Wanted is the circle that a car of this wheelbase would ride, R = wheelbase / tan(steering). The belts skid on it, how much the
    ground decides: the driver looks at how fast the vehicle turns, and steers more or less.
    """
    left, right = (spins[belt[0]] * vehicle.wheel_radius_m for belt in vehicle.belts)
    middle = (left + right) / 2
    wanted = middle * tan(radians(steering_deg)) / vehicle.wheelbase_m
    lacking = (wanted - float(data.joint(name).qvel[5])) * vehicle.track_m if steering_deg or abs(middle) > 0.1 else 0.0
    most = vehicle.drive_n_m / 2
    steer = _within(STEERING_GAIN_S_M * most * lacking, most)
    for drive, side in (("drive_l", -1.0), ("drive_r", 1.0)):
        spin = abs(left if side < 0 else right) / vehicle.wheel_radius_m
        asked = _within_power(throttle * most, spin, power / 2) + side * steer
        data.actuator(f"{name}_{drive}").ctrl[0] = _within(asked, most)


def _within(value: float, most: float) -> float:
    return min(max(value, -most), most)


def _within_power(moment: float, turning: float, power: float) -> float:
    """A motor's moment, N·m, at a speed, rad/s, beyond which it has no more power, W."""
    return _within(moment, power / turning) if abs(moment) * turning > power else moment
