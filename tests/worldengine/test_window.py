"""Looking on live: a window shows the world of the file, simulated in real time or as it was recorded. No display is needed."""

import contextlib
import json

import mujoco
import numpy as np
import pytest
from mujoco import viewer

from small_worlds import ball, empty, floor
from worldengine.__main__ import main
from worldengine.recording import stored
from worldkit import portable, world

DURATION = 0.1


class Window:
    """What `mujoco.viewer` opens, as far as it is used: it closes itself after so many pictures, and keeps what each showed."""

    def __init__(self, pictures: int) -> None:
        self.left, self.shown = pictures, []

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> "Window":
        self.model, self.data = model, data
        return self

    def __enter__(self) -> "Window":
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def lock(self) -> contextlib.AbstractContextManager[None]:
        return contextlib.nullcontext()

    def is_running(self) -> bool:
        return self.left > 0 and not self.data.time > DURATION - 1e-9

    def sync(self) -> None:
        self.left -= 1
        self.shown.append((self.data.time, self.data.qpos.copy()))


@pytest.fixture
def words(tmp_path):
    """The world as one file, and the words that name it to the engine's process."""
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.3))
    portable.write(spec, tmp_path / "world.mjz")
    facts = {"duration": DURATION, "fps": 24, "size": [64, 64], "movers": ["ball"], "visual_only": [], "seed": 0}
    facts |= {"control": None, "control_every": 1, "latency": 0}
    (tmp_path / "program.json").write_text(json.dumps(facts))
    named = ["--world", str(tmp_path / "world.mjz"), "--program", str(tmp_path / "program.json")]
    return [*named, "--out", str(tmp_path / "out")]


def test_a_world_is_simulated_live_to_its_end(words, tmp_path, monkeypatch):
    window = Window(pictures=100_000)
    monkeypatch.setattr(viewer, "launch_passive", window)
    (tmp_path / "out").mkdir()
    assert main(["view", *words]) == 0
    model = portable.read(tmp_path / "world.mjz")
    alone = world.start(model)
    while alone.time < window.data.time - 1e-9:
        mujoco.mj_step(model, alone)
    assert window.data.time == pytest.approx(DURATION) and window.shown
    assert np.array_equal(alone.qpos, window.data.qpos)


def test_a_recording_is_played_in_a_window(words, tmp_path, monkeypatch):
    (tmp_path / "out").mkdir()
    assert main(["physics", *words]) == 0
    recording = stored.open(tmp_path / "out" / "trajectory")
    window = Window(pictures=3)
    monkeypatch.setattr(viewer, "launch_passive", window)
    assert main(["view", *words, "--from", str(tmp_path / "out" / "trajectory")]) == 0
    rows = {tuple(row) for row in np.asarray(recording.qpos).tolist()}
    assert len(window.shown) == 3 and all(tuple(qpos.tolist()) in rows for _, qpos in window.shown)


def test_without_a_display_the_next_move_is_told(words, tmp_path, monkeypatch):
    def none(*_):
        raise RuntimeError("could not initialize GLFW")

    monkeypatch.setattr(viewer, "launch_passive", none)
    (tmp_path / "out").mkdir()
    assert main(["view", *words]) == 1
    told = json.loads((tmp_path / "out" / "error.json").read_text())
    assert "could not initialize GLFW" in told["message"] and "--pass video" in told["next_move"]
