"""A sheet shows a world as it starts, through cameras that are aimed at it there, or one that stands anywhere."""

import numpy as np
import pytest

from worldengine.__main__ import main
from worldengine.film import drawn_frames
from worldkit import asked, bodies, cameras, portable, scene

AWAY = 3.0


@pytest.fixture
def drawn(monkeypatch):
    """What a renderer is given: for each picture the camera, and where it and the ball stand."""
    seen = []

    class Frames:
        def __init__(self, model, width, height):
            self.model, self.size = model, (height, width, 3)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            return None

        def image(self, data, name, quality):
            seen.append((name, data.camera(name).xpos.copy(), data.body("ball").xpos.copy()))
            return np.zeros(self.size, np.uint8)

        def told(self):
            return {"name": "none"}

    monkeypatch.setattr(drawn_frames, "Frames", Frames)
    return seen


def sheet(folder, *words, camera=True):
    """Draw a ball that keyframe "start" puts elsewhere than it was built."""
    spec = scene.new("start", time_step=0.002)
    bodies.sphere(spec, "ball", diameter=0.1, pos=(0.0, 0.0, 0.5), mass=1.0, look="plastic_red")
    spec.add_key(name="start", qpos=[AWAY, 0, 0.5, 1, 0, 0, 0])
    if camera:
        cameras.add(spec, "overview", subjects=("ball",), follow=True)
    asked.Asked(lambda: spec, None, 0.01, 24, (960, 720), (), 0, (), 1, 0, None).write(folder)
    words = ["sheet", *(f"--{word}={folder / file}" for word, file in FILES.items()), f"--out={folder}", *words]
    return main(words)


FILES = {"world": "world.mjz", "program": "program.json"}


def test_it_shows_the_start_through_cameras_aimed_there(tmp_path, drawn):
    assert sheet(tmp_path, "--size=64x128") == 0
    ((name, eye, ball),) = drawn
    assert name == "overview" and ball == pytest.approx([AWAY, 0, 0.5])
    model = portable.read(tmp_path / "world.mjz")
    cameras.aim(model, aspect=0.5)
    assert eye == pytest.approx(model.camera("overview").pos)


@pytest.mark.parametrize("camera", [True, False])
def test_a_camera_stands_anywhere_in_a_world_with_or_without_planned_ones(tmp_path, drawn, camera):
    assert sheet(tmp_path, "--eye=1,2,3", "--target=0,0,0", camera=camera) == 0
    ((_, eye, _),) = drawn
    assert eye == pytest.approx([1, 2, 3])
    assert '"free"' in (tmp_path / "result.json").read_text()


def test_without_a_camera_or_a_place_it_says_how_to_add_one(tmp_path, drawn):
    assert sheet(tmp_path, camera=False) == 1
    assert "the world has no camera" in (tmp_path / "error.json").read_text() and not drawn
