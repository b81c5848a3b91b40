"""What a stamp tells of its author's film is held against the film described anew, and thin words on its frames are seen."""

import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from worldengine.film.encode import Video
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run
from worldwright.stage import tools as stage
from worldwright.stamp import film_told, redrawn
from worldwright.stamp.proof import Proved
from worldwright.stamp.state import State
from worldwright.stamp.statement import Filmed

FILM = """
from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.draw("ghost", "box", (0.4, 0.3, 0.2), pos=(0.45, 0.6, 0.1), look="#b3261e")
    film.draw("wall", "box", (0.6, 0.05, 3.0), pos=(0, -0.9, 1.5), look="plastic_grey")
    film.caption("it falls 0.3 m")
    film.shot(still((0.3, -2.6, 1.0), (0.0, 0.0, 0.5)), until=0.3)
"""
SIZE = (480, 270)


@pytest.fixture(scope="module")
def shown(reviewed: Path, once) -> tuple[Path, dict]:
    """A run with a film beside its recording, and what the engine tells of it."""
    folder = once("told-anew", lambda target: _drawn(reviewed, target))
    _, said = stage.draw_moments(Run(folder), [("video", 0.0, "film", (64, 36))], math.inf)
    return folder, said


def _drawn(reviewed: Path, folder: Path) -> None:
    """Lay the film, drawn frame by frame and written as films are, where an accepted folder has it."""
    import shutil

    shutil.copytree(reviewed, folder)
    (folder / "film.py").write_text(FILM, encoding="utf-8")
    fps, count = 12, 4  # as the program of the run says
    wanted = [("video", number / fps, "film", SIZE) for number in range(count)]
    pictures, _ = stage.draw_moments(Run(folder), wanted, math.inf)
    frames = [cv2.imdecode(np.frombuffer(data or b"", np.uint8), cv2.IMREAD_COLOR) for data in pictures]
    _film(folder / "accepted" / "video" / "film.mp4", frames, fps)
    for frame in frames:
        cv2.putText(frame, "FELL 3 M: TRUE", (110, 235), cv2.FONT_HERSHEY_SIMPLEX, 0.7, (30, 30, 30), 1, cv2.LINE_AA)
    _film(folder / "accepted" / "video" / "painted.mp4", frames, fps)


def _film(path: Path, frames: list[np.ndarray], fps: int) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with Video(path, *SIZE, fps) as film:
        for frame in frames:
            film.add(np.ascontiguousarray(frame[:, :, ::-1]))
        film.cut()


def glanced(folder: Path, filmed: Filmed) -> list[str]:
    run = Run(folder)
    state = State(run)
    physics = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    proved = Proved(run, state.passes["physics"].value, state.lint.value, physics / "trajectory")
    return list(redrawn.glance(folder / "accepted", proved, math.inf, filmed))


def honest(said: dict) -> Filmed:
    return Filmed(**said["film"], sha256="0" * 64, hidden={"ball behind wall": 0.333})


def test_words_of_a_film_that_are_not_what_it_draws_are_named(shown) -> None:
    _, said = shown
    filmed = honest(said)
    assert said["hides"] == {"frames": 4, "hidden": {"ball behind wall": 4}}
    assert film_told.otherwise(filmed, said) == ""
    for name, forged in {
        "drawn only": {"drawn_only": ()},
        "captions": {"captions": ("it falls 3 m",)},
        "looks": {"looks": {"ball": "gold"}},
        "hidden": {"hidden": {}},
        "shots": {"shots": ({**filmed.shots[0], "speed": 9.0},)},
    }.items():
        assert film_told.otherwise(filmed.model_copy(update=forged), said).startswith(f"{name}: ")


def test_an_honest_film_is_passed_whatever_the_compression_leaves(shown, tmp_path: Path) -> None:
    folder, said = shown
    (folder / "accepted" / "video" / "painted.mp4").rename(tmp_path / "painted.mp4")
    assert glanced(folder, honest(said)) == []
    assert "captions: it is told nothing" in glanced(folder, honest(said).model_copy(update={"captions": ()}))[0]
    (tmp_path / "painted.mp4").replace(folder / "accepted" / "video" / "film.mp4")
    assert "strokes over" in glanced(folder, honest(said))[0]


def test_what_is_hidden_for_two_frames_may_be_met_by_chance_and_what_is_hidden_for_long_is_named(shown) -> None:
    """Two of 200 frames, both among the sixty that were asked: one honest film in eleven."""
    _, said = shown
    shots = ({**said["film"]["shots"][0], "seconds": 8.0},)
    filmed = honest(said).model_copy(update={"hidden": {"ball behind wall": 0.08}, "shots": shots})

    def found(count: int) -> str:
        hides = {"frames": 60, "hidden": {"ball behind wall": count}}
        return film_told.otherwise(filmed, {"film": {**said["film"], "shots": shots}, "hides": hides})

    assert found(2) == ""
    assert found(9).startswith("hidden: ball behind wall is told for 0.08 s, and is about 1.2 s")
