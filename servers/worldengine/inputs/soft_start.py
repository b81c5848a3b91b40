"""Find energy that the start holds: springs that are wound before anything happens are an input like any other.

If keyframe "start" moves a joint away from the model's own pose, and something springs back from there (the joint, a
tendon, a flex), the ledger tells at t = 0 how far the joint was moved and how much energy that gave it, without weight.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from worldkit.naming import names

from .pushes import displacement

if TYPE_CHECKING:
    import mujoco
    import numpy as np

LEAST_J = 1e-12


def wound(model: "mujoco.MjModel", start: "np.ndarray") -> "Iterator[tuple[str, np.ndarray, float]]":
    """(`body/joint`, displacement and rotation vector (6,), energy in J) of every joint that the start moves against a
    spring.

    Args:
        model: the world.
        start: (nq,) the coordinates at which it begins.
    """
    import copy

    import mujoco

    if start.tobytes() == model.qpos0.tobytes():
        return
    light = copy.copy(model)
    light.opt.gravity[:] = 0.0
    data = mujoco.MjData(light)

    def elastic(qpos: "np.ndarray") -> float:
        data.qpos[:] = qpos
        mujoco.mj_fwdPosition(light, data)
        mujoco.mj_energyPos(light, data)
        return float(data.energy[0])

    rest = elastic(model.qpos0)
    home, turned = data.xpos.copy(), data.xquat.copy()
    bodies, joints = names(model, "body", model.nbody), names(model, "joint", model.njnt)
    for joint in range(model.njnt):
        first = int(model.jnt_qposadr[joint])
        end = int(model.jnt_qposadr[joint + 1]) if joint + 1 < model.njnt else model.nq
        if (start[first:end] == model.qpos0[first:end]).all():
            continue
        moved = model.qpos0.copy()
        moved[first:end] = start[first:end]
        energy = elastic(moved) - rest
        if abs(energy) < LEAST_J:
            continue
        body = int(model.jnt_bodyid[joint])
        yield f"{bodies[body]}/{joints[joint]}", displacement(data, body, home[body], turned[body]), energy
