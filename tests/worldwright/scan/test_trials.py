"""A repetition that this machine had no room for, or could not begin, says nothing of the world."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.model.errors import JobError
from worldwright.model.evidence.run import Run
from worldwright.scan.audits.trials import LIMITS, Trials
from worldwright.stage import tools as stage
from worldwright.stamp.proof import OF_THE_MACHINE


def collected(monkeypatch: pytest.MonkeyPatch, code: str, *, begins: bool) -> Trials:
    """The one repetition of a run, whose pass ends with a code, or cannot begin for it."""

    def run_variant(*_: object, **__: object) -> SimpleNamespace:
        if not begins:
            raise JobError("the job cannot be set up", code=code, place="jobs", next_move="free some space there")
        return SimpleNamespace(ended=True, state="failed", code=code, message="it ended", next_move="", job="")

    monkeypatch.setattr(stage, "run_variant", run_variant)
    trials = Trials(Run(Path("nowhere")))
    trials.ask("--without", "gravity")
    assert trials.collect(0.0)
    return trials


@pytest.mark.parametrize("begins", [True, False])
@pytest.mark.parametrize("code", ["too_many_processes", "file_too_large", "out_of_cpu_time", *OF_THE_MACHINE])
def test_what_the_machine_stops_is_the_machines(monkeypatch: pytest.MonkeyPatch, code: str, begins: bool) -> None:
    trials = collected(monkeypatch, code, begins=begins)
    assert trials.limited == {"without gravity"}
    assert trials.told()[0].failed.partition(":")[0] == code and code in LIMITS  # so says a report of it, too


def test_what_the_world_does_is_the_worlds(monkeypatch: pytest.MonkeyPatch) -> None:
    trials = collected(monkeypatch, "diverged", begins=True)
    assert trials.failed == {"without gravity": "diverged: it ended"} and not trials.limited


def test_a_pass_that_cannot_begin_tells_why_and_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    trials = collected(monkeypatch, "disk_full", begins=False)
    assert trials.failed["without gravity"] == "disk_full: the job cannot be set up; free some space there"
