"""Find the vehicles of `vehicles.add` in a compiled world, with what a driver's commands need to know of them."""

import re
from dataclasses import dataclass
from math import atan, atan2, degrees, radians, tan
from typing import TYPE_CHECKING

from .bicycle_numbers import Bicycle
from .car_numbers import Car
from .heavy_numbers import Bus, Truck
from .tracked_numbers import Tracked

if TYPE_CHECKING:
    import mujoco

HEAVY_KG = 3500.0
"""Four wheels that bear more are a bus's: cars end there (category M1 and N1, Directive 2007/46/EC)."""
CORNER = re.compile(r"[a-z0-9]+[lr]")


@dataclass(frozen=True)
class FoundCar:
    """What `pedals` reads of a vehicle on axles."""

    wheelbase_m: float
    track_m: float
    wheel_radius_m: float
    steering_deg: float
    drive_n_m: float
    corners: tuple[str, ...]
    """Names of its wheels, from the front to the back, left before right."""
    steered_wheels: tuple[str, ...]
    drives: dict[str, tuple[str, ...]]
    """Its motors, each with the wheels that share its moment."""
    belts: tuple[tuple[str, ...], ...]
    """Of a tracked vehicle."""
    power_w: float
    """Which no world tells: that of the kind whose axles and mass it has."""

    def actuators(self, name: str) -> tuple[str, ...]:
        """Names of what `pedals` writes."""
        steering = (f"{name}_steer_{corner}" for corner in self.steered_wheels)
        return (*steering, *(f"{name}_{drive}" for drive in self.drives), *(f"{name}_brake_{c}" for c in self.corners))


def find_cars(model: "mujoco.MjModel") -> dict[str, FoundCar | Bicycle]:
    """The vehicles that drive by themselves, by their names; what has all actuators, hubs and shafts of one is one."""
    found: dict[str, FoundCar | Bicycle] = {}
    known = {model.actuator(i).name for i in range(model.nu)}
    for body in range(1, model.nbody):
        name = model.body(body).name
        brakes = {
            actuator.removeprefix(f"{name}_brake_") for actuator in known if actuator.startswith(f"{name}_brake_")
        }
        if not name or not brakes:
            continue
        try:
            one = _bicycle(model, body, name) if brakes == {"f", "r"} else _on_axles(model, name, brakes, known)
        except (LookupError, ValueError, ZeroDivisionError):  # an odd world's, as one whose wheels are all on one side
            continue
        if one is not None and known.issuperset(one.actuators(name)):
            found[name] = one
    return found


def _on_axles(model: "mujoco.MjModel", name: str, corners: set[str], known: set[str]) -> FoundCar | None:
    """Its numbers, out of where its hubs stand, how far they are steered, and which axles the shafts wrap."""
    if not all(CORNER.fullmatch(corner) for corner in corners) or len(corners) < 4:
        return None
    places = {corner: model.body(f"{name}_{corner}_hub").pos for corner in corners}
    order = tuple(sorted(corners, key=lambda corner: (-round(places[corner][0], 6), -places[corner][1])))
    steered = tuple(corner for corner in order if f"{name}_steer_{corner}" in known)
    motors = [motor for motor in ("drive", "drive_l", "drive_r") if f"{name}_{motor}" in known]
    left, right = (tuple(corner for corner in order if corner.endswith(side)) for side in "lr")
    ahead, behind = (
        [float(places[c][0]) for c in some]
        for some in ((steered, [c for c in order if c not in steered]) if steered else (order[:2], order[-2:]))
    )
    wheelbase, track = (
        sum(ahead) / len(ahead) - sum(behind) / len(behind),
        float(places[left[0]][1] - places[right[0]][1]),
    )
    if not (wheelbase > 0 and track > 0 and motors):
        return None
    belts: tuple[tuple[str, ...], ...] = ()
    if len(steered) == 2 and motors == ["drive"]:
        most = degrees(float(model.joint(f"{name}_{steered[0]}_steer").range[1])) - 1.0
        if not 0 < most < 85:
            return None
        # The joint lets the inner wheel turn as far as it must; a driver's angle is that of the wheel in the middle.
        steering, power = degrees(atan(wheelbase / (wheelbase / tan(radians(most)) + track / 2))), Car.power_w
        if len(order) > 4:
            power = Truck.power_w
        elif float(model.body_mass[model.body(name).id]) > HEAVY_KG:  # without what it pulls
            power = Bus.power_w
    elif not steered and motors == ["drive_l", "drive_r"]:
        steering, power, belts = Tracked.steering_deg, Tracked.power_w, (left, right)
    else:
        return None
    return FoundCar(
        wheelbase, track, float(model.geom(f"{name}_{order[0]}_wheel").size[0]), steering,
        sum(float(model.actuator(f"{name}_{motor}").ctrlrange[1]) for motor in motors), order, steered,
        {motor: _wrapped(model, name, motor, order) for motor in motors}, belts, power,
    )  # fmt: skip


def _wrapped(model: "mujoco.MjModel", name: str, motor: str, corners: tuple[str, ...]) -> tuple[str, ...]:
    """The wheels on the shafts of a motor."""
    shafts = model.tendon(f"{name}_{motor}_shafts").id
    first = int(model.tendon_adr[shafts])
    wrapped = {int(joint) for joint in model.wrap_objid[first : first + int(model.tendon_num[shafts])]}
    return tuple(corner for corner in corners if model.joint(f"{name}_{corner}_axle").id in wrapped)


def _bicycle(model: "mujoco.MjModel", body: int, name: str) -> Bicycle:
    """Its numbers, out of its hubs, its steering axis and its masses; how quick its rider is, no world tells."""
    fork, joint = model.body(f"{name}_fork").id, model.joint(f"{name}_steer")
    front, rear = (model.geom(f"{name}_{corner}_wheel") for corner in "fr")
    radius, tilt = float(front.size[0]), atan2(-float(joint.axis[0]), float(joint.axis[2]))
    hub, back = float(model.body_pos[fork][0]), float(model.body(f"{name}_r_wheel").pos[0])
    parts = [(body, 0.0, 0.0), (fork, hub, 0.0), (int(front.bodyid[0]), hub, 0.0), (int(rear.bodyid[0]), back, 0.0)]
    mass = sum(float(model.body_mass[part]) for part, _, _ in parts)
    ahead, above = (
        sum(float(model.body_mass[part]) * (at[axis] + float(model.body_ipos[part][2 * axis])) for part, *at in parts)
        / mass
        for axis in (0, 1)
    )
    wheelbase = hub - back
    return Bicycle(
        wheelbase_m=wheelbase, trail_m=radius * tan(tilt) + float(joint.pos[0]), head_deg=degrees(tilt), mass_kg=mass,
        height_of_mass_m=radius + above, front_share=(ahead - back) / wheelbase, wheel_radius_m=radius,
        wheel_kg=float(model.body_mass[rear.bodyid[0]]), fork_kg=float(model.body_mass[fork]),
        drive_n_m=float(model.actuator(f"{name}_drive").ctrlrange[1]), steering_deg=degrees(float(joint.range[1])) - 1.0,
        length_m=max(Bicycle.length_m, wheelbase + 2 * radius), height_m=max(Bicycle.height_m, 2.5 * radius),
    )  # fmt: skip
