"""The ROS 2 messages that a recording is told in, as their own definitions, and rows of it as such messages.

Definitions as of ROS 2 Jazzy (`rosgraph_msgs`, `tf2_msgs`, `sensor_msgs`, `nav_msgs`, `std_msgs`), without their comments.
Frames follow REP 103 and 105: metres, radians, z up, x forward; `world` is the fixed frame, a body's frame has its name, and
the twist of `nav_msgs/Odometry` is in the body's own frame. A message here is a dict of its fields.
"""

from typing import TYPE_CHECKING, Any

from worldkit.turning import matrices

if TYPE_CHECKING:
    import numpy as np

    from worldengine.recording.stored import Recording

WORLD = "world"
PARTS = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Transform": "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation",
    "geometry_msgs/TransformStamped": "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation",
    "geometry_msgs/PoseWithCovariance": "geometry_msgs/Pose pose\nfloat64[36] covariance",
    "geometry_msgs/Twist": "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular",
    "geometry_msgs/TwistWithCovariance": "geometry_msgs/Twist twist\nfloat64[36] covariance",
}
MESSAGES = {
    "rosgraph_msgs/msg/Clock": "builtin_interfaces/Time clock",
    "tf2_msgs/msg/TFMessage": "geometry_msgs/TransformStamped[] transforms",
    "sensor_msgs/msg/JointState": "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
    "nav_msgs/msg/Odometry": "std_msgs/Header header\nstring child_frame_id\n"
    "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist",
    "sensor_msgs/msg/CompressedImage": "std_msgs/Header header\nstring format\nuint8[] data",
    "std_msgs/msg/Float64": "float64 data",
}


def definition(message: str) -> str:
    """The definition of a message with those of its parts, as a bag's schema has it; KeyError for one that is not here."""
    texts, seen = [MESSAGES[message]], []
    for text in texts:
        for line in text.splitlines():
            part = line.split()[0].split("[")[0]
            if part in PARTS and part not in seen:
                seen.append(part)
                texts.append(PARTS[part])
    blocks = [f"{'=' * 80}\nMSG: {part}\n{PARTS[part]}\n" for part in seen]
    return "".join([texts[0] + "\n", *blocks])


class Told:
    """Rows of one recording as messages."""

    def __init__(self, recording: "Recording") -> None:
        import numpy as np

        self._recording = recording
        self.frames = list(recording.names)
        rows = recording.meta["bodies"]
        self.still = [index for index, row in enumerate(rows) if not row["dynamic"] and not row["mocap"]]
        """Bodies that stand fast."""
        self.moving = [index for index in range(len(rows)) if index not in set(self.still)]
        self.loose = [index for index, row in enumerate(rows) if row["joints"] == ["free"]]
        """Bodies that go where they like: each has an odometry."""
        self._joints = [row for row in recording.meta["joints"] if row["type"] in ("hinge", "slide")]
        self.joints = [row["name"] for row in self._joints]
        self._position, self._velocity = (
            np.array([row[key] for row in self._joints], int) for key in ("qpos_address", "dof_address")
        )
        self.controls = [row["name"] for row in recording.meta["actuators"]][: recording.meta["sizes"]["nu"]]

    def ns(self, row: int) -> int:
        """Simulated time of a row, nanoseconds."""
        return round(float(self._recording.time[row]) * 1e9)

    def clock(self, row: int) -> dict[str, Any]:
        """rosgraph_msgs/Clock."""
        return {"clock": stamp(self.ns(row))}

    def transforms(self, row: int, bodies: list[int]) -> dict[str, Any]:
        """tf2_msgs/TFMessage: these bodies in `world`."""
        found = [
            {
                "header": self._header(row),
                "child_frame_id": self.frames[body],
                "transform": {
                    "translation": xyz(self._recording.pos[row, body]),
                    "rotation": turn(self._recording.quat[row, body]),
                },
            }
            for body in bodies
        ]
        return {"transforms": found}

    def joint_state(self, row: int) -> dict[str, Any]:
        """sensor_msgs/JointState of all hinges (rad, rad/s) and slides (m, m/s); efforts are left out."""
        return {
            "header": self._header(row, ""),
            "name": self.joints,
            "position": self._recording.qpos[row, self._position].tolist(),
            "velocity": self._recording.qvel[row, self._velocity].tolist(),
            "effort": [],
        }

    def odometry(self, row: int, body: int) -> dict[str, Any]:
        """nav_msgs/Odometry of a loose body's origin; nothing is uncertain, so its covariances are 0."""
        recording, nothing = self._recording, [0.0] * 36
        turned = matrices(recording.quat[row, body][None])[0]
        linear, angular = (turned.T @ values[row, body] for values in (recording.linvel, recording.angvel))
        place = {"position": xyz(recording.pos[row, body]), "orientation": turn(recording.quat[row, body])}
        return {
            "header": self._header(row),
            "child_frame_id": self.frames[body],
            "pose": {"pose": place, "covariance": nothing},
            "twist": {"twist": {"linear": xyz(linear), "angular": xyz(angular)}, "covariance": nothing},
        }

    def control(self, row: int, control: int) -> dict[str, Any]:
        """std_msgs/Float64: what a control was given, in its own unit."""
        return {"data": float(self._recording.ctrl[row, control])}

    def picture(self, ns: int, jpeg: bytes, camera: str) -> dict[str, Any]:
        """sensor_msgs/CompressedImage."""
        return {"header": {"stamp": stamp(ns), "frame_id": camera}, "format": "jpeg", "data": jpeg}

    def _header(self, row: int, frame: str = WORLD) -> dict[str, Any]:
        return {"stamp": stamp(self.ns(row)), "frame_id": frame}


def stamp(ns: int) -> dict[str, int]:
    """builtin_interfaces/Time."""
    return {"sec": ns // 10**9, "nanosec": ns % 10**9}


def xyz(values: "np.ndarray") -> dict[str, float]:
    """A vector or a point, of its three numbers."""
    return dict(zip("xyz", map(float, values), strict=True))


def turn(quat: "np.ndarray") -> dict[str, float]:
    """geometry_msgs/Quaternion of w x y z."""
    return dict(zip("wxyz", map(float, quat), strict=True))
