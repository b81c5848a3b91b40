"""What is started before the first picture of an approved plan: each thing once, and nothing that the picture does not need.

Counted, not timed: a process that imports the engine costs about a second of a processor, whatever it then does.
"""

import subprocess
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.model.evidence.run import Run
from worldwright.stage.job import Job
from worldwright.stamp import going, halts
from worldwright.stamp import tools as stamp

ASKED_ONCE = ("--version", "probe.py", "warm.nursery")
"""What a machine or a process is asked once, whichever run asks first: its sandbox's version, whether it confines, to be forked from."""


def kind(words) -> str:
    """What a command line starts, in a word."""
    said = " ".join(map(str, words))
    found = [name for name in ("compile_world", "place.preroll", "stage.supervisor") if name in said]
    return found[0] if found else said[:200]


@pytest.fixture
def started(monkeypatch, tmp_path):
    """Every process that this one starts, by its kind, with no answer kept of an earlier test."""
    seen: list[str] = []
    original = subprocess.Popen.__init__

    def init(self, args, *more, **options):
        if not any(word in str(args) for word in ASKED_ONCE):
            seen.append(kind(args))
        original(self, args, *more, **options)

    monkeypatch.setenv("WORLDWRIGHT_PREROLLS", str(tmp_path / "prerolls"))
    monkeypatch.setattr(subprocess.Popen, "__init__", init)
    return seen


@pytest.mark.gl
@pytest.mark.slow
def test_before_the_first_picture_each_process_is_started_once(tmp_path, small_plan, started, monkeypatch):
    monkeypatch.setattr(going.Going, "attended", False)  # the drafted film is drawn behind it
    folder = tmp_path / "ball"
    folder.mkdir()
    (folder / "plan.md").write_text(small_plan, encoding="utf-8")
    stamp.go(str(folder))
    stamp.approve(str(folder), by="tester")
    while not (gone := stamp.go(str(folder), until="expect", timeout_s=30)).storyboard:
        assert gone.state in ("running", "waiting"), gone.text()
    assert list(Path(gone.storyboard).glob("*.jpg"))
    assert Counter(started) <= Counter({  # a world that another test compiled is known, and not compiled again
        "place.preroll": 1,  # the exact shapes and views of the layout, which the approved plan still has
        "stage.supervisor": 3,  # bundle, physics, storyboard
        "compile_world": 1,  # what lint looks at: the bundle, which a draft's twin is, too
    })  # fmt: skip
    jobs = [job.spec for job in Job.all(Run(folder))]
    assert sorted(spec.stage for spec in jobs) == ["bundle", "physics", "storyboard"]


@pytest.mark.gl
@pytest.mark.slow
def test_audits_and_films_wait_for_the_first_picture(tmp_path, small_plan):
    """Also where a call's time ends while the picture is drawn: what is drawn next would take its processor."""
    folder = tmp_path / "ball"
    folder.mkdir()
    (folder / "plan.md").write_text(small_plan, encoding="utf-8")
    stamp.go(str(folder))
    stamp.approve(str(folder), by="tester")
    while not (gone := stamp.go(str(folder), timeout_s=1)).storyboard:
        assert gone.state == "running", gone.text()
        assert {job.spec.stage for job in Job.all(Run(folder))} <= {"bundle", "physics", "storyboard"}


FILM = """\
from worldkit.filming import Film, wide


def film(film: Film) -> None:
    film.particles("dust", lambda t: t[:, None, None] * [[[0.1, 0.0, float('inf')]]], diameter=0.01)
    film.shot(wide(), until=0.1)
"""


@pytest.mark.slow
def test_an_authors_film_is_tried_before_physics_and_holds_up_only_what_films(tmp_path, small_plan):
    folder = tmp_path / "ball"
    folder.mkdir()
    (folder / "plan.md").write_text(small_plan, encoding="utf-8")
    stamp.go(str(folder))
    stamp.approve(str(folder), by="tester")
    (folder / "film.py").write_text(FILM)
    told, gone = [], stamp.go(str(folder), timeout_s=0.01)
    while gone.state == "running":
        told.append(gone.held.get("lint", ""))
        gone = stamp.go(str(folder), timeout_s=1)
    assert any("film.py:5" in said and "not the physics" in said for said in told), told
    assert gone.wrong[0].step == "stills" and "film.py:5" in gone.wrong[0].what, gone.text()
    assert {job.spec.stage for job in Job.all(Run(folder))} >= {"bundle", "physics", "video"}
    (folder / "film.py").write_text(FILM.replace("film.particles", "film.nothing"))
    while (gone := stamp.go(str(folder), until="expect")).state == "running":
        pass
    assert "expect" in gone.held and not gone.wrong, gone.text()


class Walk(going.Going):
    """A walk whose steps hold, and that notes what is drawn, in its order; a film takes `calls` of them."""

    calls = 1
    drawn: list[str]

    def passed(self, stage):
        if stage == "video" and self.calls:
            raise halts.RunningError("video: under way")
        self.drawn.append(stage)
        return ""

    def step(self, name):
        return SimpleNamespace(holds=True, detail="", status="holds" if "video" in self.drawn else "missing")

    def begin_pictures(self):
        self.drawn.append("film begins" if self.film_due() else "pictures begin")

    def draw(self):
        self.drawn.append("storyboard")
        self.storyboard = "there"

    def told(self, turn):
        return tuple(self.drawn)

    def nothing(self):
        return ""

    check = place = approve = draft = lint = physics = scan = expect = causes = nothing


def walked(folder: Path, calls: int, until=None) -> tuple[str, ...]:
    walk = Walk(Run(folder), until=until)
    walk.calls, walk.drawn = calls, []
    return walk.go()


def test_an_authors_film_is_drawn_before_any_other_picture(tmp_path):
    assert walked(tmp_path, 0) == ("storyboard", "pictures begin", "stills", "video")
    (tmp_path / "film.py").write_text(FILM)
    assert walked(tmp_path, 1) == ("film begins",)
    assert walked(tmp_path, 0) == ("film begins", "video", "stills", "video", "storyboard")
    assert walked(tmp_path, 0, until="expect") == ("storyboard",)


@pytest.mark.gl
@pytest.mark.slow
def test_a_run_with_a_film_comes_as_far_as_its_description(tmp_path, small_plan):
    folder = tmp_path / "ball"
    folder.mkdir()
    (folder / "plan.md").write_text(small_plan, encoding="utf-8")
    stamp.go(str(folder))
    stamp.approve(str(folder), by="tester")
    (folder / "film.py").write_text("".join(line for line in FILM.splitlines(keepends=True) if "particles" not in line))
    while (gone := stamp.go(str(folder), timeout_s=30)).state == "running":
        pass
    assert not gone.wrong and {"stills", "video"} <= set(gone.held) and "describe" in gone.next_move, gone.text()
