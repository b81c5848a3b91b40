"""Small worlds run by the engine, with their model beside the recording: the cases of the checks that ask the model."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ...model.recording.mechanics import Mechanics
from ...model.recording.trajectory import Trajectory

RATE = 100.0
Hook = Callable[[Any, Any], None]


def scene(*bodies: str, option: str = "", more: str = "", ground: bool = True) -> str:
    """MJCF of some bodies over a plane; `option` are attributes of the options, `more` stands beside the world."""
    plane = '<geom name="ground" type="plane" size="5 5 0.1"/>' if ground else ""
    return f'<mujoco><option timestep="0.002" {option}/><worldbody>{plane}{"".join(bodies)}</worldbody>{more}</mujoco>'


def box(name: str, pos: str, size: str = "0.1 0.1 0.1", geom: str = "", body: str = "") -> str:
    """A loose box."""
    return f'<body name="{name}" pos="{pos}" {body}><freejoint/><geom type="box" size="{size}" mass="1" {geom}/></body>'


def run(xml: str, seconds: float, start: Hook | None = None, before: Hook | None = None) -> Trajectory:
    """The recording, with its model; `before` is called before every step."""
    import mujoco

    from worldengine.recording.describing import describe

    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    if start:
        start(model, data)
    every = max(1, round(1 / (RATE * model.opt.timestep)))
    rows: list[tuple[Any, ...]] = []
    velocity, wrench = np.zeros(6), np.zeros(6)
    for n in range(round(seconds / model.opt.timestep) + 1):
        if before:
            before(model, data)
        mujoco.mj_forward(model, data)
        if n % every == 0:
            linear, angular = np.zeros((model.nbody, 3)), np.zeros((model.nbody, 3))
            for b in range(model.nbody):
                mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, b, velocity, 0)
                angular[b], linear[b] = velocity[:3], velocity[3:]
            force = np.zeros(model.nbody)
            for c in range(data.ncon):
                mujoco.mj_contactForce(model, data, c, wrench)
                for g in data.contact[c].geom:
                    force[model.geom_bodyid[g]] += np.sqrt((wrench[:3] ** 2).sum())
            deepest = max(0.0, -float(data.contact.dist.min())) if data.ncon else 0.0
            rows.append((data.time, data.xpos.copy(), data.xquat.copy(), linear, angular, force, data.ncon, deepest))
        mujoco.mj_step(model, data)
    t, pos, quat, linvel, angvel, force_sum, ncon, depth = (
        np.array(column, dtype=float) for column in zip(*rows, strict=True)
    )
    meta = describe(model)
    names = [row["name"] for row in meta["bodies"]]
    return Trajectory.from_arrays(
        t, names, pos[:, 1:], quat=quat[:, 1:], linvel=linvel[:, 1:], angvel=angvel[:, 1:], meta=meta, model=model,
        contact_force_sum=force_sum[:, 1:], ncon=ncon, max_penetration=depth, mechanics=Mechanics.from_meta(meta, names),
    )  # fmt: skip
