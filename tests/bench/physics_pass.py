"""The physics pass against a bare loop that stores the same arrays in memory: here, in a clean process, and with a control.

The bare loop is what one would write by hand: `mj_step` in two halves (so that forces and poses belong to the stored
state), each array copied into a preallocated one, contacts and constraint forces kept as they are, and the same control
called in between. Derived columns, Arrow, hashing, the disk, the ledger, and a second process that is asked through shared
memory are ours alone. Runs alternate; the ratio is that of the medians.

    python tests/bench/physics_pass.py [--steps 9000] [--repeats 5] [--bodies 50]

The clean process is the engine's own, which gets the world as a file (`python -m worldengine physics`). What it says of its pass is
compared; the rest of its life, from its start over imports and compiling to its end, is told apart, in seconds. What a process
pays once inside the pass, as the first use of Arrow, is some 70 ms: so the steps are enough for a pass of a second.

Goals: at most 1.15 without control, in a heap of 50 bodies, in this process and in the clean one; at most 1.6 with control at every step, in a world of the size of
a tetherball (one ball, a dozen of links of rope), and less where it is asked every tenth step, or with a latency of one.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from figures import Figure, report

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))

import mujoco
import numpy as np

from worldengine.clock import simulate
from worldengine.inputs.author_link import Distant
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked
from worldengine.recording import describing, record
from worldkit import channel, portable, speaking
from worldkit.handover import run as engine

GOAL, GOAL_CONTROLLED = 1.15, 1.6
ROWS = (("force", frozenset({"ball"})),)


def scene(bodies: int) -> mujoco.MjSpec:
    """Spheres and boxes that fall into a heap on a floor."""
    spec = _empty()
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


def tether() -> mujoco.MjSpec:
    """A ball on a rope of twelve links, above a floor."""
    spec = _empty()
    body = spec.worldbody.add_body(name="link_0", pos=(0, 0, 2.2))
    for i in range(12):
        body.add_joint(type=mujoco.mjtJoint.mjJNT_BALL, damping=(0.001, 0, 0))
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, fromto=(0, 0, 0, 0.12, 0, 0), size=(0.01, 0, 0), contype=0)
        body = body.add_body(name=f"link_{i + 1}" if i < 11 else "ball", pos=(0.12, 0, 0))
    body.add_joint(type=mujoco.mjtJoint.mjJNT_BALL)
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.11, 0, 0), pos=(0.11, 0, 0), mass=0.4)
    return spec


def _empty() -> mujoco.MjSpec:
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.001
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1))
    return spec


def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """A law that reads poses and velocities and writes a force, as a control does."""
    ball = model.nbody - 1
    data.xfrc_applied[ball, :3] = -0.05 * data.cvel[ball, 3:] + 0.01 * data.xpos[ball]


def bare(model: mujoco.MjModel, steps: int, control: Callable | None = None) -> float:
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
        if control is not None:
            control(model, data)
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


def ours(model: mujoco.MjModel, steps: int, asked: bool = False, every: int = 1, latency: int = 0) -> float:
    """Seconds of the physics pass, until the recording is closed on disk; the author's process is there already."""
    meta = describing.describe(model)
    data = mujoco.MjData(model)
    author = inputs = None
    if asked:
        ends, theirs = channel.pair()
        call = [sys.executable, __file__, "--author", ",".join(map(str, theirs))]
        author = subprocess.Popen(call, pass_fds=theirs)
        for descriptor in theirs:
            os.close(descriptor)
        ports = Ports(model, ROWS)
        inputs = Asked(
            model, data, ports, Distant(model, data, ports, channel.Channel(ends, channel.ENGINE)), every, latency
        )
    with tempfile.TemporaryDirectory() as folder:
        started = time.perf_counter()
        with record.Recorder(model, data, Path(folder) / "trajectory", meta) as recorder:
            simulate.simulate(model, data, recorder, steps, inputs)
        seconds = time.perf_counter() - started
    if inputs is not None and author is not None:
        inputs.close()
        author.wait()
    return seconds


def clean(spec: mujoco.MjSpec, steps: int) -> tuple[float, float]:
    """Seconds of the physics pass in a clean process, until the recording is closed; and those of the rest of that process."""
    facts = {"fps": 24, "size": [64, 64], "movers": [], "visual_only": [], "seed": 0, "control": None}
    facts |= {"control_every": 1, "latency": 0, "duration": steps * spec.option.timestep}
    with tempfile.TemporaryDirectory() as folder:
        world, program, out = (Path(folder) / name for name in ("world.mjz", "program.json", "out"))
        portable.write(spec.copy(), world)
        program.write_text(json.dumps(facts))
        out.mkdir()
        started = time.perf_counter()
        if engine(["physics", "--world", str(world), "--program", str(program), "--out", str(out)]):
            raise SystemExit((out / "error.json").read_text())
        whole = time.perf_counter() - started
        wall = json.loads((out / "result.json").read_text())["wall_s"]
    return wall, whole - wall


def main() -> int:
    """Print the medians and their ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=9000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--bodies", type=int, default=50)
    parser.add_argument("--author", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.author:
        end = channel.Channel(channel.descriptors(options.author), channel.AUTHOR)
        speaking.serve(push, end, lambda name, of_model: None)
        return 0
    heap, small = scene(options.bodies).compile(), tether().compile()
    for model in (heap, small):
        simulate.prepare(model)
    steps = options.steps
    starts: list[float] = []

    def in_a_clean_process() -> float:
        seconds, rest = clean(scene(options.bodies), steps)
        starts.append(rest)
        return seconds

    runs: dict[str, Callable[[], float]] = {
        "heap, bare": lambda: bare(heap, steps),
        "heap, recorded": lambda: ours(heap, steps),
        "heap, in a clean process": in_a_clean_process,
        "tether, bare with control": lambda: bare(small, steps, push),
        "tether, asked at every step": lambda: ours(small, steps, True),
        "tether, asked at every tenth": lambda: ours(small, steps, True, every=10),
        "tether, latency of one": lambda: ours(small, steps, True, latency=1),
    }
    measured: dict[str, list[float]] = {name: [] for name in runs}
    bare(heap, 200), ours(heap, 200)  # warm up
    for _ in range(options.repeats):
        for name, run in runs.items():
            measured[name].append(run())
    medians = {name: statistics.median(values) for name, values in measured.items()}
    for name, value in medians.items():
        print(f"{name:>28}: {value / steps * 1e6:7.1f} us a step")
    plain = medians["heap, recorded"] / medians["heap, bare"]
    apart = medians["heap, in a clean process"] / medians["heap, bare"]
    print(f"{'start and end of that process':>28}: {statistics.median(starts):7.2f} s")
    base = medians["tether, bare with control"]
    asked = medians["tether, asked at every step"] / base
    print(f"at every tenth step: {medians['tether, asked at every tenth'] / base:.3f}")
    print(f"with a latency of one: {medians['tether, latency of one'] / base:.3f}")
    return report(
        Figure("physics pass / bare loop", plain, GOAL),
        Figure("physics in a clean process / bare loop", apart, GOAL),
        Figure("with control at every step / bare, same control", asked, GOAL_CONTROLLED),
    )


if __name__ == "__main__":
    sys.exit(main())
