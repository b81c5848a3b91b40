"""A film that several processes draw is the one that a single process draws, whatever becomes of the others."""

import json
import sys

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
    recording = record(spec, folder / "trajectory", 200)
    portable.write(spec, folder / "world.mjz")
    facts = {"duration": 0.4, "fps": 24, "size": list(SIZE), "movers": ["ball"], "visual_only": [], "seed": 0}
    facts |= {"control": "", "control_every": 1, "latency": 0}
    (folder / "program.json").write_text(json.dumps(facts))
    motion_facts.write(recording, folder / "motion.npz", facts)
    with np.load(folder / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    film.shot(still((0, -2, 0.5), "ball"), until=0.4)
    told = folder / "film"
    told.mkdir()
    lay_film(told, film, None)
    world = ["--world", str(folder / "world.mjz"), "--program", str(folder / "program.json")]
    return ["video", *world, "--from", str(folder / "trajectory"), "--film", str(told)]


def drawn(words, out, monkeypatch, count):
    """The frames of the film that so many processes draw, and how many of them others drew."""
    monkeypatch.setattr(side_by_side, "processes", lambda frames, each_bytes: count)
    taken, take = [], side_by_side.Others.take

    def counted(others, frame):
        taken.append(take(others, frame))
        return taken[-1]

    monkeypatch.setattr(side_by_side.Others, "take", counted)
    out.mkdir()
    assert engine.main([*words, "--out", str(out)]) == 0
    told = json.loads((out / "result.json").read_text())
    with av.open(str(out / "film.mp4")) as film:
        return [frame.to_ndarray() for frame in film.decode(video=0)], sum(map(bool, taken)), told["film"]


@pytest.mark.gl
def test_two_processes_draw_the_film_of_one(words, tmp_path, monkeypatch):
    alone, none, said = drawn(words, tmp_path / "alone", monkeypatch, 1)
    together, others, same = drawn(words, tmp_path / "together", monkeypatch, 2)
    assert (none, others) == (0, len(alone) // 2) and said == same
    assert len(alone) == len(together) and all(map(np.array_equal, alone, together))


LIES = "import os, sys; os.write(int(sys.argv[-1]), {!r}); sys.exit()"
SAYS = side_by_side.HEAD.pack(2, 3) + b"{}abc"


@pytest.mark.parametrize(
    "answer", [b"", b"rubbish", SAYS[:9], SAYS], ids=["nothing", "rubbish", "half a frame", "no frame"]
)
def test_what_another_process_cannot_draw_is_drawn_here(tmp_path, monkeypatch, answer):
    monkeypatch.setattr(side_by_side, "processes", lambda frames, each_bytes: 2)
    hand = side_by_side._Hand

    class Liar(hand):
        def __init__(self, words):
            monkeypatch.setattr(sys, "executable", str(liar))
            super().__init__(words)

    liar = tmp_path / "liar"
    liar.write_text(f"#!{sys.executable}\n{LIES.format(answer)}\n")
    liar.chmod(0o755)
    monkeypatch.setattr(side_by_side, "_Hand", Liar)
    with side_by_side.Others(["video"], 100, SIZE, "preview") as others:
        assert [others.take(frame) for frame in range(4)] == [None] * 4


GB = 1 << 30


@pytest.mark.parametrize(
    ("frames", "cores", "each", "count"),
    [(24, 8, GB // 2, 1), (72, 8, GB // 2, 2), (1000, 8, GB // 2, 4), (1000, 1, GB // 2, 1), (1000, 8, 2 * GB, 1)],
)
def test_so_many_processes_as_there_is_work_and_room_for(monkeypatch, frames, cores, each, count):
    monkeypatch.setattr("os.sched_getaffinity", lambda pid: range(cores))
    assert side_by_side.processes(frames, each) == count
    assert 10 << 20 < side_by_side._resident_bytes() < 64 * GB
