"""Find the cars of `vehicles.add` in a compiled world, with what a driver's commands need to know of them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .car_numbers import CORNERS, Car

if TYPE_CHECKING:
    import mujoco


@dataclass(frozen=True)
class FoundCar:
    """What `pedals` reads of a car."""

    wheelbase_m: float
    track_m: float
    steering_deg: float
    drive_n_m: float
    driven_wheels: tuple[str, ...]
    power_w: float = Car.power_w
    """Which no world tells: a car's own."""
    corners = CORNERS
    steered_wheels = CORNERS[:2]

    @property
    def drives(self) -> dict[str, tuple[str, ...]]:
        """Its motor, with the wheels that share its moment."""
        return {"drive": self.driven_wheels}


def controls(name: str) -> tuple[str, ...]:
    """Names of the actuators that `pedals` writes of a car."""
    steering = [f"{name}_steer_{corner}" for corner in CORNERS[:2]]
    return (*steering, f"{name}_drive", *(f"{name}_brake_{corner}" for corner in CORNERS))


def find_cars(model: "mujoco.MjModel") -> dict[str, FoundCar]:
    """The cars by their names; what has all of a car's actuators, hubs and shafts is one."""
    found = {}
    known = {model.actuator(i).name for i in range(model.nu)}
    for body in range(1, model.nbody):
        name = model.body(body).name
        brakes = {actuator for actuator in known if actuator.startswith(f"{name}_brake_")}
        # A truck has a car's corners and more axles between: its numbers are others.
        if (
            name
            and known.issuperset(controls(name))
            and brakes <= set(controls(name))
            and (car := _measured(model, name)) is not None
        ):
            found[name] = car
    return found


def _measured(model: "mujoco.MjModel", name: str) -> FoundCar | None:
    """Its numbers, out of where its hubs stand, how far they are steered, and which axles the shafts wrap."""
    from math import atan, degrees, radians, tan

    try:
        places = {corner: model.body(f"{name}_{corner}_hub").pos for corner in CORNERS}
        most = degrees(float(model.joint(f"{name}_fl_steer").range[1])) - 1.0
        shafts = model.tendon(f"{name}_drive_shafts").id
        drive = float(model.actuator(f"{name}_drive").ctrlrange[1])
    except KeyError:
        return None
    wheelbase, track = float(places["fl"][0] - places["rl"][0]), float(places["fl"][1] - places["fr"][1])
    if not (wheelbase > 0 and track > 0 and 0 < most < 85):
        return None
    # The joint lets the inner wheel turn as far as it must; a driver's angle is that of the wheel in the middle.
    middle = atan(wheelbase / (wheelbase / tan(radians(most)) + track / 2))
    first = int(model.tendon_adr[shafts])
    wrapped = {int(joint) for joint in model.wrap_objid[first : first + int(model.tendon_num[shafts])]}
    driven = tuple(corner for corner in CORNERS if model.joint(f"{name}_{corner}_axle").id in wrapped)
    return FoundCar(wheelbase, track, degrees(middle), drive, driven)
