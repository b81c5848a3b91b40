"""A driver who follows a course: slower where it bends, and with the front wheels towards a point ahead on it.

Speeds: at each point at most `top_m_s` and what its curvature allows, v = sqrt(a_across / k); swept back so that what comes can be
braked for, and forward so that it can be reached. Steering: pure pursuit, tan(delta) = 2 L sin(alpha) / d, from the rear axle to the
point the distance d ahead, and full lock where that lies behind (R. C. Coulter, Implementation of the Pure Pursuit Path Tracking Algorithm, CMU-RI-TR-92-01).
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from .adding import Vehicle
from .driving_inputs import Commands

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SPACING_M = 0.5
LONGEST_M = 1e5


@dataclass(frozen=True)
class Course:
    """A smooth line through points on the ground, (N, 2) m, from the first to the last, or `closed` back to the first.

    Raises ValueError for fewer than two points (three of a closed one), or two in one place one after the other.
    """

    points: "np.ndarray | tuple[tuple[float, float], ...]"
    closed: bool = False

    def __post_init__(self) -> None:
        import numpy as np

        given = np.asarray(self.points, float)
        if given.ndim != 2 or given.shape[1] != 2 or len(given) < 2 + self.closed or not np.isfinite(given).all():
            raise ValueError(f"a course needs (N, 2) finite points, at least {2 + self.closed}, got {given.shape}")
        ends = np.concatenate([given, given[:1]]) if self.closed else given
        steps = np.linalg.norm(np.diff(ends, axis=0), axis=1)
        if (steps < 1e-6).any() or steps.sum() > LONGEST_M:
            raise ValueError("two points of a course that follow one another lie in one place, or it is too long")

    @cached_property
    def line(self) -> "np.ndarray":
        """(M, 2) m: the course at even distances of about `SPACING_M`; of a closed one the first point is not repeated."""
        import numpy as np
        from scipy.interpolate import CubicSpline

        given = np.asarray(self.points, float)
        ends = np.concatenate([given, given[:1]]) if self.closed else given
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ends, axis=0), axis=1))])
        spline = CubicSpline(along, ends, bc_type="periodic" if self.closed else "natural")
        fine = spline(np.linspace(0, along[-1], max(int(along[-1] / SPACING_M * 8), 16)))
        way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))])
        count = max(round(way[-1] / SPACING_M), 4)
        wanted = np.linspace(0, way[-1], count + 1)[: count if self.closed else None]
        return np.stack([np.interp(wanted, way, fine[:, axis]) for axis in (0, 1)], axis=1)

    @cached_property
    def spacing_m(self) -> float:
        """Between two points of the line."""
        import numpy as np

        return float(np.linalg.norm(np.diff(self.line, axis=0), axis=1).mean())

    @cached_property
    def curvature(self) -> "np.ndarray":
        """(M,) 1/m at each point of the line, positive to the left."""
        import numpy as np

        line = np.concatenate([self.line[-3:], self.line, self.line[:3]]) if self.closed else self.line
        first = np.gradient(line, self.spacing_m, axis=0)
        second = np.gradient(first, self.spacing_m, axis=0)
        found = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.maximum(
            (first**2).sum(axis=1) ** 1.5, 1e-9
        )
        return found[3:-3] if self.closed else found

    def speeds(self, top_m_s: float, across_m_s2: float, faster_m_s2: float, slower_m_s2: float) -> "np.ndarray":
        """(M,) m/s at each point; an open course ends at rest."""
        import numpy as np

        bend = np.maximum(np.abs(self.curvature), 1e-9)
        found = np.minimum(top_m_s, np.sqrt(across_m_s2 / bend))
        if not self.closed:
            found[-1] = 0.0
        for gain, order in ((slower_m_s2, range(len(found) - 1, -1, -1)), (faster_m_s2, range(len(found)))):
            behind = order.step
            for _ in range(2 if self.closed else 1):  # the second time round the end knows the beginning
                for here in order:
                    before = here - behind
                    if self.closed or 0 <= before < len(found):
                        reached = np.sqrt(found[before % len(found)] ** 2 + 2 * gain * self.spacing_m)
                        found[here] = min(found[here], reached)
        return found

    def nearest(self, place: "np.ndarray", near: int | None = None, reach: int = 60) -> tuple[int, float]:
        """(point, m to the left of the line) nearest to a place (2,); looked for up to `reach` points from `near`."""
        import numpy as np

        count = len(self.line)
        among = np.arange(count) if near is None else near + np.arange(-reach, reach + 1)
        among = among % count if self.closed else np.unique(np.clip(among, 0, count - 1))
        here = int(among[np.argmin(((self.line[among] - place) ** 2).sum(axis=1))])
        after = (here + 1) % count if self.closed else min(here + 1, count - 1)
        before = (here - 1) % count if self.closed else max(here - 1, 0)
        way = self.line[after] - self.line[before]
        off = np.asarray(place) - self.line[here]
        return here, float((way[0] * off[1] - way[1] * off[0]) / max(float(np.hypot(*way)), 1e-9))


@dataclass
class Driver:
    """Drives one vehicle along a course; a `control` holds one and asks it for commands at each step.

    What it knows beside the state is where on the course it last was, so that a course may cross itself.
    """

    car: Vehicle
    course: Course
    top_m_s: float = 14.0
    across_m_s2: float = 3.0
    faster_m_s2: float = 2.0
    slower_m_s2: float = 3.0
    ahead_s: float = 0.5
    """How far ahead it looks, in time; at least 1.2 wheelbases."""
    point: int | None = field(default=None, init=False)
    off_m: float = field(default=0.0, init=False)
    """How far to the left of the course the middle of the rear axle was, when it was last asked."""

    @cached_property
    def speeds(self) -> "np.ndarray":
        """(M,) m/s along the course."""
        return self.course.speeds(self.top_m_s, self.across_m_s2, self.faster_m_s2, self.slower_m_s2)

    def commands(self, data: "mujoco.MjData", name: str) -> Commands:
        """What to do in this state, whose velocities and poses are computed."""
        import numpy as np

        if data.time <= 0:  # a run begins: where another one ended says nothing
            self.point = None
        body = data.body(name)
        forward = body.xmat.reshape(3, 3)[:2, 0]
        forward = forward / max(float(np.hypot(*forward)), 1e-9)
        rear = body.xpos[:2] - forward * self.car.wheelbase_m / 2
        joint = data.joint(name)
        speed = float(joint.qvel[:2] @ forward)
        self.point, self.off_m = self.course.nearest(rear, self.point)
        far = max(self.ahead_s * speed, 1.2 * self.car.wheelbase_m)
        target = self.point + round(far / self.course.spacing_m)
        count = len(self.course.line)
        there = self.course.line[target % count if self.course.closed else min(target, count - 1)]
        to = there - rear
        distance = max(float(np.hypot(*to)), 1e-6)
        sine = float(forward[0] * to[1] - forward[1] * to[0]) / distance
        steering = float(np.degrees(np.arctan2(2 * self.car.wheelbase_m * sine, distance)))
        if forward @ to < 0 and (self.course.closed or self.point < count - 1):
            steering = self.car.steering_deg * (1.0 if sine >= 0 else -1.0)  # the course lies behind it: turn round
        # The speed that belongs a little further on: the drive takes that long to act.
        soon = self.point + max(round(0.3 * speed / self.course.spacing_m), 1)
        wanted = float(self.speeds[soon % count if self.course.closed else min(soon, count - 1)])
        return Commands(steering, *self._feet(wanted, speed))

    def _feet(self, wanted: float, speed: float) -> tuple[float, float]:
        """(throttle, brake) that bring it to a speed, m/s, as fast as what is left of the difference halves in a third of a second."""
        car = self.car
        acceleration = min(max(2.0 * (wanted - speed), -2 * self.slower_m_s2), 2 * self.faster_m_s2)
        force = car.mass_kg * (acceleration + car.rolling_resistance * 9.81 * (speed > 0.1))
        if force >= 0:
            return min(force * car.wheel_radius_m / car.drive_n_m, 1.0), 0.0
        return 0.0, min(-force * car.wheel_radius_m / (len(car.corners) * car.brake_n_m), 1.0)
