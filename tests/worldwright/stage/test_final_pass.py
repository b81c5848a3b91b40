"""The final pass: it needs physics alone, is whole however short its time, goes on, and is never asked for by acceptance."""

import shutil

import av
import pytest

from worldwright.model.evidence.run import Run
from worldwright.stage import gates
from worldwright.stage.job import Job
from worldwright.stage.tools import start, wait
from worldwright.stamp.tools import status

BLINK = 0.01
"""Minutes in which no more than the first frame can be drawn."""


def drawn(run: Run, **options):
    job = start(str(run.folder), stage="final", **options)
    for _ in range(10):
        if job.ended:
            break
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

    again, second = drawn(run, minutes=BLINK)
    assert not again.cached and again.job != job.job
    assert second["summary"]["drawn"] >= told["drawn"]
    assert not (run.jobs / job.job / "frames").exists() and (run.jobs / again.job / "frames" / "00000.png").is_file()
    assert status(str(folder)).text().splitlines()[:3] == before.text().splitlines()[:3], "no other step minds it"
