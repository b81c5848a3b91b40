"""What the stream of inputs and its ledger cost: in a crowd of 600 bodies that are pushed at every step, and in a light world.

A law pulls each body of the crowd to its place and brakes it, so that every force changes at every step, in all its bits;
nothing touches. The crowd is recorded with its `control`, then driven by the recorded stream twice, with the ledger and with
one that notes nothing. The difference of the processor times of the whole process (the ledger's blocks are made and written
beside the steps) is the ledger's. What would pack to nothing, and what to nothing less than it is (noise), says little of a
stream: beside the law's, the bytes of a noise of the same width are told, which have no goal.

What a stream and a ledger take to be read is told for a million rows: the processor's time, and the memory by which a process of
its own grows. So is how long it takes to refuse a stream of some kilobytes that would unpack to four gigabytes.

The light world is a tetherball with a law. It is stepped by the bare engine with that law; by the clock with mirror and stream
(no ledger, and no search for what else the law wrote, which runs beside the engine in a process of its own), a row at every
thousandth step; with ledger and search, too; then recorded in full, and driven again by its stream and recorded in full.

    python tests/bench/stream_cost.py [--steps 10000] [--bodies 600] [--repeats 3]

Goals, for 10,000 steps: a stream of at most 25 MB, a ledger of at most 20 us a step; at most 1.5 times the bare engine with the
law; driven again in at most 0.8 of the time of the first pass. Times are of the processor, of all threads. A million rows: 0.5 s and
128 MB of a stream, checked; 1.5 s and 256 MB of a ledger, summed as acceptance does; a refusal within 0.1 s.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from figures import Figure, report
from physics_pass import ROWS, push, tether

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))

import mujoco
import numpy as np
import pyarrow as pa

from worldengine.clock import simulate
from worldengine.inputs import replayed_inputs
from worldengine.inputs.author_link import Local
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked, Replayed
from worldengine.inputs.strict_stream import Recorded
from worldengine.recording import columns, describing, stored, stream_files
from worldengine.recording.record import Recorder
from worldkit.errors import RecordingError
from worldkit.world import start
from worldwright.stamp import interventions

STREAM_MB, LEDGER_US, STEPS = 25.0, 20.0, 10_000
MIRROR, AGAIN = 1.5, 0.8
STREAM_READ_S, LEDGER_READ_S, STREAM_READ_MB, LEDGER_READ_MB, REFUSED_S = 0.5, 1.5, 128.0, 256.0, 0.1
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


class Noise:
    """Pushes each body anyhow."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.random = np.random.default_rng(2)

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1:, :3] = self.random.normal(size=(model.nbody - 1, 3))


class Silent:
    """In the place of a ledger: it notes nothing."""

    def __init__(self, *_: object) -> None:
        nothing = lambda *_: None  # noqa: E731
        self.pushes = SimpleNamespace(measure=nothing, note=nothing, interfered=nothing)
        self.messages = SimpleNamespace(step=0, add=nothing)
        self.about_to_change = self.changed = self.edited = self.reacted = self.finish = nothing


class Streamed(replayed_inputs.Ledger):
    """A ledger that keeps the stream, and notes no pushes."""

    def __init__(self, *of: Any) -> None:
        super().__init__(*of)
        self.pushes = Silent().pushes  # type: ignore[assignment]

    def reacted(self) -> None:
        """Note nothing."""

    def _flush(self) -> None:
        self.messages.flush()

    def finish(self) -> None:
        """End the stream."""
        self.messages.flush()


class Unwatched(Local):
    """An author whose data nobody searches."""

    def hear(self) -> None:
        """Call the function."""
        self._speaker.answer(self._slot)


Rows = tuple[tuple[str, frozenset[str]], ...]


