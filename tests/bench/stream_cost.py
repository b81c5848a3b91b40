"""What 600 bodies cost that are pushed at every step: the bytes of their stream of inputs, and the ledger's time a step.

A law pulls each body to its place and brakes it, so that every force changes at every step; nothing touches. The world is recorded
with its `control`, then driven by the recorded stream twice, with the ledger and with one that notes nothing. The
difference of the processor times of the whole process (the ledger's rows are made and written beside the steps) is the ledger's.

    python tests/bench/stream_cost.py [--steps 10000] [--bodies 600] [--repeats 3]

Goals, for 10,000 steps: a stream of at most 25 MB, a ledger of at most 20 us a step.
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

from figures import Figure, report

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))

import mujoco
import numpy as np

from worldengine.clock import simulate
from worldengine.inputs import replayed_inputs
from worldengine.inputs.author_link import Local
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked, Replayed
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldkit.world import start

STREAM_MB, LEDGER_US, STEPS = 25.0, 20.0, 10_000
SPACING, STIFFNESS, DAMPING = 0.5, 40.0, 0.2
TABLES = ("inputs", "edits")
"""Of a recording, what drove it."""


def scene(bodies: int) -> mujoco.MjSpec:
    """Balls in a grid, apart from each other, without gravity."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.002
    spec.option.gravity = (0, 0, 0)
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    side = int(np.ceil(bodies ** (1 / 3)))
    for i in range(bodies):
        place = SPACING * np.array([i % side, i // side % side, i // side**2])
        body = spec.worldbody.add_body(name=f"ball_{i}", pos=place)
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.05, 0, 0), mass=1.0)
    return spec


class Law:
    """Pulls each body to where it was built, from where a throw has brought it, and brakes it."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.home = model.body_pos[1:].copy()

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1:, :3] = -STIFFNESS * (data.xpos[1:] - self.home) - DAMPING * data.cvel[1:, 3:]


class Silent:
    """In the place of a ledger: it notes nothing."""

    def __init__(self, *_: object) -> None:
        nothing = lambda *_: None  # noqa: E731
        self.pushes = SimpleNamespace(measure=nothing, note=nothing, interfered=nothing)
        self.messages = SimpleNamespace(step=0, add=nothing)
        self.about_to_change = self.changed = self.edited = self.reacted = self.finish = nothing


def run(model: mujoco.MjModel, folder: Path, steps: int, given: stored.Recording | None = None) -> tuple[float, Path]:
    """Processor seconds of this process for a pass, and its recording: with the law, or driven by a recording.

    A row is recorded every thousandth step: what the recorder costs is measured elsewhere.
    """
    ports, every = Ports(model, (("force", frozenset(f"ball_{i}" for i in range(model.nbody - 1))),)), 1000
    data = start(model)
    data.qvel.reshape(-1, 6)[:, :3] = np.random.default_rng(1).normal(0, 0.4, (model.nbody - 1, 3))
    meta = describing.describe(model) | {"inputs": ports.as_meta()}
    began = time.process_time()
    if given is None:
        inputs: replayed_inputs.Drive = Asked(model, data, ports, Local(model, data, ports, Law(model)))
    else:
        inputs = Replayed(model, data, ports, given, steps)
    with Recorder(model, data, folder, meta) as recorder:
        simulate.simulate(model, data, recorder, steps, inputs, every)
    return time.process_time() - began, folder


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=STEPS)
    parser.add_argument("--bodies", type=int, default=600)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    model = scene(options.bodies).compile()
    simulate.prepare(model)
    with tempfile.TemporaryDirectory() as scratch:
        _, folder = run(model, Path(scratch) / "first", options.steps)
        given = stored.open(folder)
        megabytes = sum((folder / f"{name}.arrows").stat().st_size for name in TABLES) / 1e6
        spent: dict[str, list[float]] = {"with the ledger": [], "without": []}
        real = replayed_inputs.Ledger
        for turn in range(options.repeats):
            for name, ledger in (("with the ledger", real), ("without", Silent)):
                replayed_inputs.Ledger = ledger  # type: ignore[misc, assignment]
                spent[name].append(run(model, Path(scratch) / f"{turn}-{name}", options.steps, given)[0])
        replayed_inputs.Ledger = real  # type: ignore[misc]
        kept = sum(f.stat().st_size for f in (Path(scratch) / "0-with the ledger").glob("interventions*")) / 1e6
    per_step = {name: statistics.median(values) / options.steps * 1e6 for name, values in spent.items()}
    for name, value in per_step.items():
        print(f"{name:>16}: {value:7.1f} us of processor a step")
    print(f"{'stream':>16}: {1e6 * megabytes / options.steps:7.0f} B a step; the ledger's table {kept:.1f} MB")
    ledger = per_step["with the ledger"] - per_step["without"]
    return report(
        Figure(f"stream of {options.bodies} pushed bodies", megabytes * STEPS / options.steps, STREAM_MB, "MB"),
        Figure(f"ledger of {options.bodies} pushed bodies, a step", ledger, LEDGER_US, "us"),
    )


if __name__ == "__main__":
    sys.exit(main())
