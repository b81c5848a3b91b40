"""What a robot's own instruments tell of a live world: an inertial unit in a body's frame, and a ring of distances about it.

IMU        sensor_msgs/Imu: attitude in `world`, spin and specific force in the body's frame (REP 145), at the body's
           origin. The force is the mean since the message before, out of the change of velocity, in whatever way the
           world is stepped.
lidar      sensor_msgs/LaserScan: as many distances as there are rays, all about, counter-clockwise from behind, in the
           plane of the frame BODY/lidar, which stands over the body. It sees what is drawn, as light does; a ray that
           hits nothing is `inf`.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.turning import matrices

from .ros_messages import stamp, turn, xyz

if TYPE_CHECKING:
    from .live_row import LiveRow

RAYS, NEAREST_M, FARTHEST_M = 360, 0.1, 60.0
OVER_M = 0.1
"""The lidar stands so far over the highest part of its body."""
UNKNOWN = [-1.0, *[0.0] * 8]
"""A covariance that says: not measured (REP 145)."""


class Imu:
    """An inertial unit in one body of a world."""

    def __init__(self, row: "LiveRow", body: str) -> None:
        self._row, self.frame = row, body
        self._body = row.names.index(body)
        self._before: tuple[float, np.ndarray] | None = None

    def told(self) -> dict[str, Any]:
        """The message of the state that stands."""
        row, body = self._row, self._body
        now, velocity = float(row.time[0]), np.array(row.linvel[0, body])
        turned = matrices(row.quat[0, body][None])[0]
        force = None
        if self._before is not None and now > self._before[0]:
            force = turned.T @ ((velocity - self._before[1]) / (now - self._before[0]) - row.model.opt.gravity)
        self._before = (now, velocity)
        return {
            "header": {"stamp": stamp(round(now * 1e9)), "frame_id": self.frame},
            "orientation": turn(row.quat[0, body]),
            "angular_velocity": xyz(turned.T @ row.angvel[0, body]),
            "linear_acceleration": xyz(np.zeros(3) if force is None else force),
            "linear_acceleration_covariance": UNKNOWN if force is None else [0.0] * 9,
        }


class Lidar:
    """A ring of rays about one body of a world; it turns with the body."""

    def __init__(self, row: "LiveRow", body: str, rays: int = RAYS) -> None:
        self._row, self.frame = row, f"{body}/lidar"
        self._body, self._over = row.names.index(body), _over(row, body)
        self.angles = np.linspace(-np.pi, np.pi, rays, endpoint=False)
        self._ring = np.stack([np.cos(self.angles), np.sin(self.angles), np.zeros(rays)], axis=1)

    def mount(self) -> dict[str, Any]:
        """Where it stands in its body's frame: geometry_msgs/TransformStamped."""
        return {
            "header": {"stamp": stamp(0), "frame_id": self._row.names[self._body]},
            "child_frame_id": self.frame,
            "transform": {"translation": xyz(np.array([0.0, 0.0, self._over])), "rotation": {"w": 1.0}},
        }

    def told(self) -> dict[str, Any]:
        """The message of the state that stands."""
        import mujoco

        row, rays = self._row, len(self.angles)
        turned = matrices(row.quat[0, self._body][None])[0]
        eye = row.pos[0, self._body] + self._over * turned[:, 2]
        distances, hit = np.full(rays, -1.0), np.zeros(rays, np.int32)
        mujoco.mj_multiRay(
            row.model, row.data, eye, np.ascontiguousarray(self._ring @ turned.T).ravel(), None, True, -1, hit, distances,
            None, rays, FARTHEST_M,
        )  # fmt: skip
        seen = (distances >= NEAREST_M) & (distances <= FARTHEST_M)
        return {
            "header": {"stamp": stamp(round(float(row.time[0]) * 1e9)), "frame_id": self.frame},
            "angle_min": float(self.angles[0]), "angle_max": float(self.angles[-1]), "angle_increment": 2 * np.pi / rays,
            "range_min": NEAREST_M, "range_max": FARTHEST_M, "ranges": np.where(seen, distances, np.inf),
        }  # fmt: skip


def _over(row: "LiveRow", body: str) -> float:
    """How far over the body's origin a lidar sees past all that belongs to the body as it is built, m."""
    model, data, root = row.model, row.data, row.names.index(body) + 1
    axis = np.array(data.xmat[root]).reshape(3, 3)[:, 2]
    tops = [0.0]
    for geom in range(model.ngeom):
        owner = int(model.geom_bodyid[geom])
        while owner > root:
            owner = int(model.body_parentid[owner])
        if owner != root:
            continue
        middle, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
        turned = np.array(data.geom_xmat[geom]).reshape(3, 3)
        tops.append(
            float(axis @ (data.geom_xpos[geom] + turned @ middle - data.xpos[root]) + np.abs(axis @ turned) @ half)
        )
    return max(tops) + OVER_M
