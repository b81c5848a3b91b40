"""A film that several processes draw is the one that a single process draws, whatever becomes of the others."""

import json
import shlex
import sys
from types import SimpleNamespace

import av
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine import __main__ as engine
from worldengine.film import motion_facts, side_by_side
from worldkit import portable
from worldkit.filming import Film, Recorded, still

SIZE = (96, 54)


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    """The command line of a video pass of a falling ball, less where it writes."""
    folder = tmp_path_factory.mktemp("side_by_side")
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.6), rgba=(0.8, 0.1, 0.1, 1))
    spec.worldbody.add_camera(name="side", pos=(0, -3, 0.5), xyaxes=(1, 0, 0, 0, 0, 1))
    recording = record(spec, folder / "trajectory", 1000)
    portable.write(spec, folder / "world.mjz")
    facts = {"duration": 0.8, "fps": 24, "size": list(SIZE), "movers": ["ball"], "visual_only": [], "seed": 0}
    facts |= {"control": "", "control_every": 1, "latency": 0}
    (folder / "program.json").write_text(json.dumps(facts))
    motion_facts.write(recording, folder / "motion.npz", facts)
    with np.load(folder / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    film.shot(still((0, -2, 0.5), "ball"), until=0.8)
    told = folder / "film"
    told.mkdir()
    lay_film(told, film, None)
    world = ["--world", str(folder / "world.mjz"), "--program", str(folder / "program.json")]
    return ["video", *world, "--from", str(folder / "trajectory"), "--film", str(told)]


def drawn(words, out, monkeypatch, count):
    """The frames of the film that so many processes draw, and how many of them others drew."""
    monkeypatch.setattr(side_by_side, "processes", lambda *_: count)
    taken, take = [], side_by_side.Others.take

    def counted(others, frame, renderer):
        taken.append(take(others, frame, renderer))
        return taken[-1]

    monkeypatch.setattr(side_by_side.Others, "take", counted)
    out.mkdir()
    assert engine.main([*words, "--out", str(out)]) == 0
    told = json.loads((out / "result.json").read_text())
    with av.open(str(out / ("film.mp4" if "film" in told else "side.mp4"))) as film:
        return [frame.to_ndarray() for frame in film.decode(video=0)], sum(map(bool, taken)), told.get("film")


@pytest.mark.gl
def test_two_processes_draw_the_film_of_one(words, tmp_path, monkeypatch):
    alone, none, said = drawn(words, tmp_path / "alone", monkeypatch, 1)
    together, others, same = drawn(words, tmp_path / "together", monkeypatch, 2)
    first = side_by_side.STARTING
    assert (none, others) == (0, (len(alone) - first) // 2) and others and said == same
    assert len(alone) == len(together) and all(map(np.array_equal, alone, together))


@pytest.mark.gl
def test_two_processes_draw_the_planned_cameras_of_one(words, tmp_path, monkeypatch):
    planned = words[: words.index("--film")]
    alone, none, _ = drawn(planned, tmp_path / "alone", monkeypatch, 1)
    together, others, _ = drawn(planned, tmp_path / "together", monkeypatch, 2)
    assert (none, others) == (0, (len(alone) - side_by_side.STARTING) // 2) and others
    assert len(alone) == len(together) and all(map(np.array_equal, alone, together))


def test_of_some_frames_others_draw_their_share_by_place_and_not_by_number(tmp_path):
    screening = SimpleNamespace(
        picture=lambda frame: np.full((1, 1, 3), frame, np.uint8),
        hidden=list,
        frames=SimpleNamespace(renderer="preview"),
    )
    path = tmp_path / "pipe"
    with path.open("wb") as pipe:
        side_by_side.draw(screening, (1, 2), range(100, 130), pipe)
    data, found = path.read_bytes(), []
    while data:
        words, picture = HEAD.unpack(data[: HEAD.size])
        told, data = json.loads(data[HEAD.size : HEAD.size + words]), data[HEAD.size + words :]
        found.append((told["frame"], data[0]))
        data = data[picture:]
    first = side_by_side.STARTING + 1
    assert found == [(place, 100 + place) for place in range(first, 30, 2)]


LIES = "import os, sys, time; os.write(int(sys.argv[-1]), {!r}); time.sleep({}); sys.exit()"
HEAD, PYTHON = side_by_side.HEAD, sys.executable
ANSWERS = {
    "nothing": b"",
    "half a head": b"rub",
    "no words": HEAD.pack(3, 3) + b"{{{abc",
    "words of another kind": HEAD.pack(2, 3) + b"[]abc",
    "half a frame": HEAD.pack(2, 3) + b"{}a",
    "no frame": HEAD.pack(2, 3) + b"{}abc",
}


def takes(monkeypatch, tmp_path, answer, stays=0.0):
    """What is taken of eight frames from another process that answers so."""
    liar, words = tmp_path / "liar", tmp_path / "lies.py"
    words.write_text(LIES.format(answer, stays))
    liar.write_text(f'#!/bin/sh\nexec {shlex.quote(PYTHON)} {shlex.quote(str(words))} "$@"\n')  # no #! takes a blank
    liar.chmod(0o755)
    monkeypatch.setattr(side_by_side, "processes", lambda *_: 2)
    monkeypatch.setattr(side_by_side.sys, "executable", str(liar))
    with side_by_side.Others(["video"], 100, SIZE) as others:
        return [others.take(frame, "preview") for frame in range(side_by_side.STARTING + 4)]


@pytest.mark.parametrize("answer", ANSWERS.values(), ids=ANSWERS)
def test_what_another_process_cannot_draw_is_drawn_here(tmp_path, monkeypatch, answer):
    assert not any(takes(monkeypatch, tmp_path, answer))


def test_another_process_that_is_stuck_is_not_waited_for(tmp_path, monkeypatch):
    monkeypatch.setattr(side_by_side, "PATIENCE_S", 0.2)
    assert not any(takes(monkeypatch, tmp_path, b"", stays=600.0))


def test_a_frame_of_another_renderer_is_not_taken(tmp_path, monkeypatch):
    first = side_by_side.STARTING + 1
    said = json.dumps({"frame": first, "renderer": "preview", "hidden": []}).encode()
    picture = bytes(3 * SIZE[0] * SIZE[1])
    good = HEAD.pack(len(said), len(picture)) + said + picture
    assert [bool(taken) for taken in takes(monkeypatch, tmp_path, good)][first] is True
    other = good.replace(b"preview", b"classic")
    assert not any(takes(monkeypatch, tmp_path, other))


GB = 1 << 30


@pytest.mark.parametrize(
    ("frames", "cores", "each", "count"),
    [(24, 8, GB // 2, 1), (72, 8, GB // 4, 2), (1000, 8, GB // 2, 4), (1000, 1, GB // 2, 1), (1000, 8, 2 * GB, 1)],
)
def test_so_many_processes_as_there_is_work_and_room_for(monkeypatch, frames, cores, each, count):
    monkeypatch.setattr("os.sched_getaffinity", lambda pid: range(cores))
    monkeypatch.setattr(side_by_side, "_free_bytes", lambda: 64 * GB)
    assert side_by_side.processes(frames, each) == count
    assert side_by_side.processes(frames, each, 2 * each) == 1, "two of them would grow beyond it"
    monkeypatch.setattr(side_by_side, "_free_bytes", lambda: 0)
    assert side_by_side.processes(frames, each) == 1, "nothing is free"
    assert 10 << 20 < side_by_side._resident_bytes() < 64 * GB
