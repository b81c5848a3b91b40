"""Small worlds for the runtime's tests, and a short way to record them."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from worldengine.clock.simulate import prepare, simulate
from worldengine.inputs.author_link import Local
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked, Replayed
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldengine.variants.holding import Hold
from worldkit import film_files, forms, materials
from worldkit.filming import Film
from worldkit.world import start

INTEGRATORS = ("EULER", "RK4", "IMPLICIT", "IMPLICITFAST", "DISCRETE")


def empty(time_step: float = 0.001, integrator: str = "IMPLICITFAST", gravity: float = -9.81) -> mujoco.MjSpec:
    """A spec with a clock and nothing in it."""
    spec = mujoco.MjSpec()
    spec.option.timestep = time_step
    spec.option.gravity = (0, 0, gravity)
    spec.option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    return spec


def floor(spec: mujoco.MjSpec, **properties: Any) -> None:
    """The plane z = 0."""
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1), **properties)


def ball(spec: mujoco.MjSpec, name: str, pos: Any, radius: float = 0.1, mass: float = 1.0, **properties: Any) -> Any:
    """A loose ball."""
    body = spec.worldbody.add_body(name=name, pos=pos)
    body.add_freejoint(name=name)
    body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(radius, 0, 0), mass=mass, **properties)
    return body


def slab(spec: mujoco.MjSpec, body: Any, shape: str, size: Any, look: str, radius: float) -> None:
    """The shape of a body: a box of full extents, m, with a look, or a mesh of the same with rounded edges."""
    kinds = mujoco.mjtGeom
    if shape == "mesh":
        form = forms.rounded_box(size=size, radius=radius)
        spec.add_mesh(name="slab", uservert=form.vertices.ravel(), userface=form.faces.ravel())
        geom = body.add_geom(type=kinds.mjGEOM_MESH, meshname="slab")
    else:
        geom = body.add_geom(type=kinds.mjGEOM_BOX, size=np.array(size) / 2)
    geom.material = materials.add(spec, look)


def heap(bodies: int = 12, **options: Any) -> mujoco.MjSpec:
    """Balls and boxes that fall into a heap on a floor."""
    spec = empty(**options)
    floor(spec)
    for i in range(bodies):
        pos = (0.15 * (i % 3), 0.15 * (i // 3 % 2), 0.15 + 0.22 * (i // 6))
        if i % 2:
            body = spec.worldbody.add_body(name=f"box_{i}", pos=pos)
            body.add_freejoint()
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.07, 0.05))
        else:
            ball(spec, f"ball_{i}", pos)
    return spec


def record(
    spec: mujoco.MjSpec | mujoco.MjModel,
    folder: Path,
    steps: int,
    control: Callable[..., Any] | None = None,
    batch_rows: int | None = None,
    every: int = 1,
    before: Callable[[mujoco.MjModel, mujoco.MjData], None] | None = None,
    rows: Any = None,
    hold: Hold | None = None,
    control_every: int = 1,
    latency: int = 0,
) -> stored.Recording:
    """Simulate `steps` steps into `folder` and open the recording; `control` answers from a data of its own."""
    model = spec.compile() if isinstance(spec, mujoco.MjSpec) else spec
    meta = describing.describe(model)
    prepare(model)
    data = start(model)
    if before is not None:
        before(model, data)
    inputs = None
    if control is not None:
        ports = Ports(model, rows)
        shares = hold.shares() if hold else None
        inputs = Asked(model, data, ports, Local(model, data, ports, control), control_every, latency, shares)
        meta["inputs"] = ports.as_meta()
    with Recorder(model, data, folder, meta, batch_rows) as recorder:
        simulate(model, data, recorder, steps, inputs, every)
    return stored.open(folder)


def replay(spec: mujoco.MjSpec, folder: Path, steps: int, recording: stored.Recording) -> stored.Recording:
    """Simulate again as a recording says that it was driven."""
    model = spec.compile()
    meta = describing.describe(model)
    prepare(model)
    data = start(model)
    ports = Ports(model, None)
    with Recorder(model, data, folder, {**meta, "inputs": ports.as_meta()}) as recorder:
        simulate(model, data, recorder, steps, Replayed(model, data, ports, recording, steps))
    return stored.open(folder)


def lay_film(
    folder: Path, film: Film, change: Callable[[dict[str, Any], dict[str, Any]], object] | None = None
) -> None:
    """Lay the description of a film in a folder, as the engine reads it; `change(facts, arrays)` alters it first."""
    facts, arrays = film.description()
    if change:
        change(facts, arrays)
    (folder / film_files.DESCRIPTION).write_text(json.dumps(facts), encoding="utf-8")
    np.savez(folder / film_files.ARRAYS, **arrays)
