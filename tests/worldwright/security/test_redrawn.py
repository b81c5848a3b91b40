"""A stamp that nobody known signed: its pictures are drawn again."""

import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.stage import one_frame
from worldwright.stage import tools as stage
from worldwright.stamp import acceptance, redrawn
from worldwright.stamp import tools as stamp
from worldwright.stamp.proof import Proved
from worldwright.stamp.state import State

from . import forging


def painted(path: Path) -> None:
    """A red block in the middle, as large as an eighth of the picture."""
    picture = cv2.imread(str(path))
    height, width = picture.shape[:2]
    picture[3 * height // 8 : 5 * height // 8, 3 * width // 8 : 5 * width // 8] = (0, 0, 255)
    cv2.imwrite(str(path), picture)


def another_film(path: Path) -> None:
    """As long and as large as the film, of noise."""
    film = cv2.VideoCapture(str(path))
    count, fps = int(film.get(cv2.CAP_PROP_FRAME_COUNT)), film.get(cv2.CAP_PROP_FPS)
    shown = film.read()[1]
    film.release()
    out = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), fps, (shown.shape[1], shown.shape[0]))
    for _ in range(count):
        out.write(np.full_like(shown, (200, 40, 20)))
    out.release()


def test_honest_pictures_of_a_stranger_look_as_when_drawn_again(accepted: Path, copy, monkeypatch) -> None:
    """All of them in one process: its start and the world's cost more than these pictures."""
    run, started = copy(accepted), []
    engine = one_frame.engine
    monkeypatch.setattr(one_frame, "engine", lambda *call, **limits: started.append(call) or engine(*call, **limits))
    forging.resealed(run, key="stranger")
    told = stamp.verify(str(run), timeout_s=120, anybody=True)
    assert told.ok, told.text()
    assert "look as when drawn again" in told.text()
    assert [words.count("--seen") for words, *_ in started] == [7], "a poster, two stills, two frames of each film"
    assert sum(word.startswith("still:") for word in started[0][0]) == 2


def test_a_still_is_drawn_again_as_finely_as_it_was(accepted: Path, copy) -> None:
    """A film's frame has other edges on what is thin: an honest still of slats, seen nearly along them, was refused for it."""
    run = Run(copy(accepted))
    mine = cv2.imread(str(run.accepted / "stills" / "side.png")).astype(int)
    wanted = [(quality, 0.0, "side", (mine.shape[1], mine.shape[0])) for quality in ("still", "video")]
    still, frame = (
        np.abs(cv2.imdecode(np.frombuffer(data or b"", np.uint8), cv2.IMREAD_COLOR) - mine)
        for data in stage.draw_moments(run, wanted, math.inf)[0]
    )
    assert still.max() <= 2 < frame.max()


FORGED = {"poster.webp": painted, "stills/overview.png": painted, "video/side.mp4": another_film}


def test_pictures_of_another_world_are_refused_by_name(accepted: Path, copy) -> None:
    """Each of them, and no other: the run and its drawings are the same for all, so they are forged together."""
    run = copy(accepted)
    for name, forge in FORGED.items():
        forge(run / "accepted" / name)
    forging.resealed(run, key="stranger")
    told = stamp.verify(str(run), timeout_s=120, anybody=True)
    assert not told.ok
    (refused,) = [check.detail for check in told.checks if not check.ok]
    sentences = refused.split("; ")
    assert [Path(name).name in said for name, said in zip(FORGED, sentences, strict=True)] == [True] * 3, refused
    assert all("does not show this world" in said for said in sentences)


def test_a_picture_that_cannot_be_drawn_is_named_and_hides_no_other(accepted: Path, copy) -> None:
    run = Run(copy(accepted))
    state = State(run)
    proved = Proved(run, state.passes["physics"].value, state.lint.value, state.folder / "physics" / "trajectory")
    painted(run.accepted / "stills" / "overview.png")
    (run.accepted / "stills" / "side.png").rename(run.accepted / "stills" / "nobody.png")
    for film in (run.accepted / "video").iterdir():
        film.unlink()
    nobody, overview = sorted(redrawn.glance(run.accepted, proved, math.inf))
    assert "nobody.png cannot be drawn again" in nobody and "there is no camera nobody" in nobody
    assert "overview.png does not show this world" in overview


def test_pictures_by_code_that_is_not_here_are_said_to_be_uncompared(accepted: Path, copy) -> None:
    run = copy(accepted)

    def older(value: dict) -> dict:
        value["predicate"]["environment"]["film"]["sha256"] = "0" * 64
        return value

    forging.resealed(run, older, key="stranger")
    told = stamp.verify(str(run), timeout_s=120, anybody=True)
    assert told.ok, told.text()
    assert "NOT compared with this world" in told.text()


def test_whoever_signs_looks_at_the_pictures_first(accepted: Path, copy) -> None:
    """Hashes in a journal without secrets say nothing of them: a still is painted, and every frame of a film."""
    run = Run(copy(accepted))
    state = State(run)
    recording = state.folder / "physics" / "trajectory"
    proved = Proved(run, state.passes["physics"].value, state.lint.value, recording)
    assert list(redrawn.glance(run.accepted, proved, math.inf)) == []
    painted(run.accepted / "stills" / "overview.png")
    another_film(run.accepted / "video" / "side.mp4")
    found = sorted(redrawn.glance(run.accepted, proved, math.inf))
    assert [said.split()[0] for said in found] == ["overview.png", "side.mp4"]
    painted(run.accepted / "stills" / "side.png")
    another_film(run.accepted / "video" / "overview.mp4")  # whichever is looked at first, on a machine with little time
    with pytest.raises(GateError, match="does not show this world"):
        acceptance._look(state, proved, run.accepted)
    assert len(list(redrawn.glance(run.accepted, proved, within_s=0.0))) <= 1