def run(
    model: mujoco.MjModel,
    folder: Path,
    steps: int,
    rows: Rows,
    law: Any,
    every: int = 1000,
    thrown: bool = False,
    author: type[Local] = Local,
    ledger: Any = replayed_inputs.Ledger,
) -> tuple[float, stored.Recording]:
    """Processor seconds of this process for a pass, and its recording: with a law, or driven by a recording in its place.

    A row is recorded every so many steps; what the recorder costs is measured elsewhere. What the link to a law takes once,
    before the first step, is not counted; reading a recording is.
    """
    ports, data = Ports(model, rows), start(model)
    if thrown:
        data.qvel.reshape(-1, 6)[:, :3] = np.random.default_rng(1).normal(0, 0.4, (model.nbody - 1, 3))
    meta = describing.describe(model) | {"inputs": ports.as_meta()}
    began = time.process_time()
    if isinstance(law, stored.Recording):
        inputs: replayed_inputs.Drive = Replayed(model, data, ports, law, steps)
    else:
        inputs = Asked(model, data, ports, author(model, data, ports, law))
        began = time.process_time()
    real, replayed_inputs.Ledger = replayed_inputs.Ledger, ledger  # type: ignore[misc]
    with Recorder(model, data, folder, meta) as recorder:
        simulate.simulate(model, data, recorder, steps, inputs, every)
    replayed_inputs.Ledger = real  # type: ignore[misc]
    return time.process_time() - began, stored.open(folder)


def alone(model: mujoco.MjModel, steps: int, law: Callable[..., Any]) -> float:
    """Processor seconds of the engine with a law and nothing else."""
    data = start(model)
    began = time.process_time()
    for _ in range(steps):
        mujoco.mj_step1(model, data)
        law(model, data)
        mujoco.mj_step2(model, data)
    return time.process_time() - began


def size(recording: stored.Recording, pattern: str) -> float:
    """MB of those files of a recording."""
    return sum(path.stat().st_size for path in recording.folder.glob(pattern)) / 1e6


def pushed(bodies: int) -> tuple[mujoco.MjModel, Rows]:
    """The crowd, and what its law may push."""
    model = scene(bodies).compile()
    simulate.prepare(model)
    return model, (("force", frozenset(f"ball_{i}" for i in range(bodies))),)


def most_mb() -> float:
    """The most memory that this process has had, MB (what `getrusage` tells is its parent's, too)."""
    text = Path("/proc/self/status").read_text(encoding="ascii")
    return int(text.split("VmHWM:")[1].split()[0]) * 1024 / 1e6


def read(what: str, folder: Path, bodies: int, steps: int) -> None:
    """Read a stream or a ledger in this process, and print the rows, the seconds and the MB that it takes."""
    model, rows = pushed(bodies)
    ports, before, began = Ports(model, rows), most_mb(), time.process_time()
    if what == "stream":
        found = stored.Replayable(folder)
        kept: Any = Recorded(found, model, ports, steps), len(found.inputs)
    else:
        summed = interventions.acted(folder, ())
        kept = summed, sum(row.count for row in summed)
    seconds = time.process_time() - began
    print(json.dumps([kept[1], seconds, most_mb() - before]))


def readings(folder: Path, bodies: int, steps: int) -> list[Figure]:
    """Figures of reading what a crowd has left, for a million rows each, and of refusing what is too large."""
    found = []
    for what, done_to_it, goal_s, goal_mb in (
        ("stream", "checked", STREAM_READ_S, STREAM_READ_MB),
        ("ledger", "summed", LEDGER_READ_S, LEDGER_READ_MB),
    ):
        call = [sys.executable, __file__, "--read", what, str(folder), "--bodies", str(bodies), "--steps", str(steps)]
        done = subprocess.run(call, capture_output=True, text=True, check=True)
        rows, seconds, grown_mb = json.loads(done.stdout)
        found.append(Figure(f"{what} read and {done_to_it}, a million rows", seconds / rows * 1e6, goal_s, "s"))
        found.append(Figure(f"memory of a {what}, a million rows", grown_mb / rows * 1e6, goal_mb, "MB"))
    schema, rows = columns.arrow_schema(columns.TABLES["inputs"]), 1 << 22
    zeros = pa.RecordBatch.from_arrays([pa.array(np.zeros(rows), field.type) for field in schema], schema=schema)
    path = folder.parent / "vast.arrows"
    packed = pa.ipc.IpcWriteOptions(compression="zstd")
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema, options=packed) as writer:
        for _ in range(64):
            writer.write_batch(zeros)
    print(f"{path.stat().st_size / 1e3:.0f} kB that would unpack to {64 * zeros.nbytes / 1e9:.1f} GB")
    began = time.process_time()
    try:
        stream_files.batches(path)
    except RecordingError:
        return [*found, Figure("a stream too large refused", time.process_time() - began, REFUSED_S, "s")]
    raise AssertionError("a stream too large was read")


