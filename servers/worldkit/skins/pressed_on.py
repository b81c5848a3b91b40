"""A skin pressed on one geom: stiff against going in, rubbing along it, as energies that a step makes least.

A body moves on after the skin has: it is met where it will be in the midst of the step, or what it is pushed by would lag behind
it and make energy. How one that floats freely goes on is found by trying (`skin`); any other goes on as it did. Friction is Coulomb's of the pressure as the step began; below a speed of `CREEPS` it is a drag, so what is stuck creeps by less.
"""

from typing import TYPE_CHECKING

import numpy as np

from . import met_geoms

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
CREEPS = 2e-3
"""m/s."""


class Met:
    """One geom, and what pressing into it and sliding along it costs during a step of `h` s.

    Args:
        row: of its body, among those of the law.
        geom: number of it.
        hard: (n,) N/m of each point.
        friction: Coulomb's.
        points: (n, 3) m, where the step begins.
        moves: (6,) rad/s and m/s, how its body goes on.
        gone: s since `data`.
        share: of the way of the body in this step, after which it is met.
    """

    def __init__(
        self,
        row: int,
        geom: int,
        hard: Array,
        friction: float,
        points: Array,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        h: float,
        moves: Array,
        gone: float,
        share: float,
    ) -> None:
        self.row, self.hard, self.kind = row, hard, int(model.geom_type[geom])
        self.size, self.turn = model.geom_size[geom].copy(), data.geom_xmat[geom].reshape(3, 3).copy()
        body = int(model.geom_bodyid[geom])
        on = gone * (moves[3:] + np.cross(moves[:3], data.geom_xpos[geom] - data.xipos[body]))
        at, whole = data.geom_xpos[geom] + on, data.xipos[body] + gone * moves[3:]
        self.middle, self.rest = at + share * h * (moves[3:] + np.cross(moves[:3], at - whole)), 1.0 - share
        far, self.out = self.far(points)
        self.grip = friction * self.hard * np.maximum(-far, 0)  # as it was pressed when the step began
        self.goes = h * (moves[3:] + np.cross(moves[:3], points - whole))
        """(n, 3) m: how far the body goes on meanwhile, at each point."""
        self.from_ = points + self.goes
        self.least = h * CREEPS

    def far(self, x: Array) -> tuple[Array, Array]:
        """(n,) m, negative within, and (n, 3) the way out."""
        far, out = met_geoms.distance(self.kind, self.size, (x - self.middle) @ self.turn)
        return far, out @ self.turn.T

    def _slid(self, x: Array) -> tuple[Array, Array]:
        way = x - self.from_
        way = way - (way * self.out).sum(axis=1, keepdims=True) * self.out
        return way, np.maximum(np.linalg.norm(way, axis=1), self.least)

    def value(self, x: Array) -> float:
        """J that it costs to be at `x`."""
        way, long = self._slid(x)
        slides = long / 2 + (way * way).sum(axis=1) / (2 * long)
        return self.stored(x) + float((self.grip * slides).sum())

    def stored(self, x: Array) -> float:
        """J of that which comes back as it springs off."""
        far, _ = self.far(x)
        return float((self.hard * np.minimum(far, 0) ** 2).sum() / 2)

    def left(self, x: Array) -> float:
        """J of it at the end of the step, to which the body has gone on."""
        return self.stored(x - self.rest * self.goes)

    def add(self, x: Array, slope: Array, each: Array | None) -> None:
        """Add its slope (n, 3) N, and its stiffness (n, 3, 3) N/m."""
        far, out = self.far(x)
        way, long = self._slid(x)
        drags = (self.grip / long)[:, None]
        slope += (self.hard * np.minimum(far, 0))[:, None] * out + drags * way
        if each is not None:
            within = np.where(far < 0, self.hard, 0.0)
            each += within[:, None, None] * out[:, :, None] * out[:, None]
            each += drags[:, :, None] * (np.eye(3) - self.out[:, :, None] * self.out[:, None])


def lightness(model: "mujoco.MjModel", body: int) -> Array:
    """(6,) 1/(kg m^2) and 1/kg: how a body that floats freely gives way to torque and force; zeros for any other."""
    import mujoco

    joint = model.body_jntadr[body]
    if not body or joint < 0 or model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
        return np.zeros(6)
    return np.repeat([1 / model.body_inertia[body].max(), 1 / model.body_subtreemass[body]], 3)


def turned(wrench: Array) -> Array:
    """(k, 6) torque before force, as velocities are told."""
    return wrench[:, [3, 4, 5, 0, 1, 2]]
