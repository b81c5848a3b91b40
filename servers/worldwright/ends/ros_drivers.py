"""Peers of a ROS 2 network as drivers of a live world: each takes a seat, its words checked as those of a page are.

    /CAR/drive, /drive        worldwright_msgs/Drive: steering (rad, to the left), throttle, brake, all three at once
    /CAR/cmd_vel, /cmd_vel    geometry_msgs/Twist: speed ahead (linear.x, m/s) and turn (angular.z, rad/s) that a car is to have
    /command/NAME             std_msgs/Float64: one declared command, in its own unit

Topics without a car's name are those of the car that is followed. The wheel goes to the first who speaks while it is free;
who has said nothing for two seconds, or has left the network, gives it back. Stamps of messages are not read, so a peer's
clock may jump.
"""

import json
import math
import time
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from .ros_node import Sender
from .seats import Refusal, Seat, Seats

if TYPE_CHECKING:
    import mujoco

    from worldkit.vehicles import Bicycle
    from worldkit.vehicles.found_cars import FoundCar

NAMELESS_S = 2.0
"""Who has not told the name of its node is heard after so long."""
SILENT_S = 2.0
BARRED_S = 5.0
"""Who floods is not heard for so long."""
GAIN_S = 2.0
"""A car makes up for a lack of speed at twice of it a second (as `worldkit.vehicles.path_following` does)."""
ROLLING, GRAVITY = 0.015, 9.81
STANDS_M_S = 0.05


class RosDrivers:
    """The seats of those who speak over the network.

    Args:
        seats: of the world.
        told: called with each refusal and the name of whom it concerns, once for each new cause.
        clock: of the wall, s.
    """

    def __init__(
        self, seats: Seats, told: Callable[[str, Refusal], object], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._seats, self._told, self._clock = seats, told, clock
        self._here: dict[str, tuple[Seat, float]] = {}
        self._causes: dict[str, str] = {}
        self._first: dict[str, float] = {}
        self._barred: dict[str, float] = {}
        self._number = 0

    def hear(self, sender: Sender, values: dict[str, float]) -> None:
        """Take the commands that a peer sent."""
        who, now = sender.participant, self._clock()
        if now < self._barred.get(who, -math.inf):
            return
        if not sender.node and now - self._first.setdefault(who, now) < NAMELESS_S:
            return
        if who not in self._here:
            seat = self._seats.sit(sender.node or "a ROS 2 node", f"ROS 2, participant {who[:24]}")
            if isinstance(seat, Refusal):
                self._tell(who, sender.node, seat)
                return
        else:
            seat = self._here[who][0]
        self._here[who] = (seat, now)
        if not seat.drives and self._seats.driver is None:
            self._seats.take(seat)
        self._number += 1
        refusal = seat.say(json.dumps({"kind": "drive", "n": self._number, "values": values}))
        if refusal is None:
            self._causes.pop(who, None)
            return
        self._tell(who, seat.name, refusal)
        if refusal.leave:
            self._leave(who)
            self._barred[who] = now + BARRED_S

    def settle(self, present: Collection[str]) -> None:
        """Let those go who have left the network, or have said nothing for too long.

        Args:
            present: participants that can be heard.
        """
        now = self._clock()
        for who, (_, spoke) in list(self._here.items()):
            if who not in present or now - spoke > SILENT_S:
                self._leave(who)
        self._barred = {who: until for who, until in self._barred.items() if now < until}
        self._causes = {who: cause for who, cause in self._causes.items() if who in present}
        self._first = {who: since for who, since in self._first.items() if who in present}

    def close(self) -> None:
        """All of them leave."""
        for who in list(self._here):
            self._leave(who)

    def _leave(self, who: str) -> None:
        self._here.pop(who)[0].leave()

    def _tell(self, who: str, name: str, refusal: Refusal) -> None:
        if self._causes.get(who) != refusal.cause:
            self._causes[who] = refusal.cause
            self._told(name, refusal)


def of_drive(car: str, message: Any) -> dict[str, float]:
    """The commands of a worldwright_msgs/Drive."""
    return {
        f"{car}.steering": math.degrees(message.steering),
        f"{car}.throttle": message.throttle,
        f"{car}.brake": message.brake,
    }


def of_twist(name: str, car: "FoundCar | Bicycle", mass_kg: float, speed: float, message: Any) -> dict[str, float]:
    """The commands that bring a car from a speed, m/s, to that of a geometry_msgs/Twist, and onto its circle.

    What cannot be turned into commands (no finite number) becomes one that is refused.
    """
    wanted, turn = float(message.linear.x), float(message.angular.z)
    if not (math.isfinite(wanted) and math.isfinite(turn)):
        return dict.fromkeys((f"{name}.steering", f"{name}.throttle", f"{name}.brake"), math.nan)
    ahead = wanted if abs(wanted) > STANDS_M_S else speed
    if abs(ahead) > STANDS_M_S:
        steering = math.degrees(math.atan(car.wheelbase_m * turn / ahead))
    else:
        steering = math.copysign(car.steering_deg, turn) if turn else 0.0
    throttle, brake = 0.0, 0.0
    acceleration = GAIN_S * (wanted - speed)
    if abs(wanted) <= STANDS_M_S and abs(speed) <= STANDS_M_S:
        brake = 1.0
    elif acceleration * speed < 0 and abs(speed) > STANDS_M_S:
        brake = min(abs(acceleration) / GRAVITY, 1.0)
    else:
        force = mass_kg * (acceleration + math.copysign(ROLLING * GRAVITY, wanted))
        throttle = force * car.wheel_radius_m / car.drive_n_m if car.drive_n_m else 0.0
    values = {"steering": _within(steering, car.steering_deg), "throttle": _within(throttle, 1.0), "brake": brake}
    return {f"{name}.{pedal}": value for pedal, value in values.items()}


def mass_kg(model: "mujoco.MjModel", car: str) -> float:
    """Of a car with all that hangs on it, kg."""
    return float(model.body_subtreemass[model.body(car).id])


def _within(value: float, most: float) -> float:
    return min(max(value, -most), most)
