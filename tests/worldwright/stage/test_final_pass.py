"""The final pass: it needs physics alone, is whole however short its time, goes on, and is never asked for by acceptance."""

import os
import shutil
from pathlib import Path
from types import SimpleNamespace

import av
import pytest

from worldengine.film.refining import named
from worldkit.files import write_json
from worldwright.model.evidence.run import Run
from worldwright.stage import authoring, gates, processes, refined
from worldwright.stage.crew import Member
from worldwright.stage.job import Job
from worldwright.stage.tools import start, wait
from worldwright.stamp.tools import status

BLINK = 0.01
"""Minutes in which no more than the first frame can be drawn."""
FILM = """\
from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.shot(still((0, -2, 1), "ball"), until=0.4)
"""


def drawn(run: Run, **options):
    job = start(str(run.folder), stage="final", **options)
    while not job.ended:
        job = wait(str(run.folder), job=job.job, timeout_s=20)
    assert job.state == "succeeded", job.text()
    return job, gates.passed(run, Job.find(run, job.job).spec.key, "final")


@pytest.mark.gl
def test_a_film_is_whole_after_a_blink_and_goes_on_with_the_same_frames(reviewed, tmp_path):
    folder = tmp_path / reviewed.name
    shutil.copytree(reviewed, folder)
    run = Run(folder)
    before = status(str(folder))
    job, first = drawn(run, minutes=BLINK)
    told = first["summary"]
    assert told["renderer"]["name"] == "traced" and "mitsuba" in told["renderer"]["version"]
    assert told["drawn"] >= 1 and not told["complete"] and told["samples"]["most"] == 0.5
    assert told["film"]["shots"], "nobody wrote a film.py, and there is a film"
    with av.open(f"{job.result}/final.mp4") as film:
        assert sum(1 for _ in film.decode(video=0)) == told["frames"] > told["drawn"]
    assert set(first["files"]) == {"final.mp4", "environment.json"}, "its frames are no evidence"

    assert told["taken_over"] == 0 and f"{told['drawn']} of its {told['frames']} frames are drawn" in first["message"]
    assert "stood already" not in first["message"] and "would draw the rest" in first["message"]
    (before_it,) = stood(run, job)

    again, second = drawn(run, minutes=BLINK)
    assert not again.cached and again.job != job.job
    assert second["summary"]["taken_over"] == told["drawn"] and f"{told['drawn']} stood already" in second["message"]
    assert stood(run, job) == [] and stood(run, again) == [before_it], "the very file, not another like it"
    assert status(str(folder)).text().splitlines()[:3] == before.text().splitlines()[:3], "no other step minds it"


def stood(run: Run, job) -> list[tuple[str, int]]:
    """The set and the time of each first frame that lies in a job's folder."""
    first = (run.jobs / job.job / "frames").glob("*/00000.png")
    return sorted((path.parent.name, path.stat().st_mtime_ns) for path in first)


@pytest.mark.gl
def test_a_slip_and_a_variant_taken_back_cost_no_frame(reviewed, tmp_path):
    folder = tmp_path / reviewed.name
    shutil.copytree(reviewed, folder)
    run = Run(folder)

    def written(text: str, ends: str = "succeeded"):
        (folder / "film.py").write_text(text)
        job = start(str(folder), stage="final", minutes=BLINK)
        while not job.ended:
            job = wait(str(folder), job=job.job, timeout_s=20)
        assert job.state == ends, job.text()
        return job

    mine = written(FILM)
    (frame,) = stood(run, mine)
    slip = written(FILM.replace("still(", "stil("), "failed")
    assert "final.mp4" in slip.message, "the house's film is there meanwhile"
    (house,) = stood(run, slip)
    assert house[0] != frame[0] and stood(run, mine) == [frame]
    back = written(FILM + "# as it was\n")
    assert stood(run, back) == [frame] and stood(run, mine) == [] and stood(run, slip) == [house]


