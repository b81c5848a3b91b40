"""A drone that flies through points and hovers, by the thrust of its four rotors alone.

FLIER = robots.flier("drone", "cf21b", ((0, 0, 1), (1, 0, 1)), gusts=robots.Gusts((0, 0, 0), 2.0))

def control(model, data):
    FLIER(model, data)

Its position is pulled to a point that goes ahead of it with the least jerk; the attitude that this needs is held on the rotation
group. Source: T. Lee, M. Leok, N. H. McClamroch, "Geometric tracking control of a quadrotor UAV on SE(3)", IEEE CDC 2010, eq. 15-19.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from .drones import DRONES, Drone
from .gusts import Gusts

if TYPE_CHECKING:
    import mujoco
    import numpy as np

POSITION, DAMPING, LASTING = 36.0, 10.0, 30.0
"""1/s², 1/s, 1/s³: pull to the point, against velocity, and against what lasts, such as wind."""
MOST_LASTING = 4.0
"""m/s² that the last may come to."""
ATTITUDE, SPINNING = 900.0, 50.0
"""1/s² and 1/s: 30 rad/s about each axis."""
MOST_TILT = 0.7
"""Sideways force for each of what is upwards."""
QUICKEST_S = 0.5


class Flier:
    """One drone. It starts anew where time goes back, so that a repetition is the same run."""

    _lasting: "np.ndarray"

    def __init__(
        self, name: str, drone: Drone, through: Sequence[Sequence[float]], *, speed: float = 0.5, hover_s: float = 1.0,
        gusts: Gusts | None = None,
    ) -> None:  # fmt: skip
        self.name, self.drone, self.through = name, drone, tuple(map(tuple, through))
        self.speed, self.hover_s, self.gusts = speed, hover_s, gusts
        self._time = float("inf")

    def __call__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Set the rotors' thrusts, and the drag of the air where there are gusts.

        Args:
            model: the world's.
            data: its state, up to date.

        Raises:
            KeyError: the drone, or a rotor of it, is not in the world.
        """
        import mujoco
        import numpy as np

        if data.time < self._time:
            self._start(model, data)
        step, self._time = max(0.0, float(data.time) - self._time), float(data.time)
        turn, twist = data.xmat[self._body].reshape(3, 3), np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, self._body, twist, 0)
        spin, velocity = turn.T @ twist[:3], twist[3:]
        if self.gusts is not None:
            past = turn.T @ (self.gusts.wind(self._time) - velocity)
            data.xfrc_applied[self._body, :3] = turn @ (self.drone.air * past)
        at, going, gaining = self.way(self._time)
        away = at - data.xpos[self._body]
        self._lasting = np.clip(self._lasting + LASTING * away * step, -MOST_LASTING, MOST_LASTING)
        wanted = POSITION * away + DAMPING * (going - velocity) + self._lasting + gaining - model.opt.gravity
        wanted[2] = max(wanted[2], 0.2 * float(np.linalg.norm(model.opt.gravity)), 1e-6)  # it never turns over
        aside = float(np.hypot(*wanted[:2]))
        wanted[:2] *= min(1.0, MOST_TILT * wanted[2] / aside) if aside else 1.0
        up = wanted / np.linalg.norm(wanted)
        left = np.cross(up, (1.0, 0.0, 0.0))
        left /= np.linalg.norm(left)
        held = np.column_stack((np.cross(left, up), left, up))
        error = 0.5 * (held.T @ turn - turn.T @ held)
        tilted = np.array((error[2, 1], error[0, 2], error[1, 0]))
        inertia = model.body_inertia[self._body]
        torque = inertia * (-ATTITUDE * tilted - SPINNING * spin) + np.cross(spin, inertia * spin)
        asked = np.append(self._mass * float(wanted @ turn[:, 2]), torque)
        data.ctrl[self._rotors] = np.clip(self._mixing @ asked, 0.0, self.drone.most_n)

    def way(self, time: float) -> "tuple[np.ndarray, np.ndarray, np.ndarray]":
        """Where the point is that it is pulled to, (3,), m, its velocity and its acceleration, at a time, s."""
        import numpy as np

        left = time - self._since
        for a, b, lasts in self._legs:
            if left < lasts:
                s = max(0.0, left / lasts)
                share = s**3 * (10 - 15 * s + 6 * s * s)
                rate = 30 * s * s * (1 - s) ** 2 / lasts
                change = 60 * s * (1 - s) * (1 - 2 * s) / lasts**2
                return a + share * (b - a), rate * (b - a), change * (b - a)
            if left < lasts + self.hover_s:
                return b, np.zeros(3), np.zeros(3)
            left -= lasts + self.hover_s
        return self._legs[-1][1], np.zeros(3), np.zeros(3)

    def _start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        import numpy as np

        self._body = model.body(self.name).id
        self._rotors = [model.actuator(f"{self.name}_{rotor.name}").id for rotor in self.drone.rotors]
        self._mass = float(model.body_subtreemass[self._body])
        rows = [(1.0, rotor.place[1], -rotor.place[0], rotor.spin * self.drone.drag_m) for rotor in self.drone.rotors]
        self._mixing = np.linalg.inv(np.array(rows).T)
        self._time = self._since = float(data.time)
        self._lasting = np.zeros(3)
        here = data.xpos[self._body].copy()
        points = [here, *(np.array(point, dtype=float) for point in self.through or (here,))]
        self._legs = [
            (a, b, max(QUICKEST_S, 1.875 * float(np.linalg.norm(b - a)) / self.speed)) for a, b in pairwise(points)
        ]


def flier(
    name: str, drone: str, through: Sequence[Sequence[float]], *, speed: float = 0.5, hover_s: float = 1.0,
    gusts: Gusts | None = None,
) -> Flier:  # fmt: skip
    """A drone that flies through points.

    Args:
        name: its root body.
        drone: its key in `drones.DRONES`.
        through: points (3,), m, one after the other; it hovers at the last, and where it starts if there is none.
        speed: the most on its way, m/s.
        hover_s: how long it waits at each, s.
        gusts: the wind that drags at it; None: the air is still, and does not drag.
    """
    return Flier(name, DRONES[drone], through, speed=speed, hover_s=hover_s, gusts=gusts)
