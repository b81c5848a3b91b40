"""Video pass against a bare loop that renders and encodes the same frames one after the other. Goal: at most 1.10.

The bare loop has the states in memory; it sets each, draws it with the same renderer and encodes it with the same
settings in the same thread. Runs alternate; the ratio is that of the medians. `mj_step` is replaced while the video
pass runs, so a call would end the benchmark.

    python tests/bench/video_pass.py [--seconds 2] [--repeats 3] [--size 1280x720]
"""

import argparse
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

from figures import Figure, report

os.environ.setdefault("MUJOCO_GL", "egl")
sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))

import av
import mujoco
import numpy as np

from worldengine.clock.simulate import prepare, simulate
from worldengine.film import encode, passes
from worldengine.film.drawn_frames import Frames
from worldengine.recording import stored
from worldengine.recording.describing import describe
from worldengine.recording.record import Recorder
from worldengine.recording.replay import frame_rows
from worldkit import bodies, cameras, motion, scene
from worldkit.world import start

GOAL = 1.10
FPS = 24


def world() -> mujoco.MjSpec:
    """Eight bodies thrown over a floor."""
    spec = scene.new("bench", time_step=0.002)
    names = [f"thing_{i}" for i in range(8)]
    for i, name in enumerate(names):
        place = (0.3 * (i % 4), 0.3 * (i // 4), 0.4 + 0.05 * i)
        if i % 2:
            bodies.box(spec, name, size=(0.15, 0.1, 0.08), pos=place)
        else:
            bodies.sphere(spec, name, diameter=0.14, pos=place)
    cameras.add(spec, "overview", view="perspective", subjects=names)
    motion.launch(spec, {"thing_0": motion.Launch(linear=(1, 0.5, 0))})
    return spec


def bare(recording: stored.Recording, out: Path, size: tuple[int, int]) -> float:
    """Seconds of the bare loop, over states that lie in memory."""
    model = world().compile()
    cameras.aim(model, recording.pos)
    data = mujoco.MjData(model)
    states = np.array(recording.qpos[frame_rows(recording.time, FPS)])
    started = time.perf_counter()
    with (
        Frames(model, *size) as frames,
        av.open(str(out), "w", options={"movflags": "+faststart"}) as container,
    ):
        options = {"crf": encode.QUALITY, "preset": encode.PRESET}
        stream = container.add_stream("libx264", rate=FPS, options=options)
        stream.width, stream.height, stream.pix_fmt = *size, "yuv420p"
        stream.codec_context.thread_count = min(2, os.cpu_count() or 1)
        for state in states:
            data.qpos[:] = state
            mujoco.mj_fwdKinematics(model, data)
            image = frames.image(data, "overview", quality="video")
            container.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="rgb24")))
        container.mux(stream.encode(None))
    return time.perf_counter() - started


def ours(recording: stored.Recording, out: Path, size: tuple[int, int]) -> float:
    """Seconds of the video pass."""
    model = world().compile()
    step = mujoco.mj_step, mujoco.mj_step1, mujoco.mj_step2
    mujoco.mj_step = mujoco.mj_step1 = mujoco.mj_step2 = None
    started = time.perf_counter()
    try:
        passes.video(model, recording, ["overview"], out, lambda done, total: None, (), size, FPS)
        return time.perf_counter() - started
    finally:
        mujoco.mj_step, mujoco.mj_step1, mujoco.mj_step2 = step


def main() -> int:
    """Print both medians and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--size", default="1280x720")
    options = parser.parse_args()
    width, height = (int(side) for side in options.size.split("x"))
    measured: dict[str, list[float]] = {"bare": [], "video pass": []}
    with tempfile.TemporaryDirectory() as folder:
        model = world().compile()
        meta = describe(model)
        prepare(model)
        data = start(model)
        with Recorder(model, data, Path(folder) / "trajectory", meta) as recorder:
            simulate(model, data, recorder, round(options.seconds / 0.002))
        recording = stored.open(Path(folder) / "trajectory")
        for _ in range(options.repeats):
            measured["bare"].append(bare(recording, Path(folder) / "bare.mp4", (width, height)))
            measured["video pass"].append(ours(recording, Path(folder), (width, height)))
    frames = round(options.seconds * FPS)
    medians = {name: statistics.median(values) for name, values in measured.items()}
    for name, value in medians.items():
        print(f"{name:>10}: {value / frames * 1000:6.1f} ms a frame")
    ratio = medians["video pass"] / medians["bare"]
    return report(Figure("video pass / bare loop", ratio, GOAL))


if __name__ == "__main__":
    sys.exit(main())
