"""Physics pass against a bare `mj_step` loop that stores the same arrays in memory. Goal: at most 1.15.

The bare loop is what one would write by hand: `mj_step` in two halves (so that forces and poses belong to the stored
state), each array copied into a preallocated one, contacts and constraint forces kept as they are. Derived columns,
Arrow, hashing, the disk and the ledger are ours alone. Runs alternate; the ratio is that of the medians.

    python tests/bench/physics_pass.py [--steps 3000] [--repeats 7] [--bodies 50]
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))

import mujoco
import numpy as np

from worldkit import describe, record, simulate

GOAL = 1.15


def scene(bodies: int) -> mujoco.MjSpec:
    """Spheres and boxes that fall into a heap on a floor."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.001
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1))
    for i in range(bodies):
        body = spec.worldbody.add_body(
            name=f"body_{i}", pos=(0.24 * (i % 5), 0.24 * (i // 5 % 5), 0.15 + 0.25 * (i // 25))
        )
        body.add_freejoint()
        if i % 2:
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.08, 0.06))
        else:
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0, 0))
    return spec


def bare(model: mujoco.MjModel, steps: int) -> float:
    """Seconds of the bare loop."""
    data = mujoco.MjData(model)
    fixed = {
        "qpos": data.qpos, "qvel": data.qvel, "xpos": data.xpos[1:], "xquat": data.xquat[1:], "xipos": data.xipos[1:],
        "cvel": data.cvel[1:], "subtree_com": data.subtree_com, "linmom": data.subtree_linvel[0],
        "angmom": data.subtree_angmom[0], "energy": data.energy, "niter": data.solver_niter,
    }  # fmt: skip
    contact_fields = ("geom", "dist", "pos", "frame", "dim", "efc_address")
    started = time.perf_counter()
    stored = {name: np.empty((steps, *source.shape), source.dtype) for name, source in fixed.items()}
    times, ncon = np.empty(steps), np.empty(steps, int)
    contacts: dict[str, list] = {name: [] for name in (*contact_fields, "efc_force")}
    pairs = [(stored[name], source) for name, source in fixed.items()]
    for step in range(steps):
        mujoco.mj_step1(model, data)
        mujoco.mj_subtreeVel(model, data)
        times[step] = data.time
        for target, source in pairs:
            target[step] = source
        mujoco.mj_step2(model, data)
        ncon[step] = data.ncon
        contact = data.contact
        for name in contact_fields:
            contacts[name].append(getattr(contact, name).copy())
        contacts["efc_force"].append(data.efc_force.copy())
    return time.perf_counter() - started


def ours(model: mujoco.MjModel, steps: int, control=None) -> float:
    """Seconds of the physics pass, until the recording is closed on disk."""
    meta = describe.describe(model)
    data = mujoco.MjData(model)
    with tempfile.TemporaryDirectory() as folder:
        started = time.perf_counter()
        with record.Recorder(model, data, Path(folder) / "trajectory", meta) as recorder:
            simulate.simulate(model, data, recorder, steps, control)
        return time.perf_counter() - started


def main() -> int:
    """Print both medians and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=3000)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--bodies", type=int, default=50)
    options = parser.parse_args()
    model = scene(options.bodies).compile()
    simulate.prepare(model)
    bare(model, 200), ours(model, 200)  # warm up
    measured: dict[str, list[float]] = {"bare": [], "recorded": [], "controlled": []}
    for _ in range(options.repeats):
        measured["bare"].append(bare(model, options.steps))
        measured["recorded"].append(ours(model, options.steps))
        measured["controlled"].append(ours(model, options.steps, lambda model, data: None))
    medians = {name: statistics.median(values) for name, values in measured.items()}
    for name, value in medians.items():
        print(f"{name:>10}: {value / options.steps * 1e6:7.1f} us a step")
    ratio = medians["recorded"] / medians["bare"]
    print(f"physics pass / bare loop: {ratio:.3f} (goal {GOAL})")
    print(f"with a control function and its ledger: {medians['controlled'] / medians['bare']:.3f}")
    return 0 if ratio <= GOAL else 1


if __name__ == "__main__":
    sys.exit(main())
