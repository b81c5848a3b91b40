"""Run an MJCF model and keep what the interchange keeps; hooks let a world do, or fake, what it wants between steps."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

Arrays = dict[str, np.ndarray]
Hook = Callable[[mujoco.MjModel, mujoco.MjData], None]
OPTIONAL = ("energy", "ncon", "max_penetration", "contact_force_sum")


@dataclass
class World:
    """One simulation of the corpus."""

    name: str
    xml: str
    duration: float = 3.0
    rate: float = 100.0
    """Rows a second."""
    start: Hook | None = None
    """Once, before the first step."""
    before: Hook | None = None
    """Before every step."""
    after: Hook | None = None
    """After every step: what writes the state behind the engine's back."""
    edit: Callable[[Arrays], None] | None = None
    """On the recorded arrays: damage to the recording itself."""
    fault: tuple[str, ...] = ()
    """Checks of which at least one must find it; empty: a clean world."""
    needs_model: bool = False
    """Only the MJCF beside it shows the fault."""
    needs: tuple[str, ...] = ()
    """Optional channels without which the fault cannot be seen."""
    declared: dict[str, Any] = field(default_factory=dict)


def simulate(world: World) -> Arrays:
    """The arrays of the interchange."""
    model = mujoco.MjModel.from_xml_string(world.xml)
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    data = mujoco.MjData(model)
    if world.start:
        world.start(model, data)
    mujoco.mj_forward(model, data)
    step = model.opt.timestep
    every = max(1, round(1 / (world.rate * step)))
    rows: dict[str, list[Any]] = {key: [] for key in ("t", "pos", "quat", "linvel", "angvel", *OPTIONAL)}
    for n in range(round(world.duration / step) + 1):
        if n % every == 0:
            _keep(model, data, rows)
        if world.before:
            world.before(model, data)
        mujoco.mj_step(model, data)
        if world.after:
            world.after(model, data)
    arrays = {key: np.array(value, dtype=float) for key, value in rows.items()}
    arrays["names"] = np.array([model.body(b).name for b in range(1, model.nbody)])
    if world.edit:
        world.edit(arrays)
    return arrays


def _keep(model: mujoco.MjModel, data: mujoco.MjData, rows: dict[str, list[Any]]) -> None:
    shadow = data
    mujoco.mj_forward(model, shadow)
    velocity = np.zeros(6)
    linear, angular = [], []
    for body in range(1, model.nbody):
        mujoco.mj_objectVelocity(model, shadow, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, 0)
        angular.append(velocity[:3].copy())
        linear.append(velocity[3:].copy())
    force, wrench, deepest = np.zeros(model.nbody), np.zeros(6), 0.0
    for c in range(shadow.ncon):
        mujoco.mj_contactForce(model, shadow, c, wrench)
        deepest = max(deepest, -float(shadow.contact[c].dist))
        for geom in shadow.contact[c].geom:
            force[model.geom_bodyid[geom]] += np.linalg.norm(wrench[:3])
    rows["t"].append(shadow.time)
    rows["pos"].append(shadow.xpos[1:].copy())
    rows["quat"].append(shadow.xquat[1:].copy())
    rows["linvel"].append(linear)
    rows["angvel"].append(angular)
    rows["energy"].append(shadow.energy.copy())
    rows["ncon"].append(shadow.ncon)
    rows["max_penetration"].append(deepest)
    rows["contact_force_sum"].append(force[1:].copy())


def write(world: World, folder: Path, optional: bool = True, model: bool = True) -> Path:
    """The world as `NAME.npz`, with `NAME.xml` beside it when `model`."""
    folder.mkdir(parents=True, exist_ok=True)
    arrays = simulate(world)
    kept = {key: value for key, value in arrays.items() if optional or key not in OPTIONAL}
    path = folder / f"{world.name}.npz"
    np.savez_compressed(path, **kept)
    if model:
        path.with_suffix(".xml").write_text(world.xml, encoding="utf-8")
    return path
