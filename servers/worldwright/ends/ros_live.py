"""A live world on a ROS 2 network: it publishes what a recording of it would hold, and instruments; it hears who drives.

Published 25 times a second of the wall clock, in the topics of `ros_rows` with simulated stamps (`use_sim_time`), and besides

    /odom, /imu        of the body that is followed
    /scan              a ring of distances about it, if asked for, whose frame BODY/lidar stands in /tf_static
    /camera/compressed, /camera/image_raw    the pictures of the page, whose frame is the camera's name, if asked for
    /rosout            what is refused, with cause and next move

While the world waits or stands, only the clock is told at this rate, all else once a second. What is heard: `ros_drivers`.
"""

import os
import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from ..model.errors import NotFoundError
from .live_row import LiveRow
from .ros_drivers import RosDrivers, mass_kg, of_drive, of_twist
from .ros_messages import Told, stamp
from .ros_node import MOST_DOMAIN, Publisher, RosNode, Sender, check
from .ros_rows import states, topics
from .ros_sensors import Imu, Lidar
from .ros_types import DRIVE
from .seats import Refusal, Seats

if TYPE_CHECKING:
    from .chase_pictures import PictureThread
    from .live_world import LiveWorld

RATE_HZ, STANDING_HZ, SETTLES_HZ = 25.0, 1.0, 5.0
TF, DEPTHS = "tf2_msgs/msg/TFMessage", {"/tf": 100}
WARN = 30
Images = Literal["none", "compressed", "raw"]


@dataclass(frozen=True)
class RosAsked:
    """What is asked of the network's end."""

    node: str = "worldwright"
    domain: int = 0
    interface: str = ""
    """Another than loopback; whoever reaches it may drive."""
    images: Images = "none"
    lidar: bool = False

    def __post_init__(self) -> None:
        check(self.node, self.domain)


def own_domain() -> int:
    """The domain that the environment names (`ROS_DOMAIN_ID`), 0 without it; a `NotFoundError` where it names none."""
    said = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not (said.isdecimal() and int(said) <= MOST_DOMAIN):
        raise NotFoundError(
            f"ROS_DOMAIN_ID is {said[:40]!r}, which is no domain",
            next_move=f"give --ros-domain from 0 to {MOST_DOMAIN}",
        )
    return int(said)