@pytest.mark.parametrize("renderers", [("",), ("-preview",), ("", "-preview")])
def test_frames_of_the_last_films_are_kept_whatever_drew_them(tmp_path, monkeypatch, renderers):
    monkeypatch.setattr("worldengine.recording.stored.open", lambda path: SimpleNamespace(shown_sha256=path.name))
    told, jobs = tmp_path / "told", []
    told.mkdir()
    world = tmp_path / "world.mjz"
    world.write_text("oak")
    monkeypatch.setattr(Job, "all", lambda run: list(jobs))

    def final(text: str, force: bool = False) -> bool:
        """Whether there were frames of this film before; now there are."""
        (told / "film.json").write_text(text)
        spec = SimpleNamespace(stage="final", force=force)
        job = _with(Job(tmp_path / f"final-{len(jobs)}"), spec)
        job.read = lambda: SimpleNamespace(ended=True)
        refined.carry_over(None, job, told, Path("recording"), world)
        name = named(told, "recording", world)
        sets = [job.out / refined.FOLDER / f"{name}{renderer}" for renderer in renderers]
        (known,) = {frames.is_dir() for frames in sets}
        for frames in sets:
            frames.mkdir(parents=True, exist_ok=True)
            os.utime(frames, (len(jobs), len(jobs)))
        refined.put_aside(job)
        jobs.append(job)
        return known

    assert [final(text) for text in "abca"] == [False, False, False, True]
    assert [final(text) for text in "defg"] == [False] * 4
    assert not final("b") and final("g"), "of many others, the oldest are gone"
    assert not final("g", force=True)
    world.write_text("walnut")
    assert not final("g") and final("g"), "a world that looks otherwise and moves alike has frames of its own"
    world.write_text("oak")
    assert final("g")


class Scripted:
    """A crew whose processes end as they are told to."""

    def __init__(self, outcomes: list) -> None:
        self.outcomes, self.said = outcomes, []

    def start(self, name, call, out, reads, *more, **given) -> Member:
        self.said.append(f"{name} unasked" if str(authoring.UNASKED) in call else name)
        out.mkdir(parents=True, exist_ok=True)
        for left in (*out.glob("error.json"), *out.glob("result.json")):
            left.unlink()
        for file in ("film.json", "film.npz"):
            (out / file).write_text("told")
        outcome = self.outcomes.pop(0)
        write_json(out / ("error.json" if outcome else "result.json"), {"code": outcome} if outcome else {"ok": True})
        stopped = outcome if outcome in ("timed_out", "out_of_memory") else ""
        member = Member(SimpleNamespace(returncode=int(bool(outcome)), pid=0), out, None, None)
        self.stopped = {"code": stopped, "message": stopped} if stopped else None
        return member

    def watch(self, member, tick):
        return self.stopped

    def look(self):
        return None

    def cancelled(self) -> bool:
        return False

    def end(self) -> None:
        self.said.append("end")


@pytest.mark.parametrize(
    ("outcomes", "said"),
    [
        (["", ""], "author, engine"),
        (["", "timed_out"], "author, engine"),
        (["", "out_of_memory"], "author, engine"),
        (["", "crashed"], "author, engine"),
        (["", "film", "", ""], "author, engine, author unasked, engine"),
        (["program", "", ""], "author, end, author unasked, engine"),
        (["timed_out", "", ""], "author, end, author unasked, engine"),
        (["out_of_memory", "", ""], "author, end, author unasked, engine"),
        (["disk_full"], "author, end"),
    ],
)
def test_only_a_film_that_is_refused_is_replaced_and_nothing_runs_beside_it(tmp_path, monkeypatch, outcomes, said):
    monkeypatch.setattr(authoring, "lay_out", lambda *given: None)
    monkeypatch.setattr(refined, "carry_over", lambda *given: None)
    job = Job(tmp_path / "final-1")
    job.filming.mkdir(parents=True)
    (job.filming / "film.py").write_text(FILM)
    spec = SimpleNamespace(job="final-1", stage="final", key="k", reuse=(), arguments=(), file_mb=1)
    run = SimpleNamespace(folder=tmp_path, evidence=lambda key: tmp_path, source=tmp_path / "plan.md")
    crew = Scripted(list(outcomes))
    ended = processes.Acting(_with(job, spec), run, crew, lambda s: True).film()
    assert ", ".join(crew.said) == said
    assert (ended.failure or {}).get("code", "") == next((code for code in outcomes if code), "")


def _with(job: Job, spec) -> SimpleNamespace:
    """A job of this specification, which need not stand in a file."""
    names = ("folder", "out", "author", "filming", "inputs", "scratch", "lock", "log")
    return SimpleNamespace(spec=spec, **{name: getattr(job, name) for name in names})
