"""The film of a world with glass is traced beside, once it is drawn; of another, of a drafted film, or unasked where nothing may, it is not."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright import traced_beside
from worldwright.draft import writing
from worldwright.model import work_beside
from worldwright.model.evidence.run import Run
from worldwright.stage import tools as stage
from worldwright.stamp import traced_ahead
from worldwright.stamp.going import Going
from worldwright.stamp.state import State

FILM = '"""A film."""\n\nfrom worldkit.filming import Film\n\n\ndef film(film: Film) -> None:\n    film.set("studio")\n'


@pytest.fixture
def filmed(reviewed: Path, copy: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch) -> Run:
    run = Run(copy(reviewed))
    monkeypatch.delenv(work_beside.SWITCH)
    (run.folder / "film.py").write_text(FILM + '    film.look("ball", "glass_clear")\n', encoding="utf-8")
    key = State(run).key
    assert key is not None
    (run.evidence(key) / "video").mkdir(exist_ok=True)
    return run


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    found: list[list[str]] = []
    monkeypatch.setattr(subprocess, "Popen", lambda words, **_: found.append(words))
    return found


def test_the_film_of_a_world_with_glass_is_traced_beside_and_it_says_where(filmed: Run, begun: list[list[str]]) -> None:
    said = traced_ahead.begin(filmed)
    assert "traced beside for 4 minutes" in said and "/final/final.mp4" in said
    assert begun[0][3:5] == [traced_ahead.MODULE, str(filmed.folder)]


@pytest.mark.parametrize("why", ["nothing is clear", "as it was drafted", "no film", "switched off"])
def test_else_it_is_not(filmed: Run, begun: list[list[str]], monkeypatch: pytest.MonkeyPatch, why: str) -> None:
    film = filmed.folder / "film.py"
    if why == "nothing is clear":
        film.write_text(FILM, encoding="utf-8")
    elif why == "as it was drafted":
        monkeypatch.setattr(writing, "film_as_drafted", lambda _: True)
    elif why == "no film":
        film.unlink()
    else:
        monkeypatch.setenv(work_beside.SWITCH, work_beside.OFF)
    assert traced_ahead.begin(filmed) == "" and not begun


@pytest.mark.parametrize(
    ("state", "says", "begins"),
    [
        ("succeeded", "traced, ", 0),
        ("failed", "", 0),
        ("cancelled", "", 0),
        ("lost", "beside", 1),
        ("running", "beside", 1),
    ],
)
def test_what_ended_is_not_begun_again_unasked(
    filmed: Run, begun: list[list[str]], monkeypatch: pytest.MonkeyPatch, state: str, says: str, begins: int
) -> None:
    job = SimpleNamespace(state=state, ended=state != "running", message="147 of its 158 frames are drawn")
    monkeypatch.setattr(stage, "latest", lambda run, name: job if name == "final" else None)
    said = traced_ahead.begin(filmed)
    assert says in said and bool(said) == bool(says) and len(begun) == begins


def test_the_process_takes_the_lowest_priority_and_starts_the_pass(
    filmed: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[object] = []
    monkeypatch.setattr(os, "nice", done.append)
    monkeypatch.setattr(stage, "start", lambda run, stage, minutes: done.append((run, stage, minutes)))
    traced_beside.main(str(filmed.folder))
    assert done == [19, (str(filmed.folder), "final", traced_ahead.MINUTES)]


def test_a_walk_tells_it(filmed: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(traced_ahead, "begin", lambda _: "traced beside for 4 minutes")
    monkeypatch.setattr("worldwright.stamp.audited.robust_beside", lambda *_, **__: "")
    heard: list[tuple[str, str, str]] = []
    walk = Going(filmed, say=lambda *row: heard.append(row))
    monkeypatch.setattr(walk, "actions", lambda: iter([(n, lambda: "so") for n in ("causes", "stills", "video")]))
    found = walk.go()
    assert ("traced", "done", found.traced) in heard and "· traced  traced beside" in found.text()
