"""What moves as one with a body: its cargo, welded on or a body without joints, has mass and inertia that water has to move, too."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray


@dataclass(frozen=True)
class Wholes:
    """n bodies, each with all that has no joint between it and them."""

    mass: Array
    """(n,) kg."""
    middle: Array
    """(n, 3) m: the centre of mass of the whole, in the body's own inertial frame."""
    axes: Array
    """(n, 3, 3): the main axes of the whole, as columns, in that frame."""
    inertia: Array
    """(n, 3) kg m^2, about them."""

    @classmethod
    def of(cls, model: "mujoco.MjModel", bodies: Iterable[int]) -> "Wholes":
        """Those of some bodies of a world; one that stands fast is its own whole."""
        import mujoco

        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        turn, place = data.ximat.reshape(-1, 3, 3), data.xipos
        found = []
        for body in map(int, bodies):
            group = np.flatnonzero(model.body_weldid == model.body_weldid[body])
            if len(group) == 1 or model.body_weldid[body] == 0 or not model.body_mass[group].sum():
                found.append((model.body_mass[body], np.zeros(3), np.eye(3), model.body_inertia[body]))
                continue
            mass = model.body_mass[group]
            middle = mass @ place[group] / mass.sum()
            away = place[group] - middle
            own = np.einsum("gij,gj,gkj->ik", turn[group], model.body_inertia[group], turn[group])
            total = own + (mass @ (away**2).sum(axis=1)) * np.eye(3) - (mass[:, None] * away).T @ away
            inertia, axes = np.linalg.eigh(turn[body].T @ total @ turn[body])
            found.append((mass.sum(), turn[body].T @ (middle - place[body]), axes, inertia))
        return cls(*(np.array(part, float).reshape(len(found), *shape) for part, shape in
                     zip(zip(*found, strict=True) if found else [()] * 4, ((), (3,), (3, 3), (3,)), strict=True)))  # fmt: skip
