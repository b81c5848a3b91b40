"""A run that is left open is drawn once for each change, says what is half written, and ends when it is told to."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import cv2
import numpy as np
import pytest

from worldwright import kept_open
from worldwright.model.errors import JobError, NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.stage import compiled_shaders


@pytest.fixture
def run(planned, tmp_path):
    """Planned and drafted, with nothing approved or recorded, and a helper that the program reads."""
    shutil.copytree(planned, tmp_path / "ball")
    program = tmp_path / "ball/simulation.py"
    program.write_text(program.read_text().replace("import mujoco\n", "import mujoco\nimport shades\n", 1))
    (tmp_path / "ball/shades.py").write_text("")
    return Run(tmp_path / "ball")


def until(true, seconds=30.0):
    end = time.monotonic() + seconds
    while not true() and time.monotonic() < end:
        time.sleep(0.05)
    assert true()


def test_each_change_is_drawn_once_and_several_in_a_row_are_one(run):
    drawn: list[float] = []
    over = threading.Event()
    open_ = threading.Thread(target=kept_open.watch, args=(run, lambda: drawn.append(time.monotonic()), over.is_set))
    open_.start()
    until(lambda: len(drawn) == 1)
    for number, name in enumerate(("plan.md", "simulation.py", "shades.py", "film.py"), start=2):
        for line in "ab":  # an editor that writes twice
            with (run.folder / name).open("a") as stream:
                stream.write(f"# {line}\n")
        until(lambda wanted=number: len(drawn) == wanted)
    (run.folder / "notes.txt").write_text("mine")
    time.sleep(1.0)
    over.set()
    open_.join(timeout=10)
    assert not open_.is_alive() and len(drawn) == 5


@pytest.mark.gl
def test_the_start_of_what_nobody_approved_is_seen_and_leaves_no_evidence(run, monkeypatch):
    homes, lay = [], compiled_shaders.lay
    monkeypatch.setattr(compiled_shaders, "lay", lambda home: homes.append(lay(home)))
    shown = kept_open.frame(run, 0.0, "overview", None, None, 45.0)
    image = cv2.imdecode(np.frombuffer(shown.pictures[0].data, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None and image.std() > 5 and "overview" in shown.pictures[0].caption
    assert len(homes) == 1  # the engine's; the author's process draws nothing
    assert not (run.folder / "evidence").exists() and not (run.folder / "jobs").exists()
    (run.folder / "shades.py").write_text("x = (\n")
    with pytest.raises(JobError) as half:
        kept_open.frame(run, 0.0, None, "3,-2,1.5", "0,0,0.5", 45.0)
    assert half.value.place == f"{run.folder / 'shades.py'}:1"


def test_a_place_to_stand_without_one_to_look_at_is_refused(run):
    with pytest.raises(NotFoundError, match="needs the place where it stands and the one that it looks at"):
        kept_open.frame(run, 0.0, None, "3,-2,1.5", None, 45.0)


@pytest.mark.gl
def test_it_ends_cleanly_when_it_is_told_to(run, tmp_path):
    (run.folder / "shades.py").write_text("x = (\n")
    words = [str(Path(sys.executable).with_name("worldwright")), "watch", str(run.folder), "--save", str(tmp_path)]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=30) == 0
    assert line.startswith("unreadable:") and "shades.py:1" in line and not (Path(tmp_path) / "look.jpg").exists()