class RosEnd:
    """Serves one live world on a ROS 2 network, on a thread of its own, from its making until `close`.

    Args:
        world: the world.
        seats: who drives it.
        asked: how.
        followed: the body whose odometry and instruments are told.
        pictures: draws it; None where nothing is drawn.

    Attributes:
        problem: why it ended before its time.
        told: messages that were published.

    Raises:
        NotFoundError: the network cannot be joined, or pictures are asked for that nobody draws.
    """

    def __init__(
        self, world: "LiveWorld", seats: Seats, asked: RosAsked, followed: str, pictures: "PictureThread | None" = None
    ) -> None:
        from worldkit.vehicles.found_cars import find_cars

        if asked.images != "none" and (pictures is None or pictures.problem):
            raise NotFoundError(
                f"there are no pictures to publish{f': {pictures.problem}' if pictures else ''}",
                next_move="leave out --no-pictures, or --ros-images",
            )
        self._world, self._asked, self._pictures, self._followed = world, asked, pictures, followed
        self._row = LiveRow(world.source)
        self._row.stand(world.newest[1])
        self._told = Told(self._row)  # type: ignore[arg-type]
        self._imu = Imu(self._row, followed)
        self._lidar = Lidar(self._row, followed) if asked.lidar else None
        self._node = node = RosNode(asked.node, asked.domain, asked.interface)
        self._publishers: dict[str, Publisher] = {}
        self._rosout = node.publisher("/rosout", "rcl_interfaces/msg/Log", latched=True, depth=1000)
        self._drivers = RosDrivers(seats, self._refuse)
        self._cars = {
            name: (car, mass_kg(self._row.model, name))
            for name, car in find_cars(self._row.model).items()
            if any(row.car == name for row in world.commands)
        }
        self.problem, self.told = "", 0
        self._listen()
        for _, name, kind, _ in self._messages():
            self._publisher(name, kind)
        if asked.images != "none":
            self._publisher(*self._camera())
        self._still()
        node.announce()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._work, name="ros", daemon=True)
        self._thread.start()

    # -- what is heard -----------------------------------------------------------------------------------------------

    def _listen(self) -> None:
        node, own = self._node, topics(self._cars)
        first = self._followed if self._followed in self._cars else next(iter(self._cars), "")
        for at, car in [*zip(own, self._cars, strict=True), *([("", first)] if first else [])]:
            at = f"/{at}" if at else ""
            node.subscribe(f"{at}/drive", DRIVE, partial(self._drive, car))
            node.subscribe(f"{at}/cmd_vel", "geometry_msgs/msg/Twist", partial(self._twist, car))
        names = [row.name for row in self._world.commands]
        for part, name in zip(topics(names), names, strict=True):
            node.subscribe(f"/command/{part}", "std_msgs/msg/Float64", partial(self._command, name))

    def _drive(self, car: str, message: Any, who: Sender) -> None:
        self._drivers.hear(who, of_drive(car, message))

    def _command(self, name: str, message: Any, who: Sender) -> None:
        self._drivers.hear(who, {name: float(message.data)})

    def _twist(self, car: str, message: Any, who: Sender) -> None:
        found, mass = self._cars[car]
        self._drivers.hear(who, of_twist(car, found, mass, self._speed(car), message))

    def _speed(self, car: str) -> float:
        """Of a car, straight ahead, m/s."""
        row, body = self._row, self._row.names.index(car)
        return float(row.linvel[0, body] @ row.data.xmat[body + 1].reshape(3, 3)[:, 0])

    def _refuse(self, name: str, refusal: Refusal) -> None:
        self._rosout.send({
            "stamp": stamp(self._told.ns(0)), "level": WARN, "name": self._asked.node,
            "msg": f"{name or 'a ROS 2 node'}: {refusal.cause}; {refusal.next_move}",
        })  # fmt: skip

    # -- what is told ------------------------------------------------------------------------------------------------

    def _messages(self) -> list[tuple[int, str, str, dict[str, Any]]]:
        """All that is told of the state that stands."""
        found = list(states(self._told, [0]))
        ns = self._told.ns(0)
        body = self._row.names.index(self._followed)
        found.append((ns, "/odom", "nav_msgs/msg/Odometry", self._told.odometry(0, body)))
        found.append((ns, "/imu", "sensor_msgs/msg/Imu", self._imu.told()))
        if self._lidar is not None:
            found.append((ns, "/scan", "sensor_msgs/msg/LaserScan", self._lidar.told()))
        return found

    def _publisher(self, name: str, kind: str) -> Publisher:
        if name not in self._publishers:
            self._publishers[name] = self._node.publisher(name, kind, depth=DEPTHS.get(name, 10))
        return self._publishers[name]

    def _send(self, name: str, kind: str, message: dict[str, Any]) -> None:
        self.told += self._publisher(name, kind).send(message)

    def _still(self) -> None:
        """What stands fast, told once to whoever comes."""
        told = self._told.transforms(0, self._told.still)
        if self._lidar is not None:
            told["transforms"].append(self._lidar.mount())
        if told["transforms"]:
            self._node.publisher("/tf_static", TF, latched=True, depth=1).send(told)

    def _camera(self) -> tuple[str, str]:
        if self._asked.images == "raw":
            return "/camera/image_raw", "sensor_msgs/msg/Image"
        return "/camera/compressed", "sensor_msgs/msg/CompressedImage"

    def _picture(self, shown: int) -> int:
        """Publish the newest picture, where somebody looks and it is another than the one that was shown."""
        pictures, (name, kind) = self._pictures, self._camera()
        assert pictures is not None
        pictures.always = self._publisher(name, kind).heard
        number, jpeg = pictures.jpeg
        if not pictures.always or number == shown:
            return shown
        camera = pictures.camera or next(iter(pictures.cameras), "")
        if self._asked.images == "compressed":
            self._send(name, kind, self._told.picture(self._told.ns(0), jpeg, camera))
            return number
        image = pictures.image
        height, width = image.shape[:2]
        header = {"stamp": stamp(self._told.ns(0)), "frame_id": camera}
        self._send(name, kind, {
            "header": header, "height": height, "width": width, "encoding": "rgb8", "step": 3 * width, "data": image.tobytes(),
        })  # fmt: skip
        return number

    def _work(self) -> None:
        due = whole = settles = time.monotonic()
        shown, picture = None, 0
        try:
            while not self._ended.is_set():
                self._node.spin(due - time.monotonic())
                now = time.monotonic()
                if now >= settles:
                    settles = now + 1 / SETTLES_HZ
                    self._drivers.settle(self._node.present())
                if now < due:
                    continue
                due = max(due + 1 / RATE_HZ, now)
                state = self._world.newest[1]
                fresh = state is not None and (shown is None or float(state[0]) != float(shown[0]))
                if fresh:
                    self._row.stand(state)
                if fresh or now >= whole:
                    shown, whole = state, now + 1 / STANDING_HZ
                    for _, name, kind, message in self._messages():
                        self._send(name, kind, message)
                else:
                    self._send("/clock", "rosgraph_msgs/msg/Clock", self._told.clock(0))
                if self._asked.images != "none":
                    picture = self._picture(picture)
        except Exception as cause:  # the drive goes on without a network, and the failsafes act
            self.problem = f"no more ROS 2: {type(cause).__name__}: {cause}; drive on from the page, or begin again"
        finally:
            with suppress(Exception):
                self._drivers.close()
            if self._pictures is not None:
                self._pictures.always = False
            self._node.close()

    @property
    def missed(self) -> int:
        """Messages that were not sent, as a reader had not taken those before."""
        return sum(one.missed for one in self._publishers.values())

    @property
    def address(self) -> str:
        """The node, its domain and where it is."""
        return (
            f"/{self._asked.node} in domain {self._asked.domain} on {self._asked.interface or 'the loopback interface'}"
        )

    def close(self) -> None:
        """Leave the network."""
        self._ended.set()
        self._thread.join(10)