def crowd(bodies: int, steps: int, repeats: int, scratch: Path) -> list[Figure]:
    """Figures of bodies that are pushed at every step."""
    model, rows = pushed(bodies)

    def driven(name: str, law: Any, ledger: Any = replayed_inputs.Ledger) -> tuple[float, stored.Recording]:
        return run(model, scratch / name, steps, rows, law, thrown=True, ledger=ledger)

    asked, first = driven("first", Law(model))
    stream = sum(size(first, f"{name}.arrows") for name in TABLES)
    spent: dict[str, list[float]] = {"with the ledger": [], "without": []}
    for turn in range(repeats):
        for name, ledger in (("with the ledger", replayed_inputs.Ledger), ("without", Silent)):
            seconds, again = driven(f"{turn}-{name}", first, ledger)
            spent[name].append(seconds)
            assert again.sha256 == first.sha256
    kept = size(stored.open(scratch / "0-with the ledger"), "pushes*")
    few = min(steps, 500)
    noise = size(run(model, scratch / "noise", few, rows, Noise(model))[1], "inputs*")
    per_step = {name: min(values) / steps * 1e6 for name, values in spent.items()}
    for name, value in {"asked": asked / steps * 1e6, **per_step}.items():
        print(f"{name:>16}: {value:7.1f} us of processor a step")
    print(f"{'stream':>16}: {1e6 * stream / steps:7.0f} B a step, of noise {1e6 * noise / few:.0f}")
    print(f"{'ledger':>16}: {1e6 * kept / steps:7.0f} B a step")
    ledger_us = per_step["with the ledger"] - per_step["without"]
    return [
        Figure(f"stream of {bodies} pushed bodies", stream * STEPS / steps, STREAM_MB, "MB"),
        Figure(f"ledger of {bodies} pushed bodies, a step", ledger_us, LEDGER_US, "us"),
        *readings(scratch / "0-with the ledger", bodies, steps),
    ]


def light(steps: int, repeats: int, scratch: Path) -> list[Figure]:
    """Figures of a tetherball."""
    model = tether().compile()
    simulate.prepare(model)
    spent: dict[str, list[float]] = {}
    for turn in range(repeats):
        mirrored, _ = run(model, scratch / f"m{turn}", steps, ROWS, push, author=Unwatched, ledger=Streamed)
        watched, _ = run(model, scratch / f"w{turn}", steps, ROWS, push)
        asked, first = run(model, scratch / f"a{turn}", steps, ROWS, push, every=1)
        again, second = run(model, scratch / f"b{turn}", steps, ROWS, first, every=1)
        assert second.sha256 == first.sha256
        for name, seconds in {
            "engine and law": alone(model, steps, push), "with mirror and stream": mirrored,
            "with ledger and search": watched, "first": asked, "again": again
        }.items():  # fmt: skip
            spent.setdefault(name, []).append(seconds)
    least = {name: min(values) for name, values in spent.items()}
    for name, value in least.items():
        print(f"{name:>24}: {value / steps * 1e6:7.1f} us of processor a step")
    return [
        Figure("stream and mirror / engine with control", least["with mirror and stream"] / least["engine and law"], MIRROR),
        Figure("driven again / first pass, both recorded", least["again"] / least["first"], AGAIN),
    ]  # fmt: skip


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=STEPS)
    parser.add_argument("--bodies", type=int, default=600)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--read", nargs=2, metavar=("WHAT", "FOLDER"), help="measure reading what an earlier call left")
    options = parser.parse_args()
    if options.read:
        read(options.read[0], Path(options.read[1]), options.bodies, options.steps)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        found = crowd(options.bodies, options.steps, options.repeats, scratch)
        return report(*found, *light(options.steps, options.repeats, scratch))


if __name__ == "__main__":
    sys.exit(main())
