"""The audit of robustness is made beside other work: once, one world at a time, and nothing that looks meanwhile is disturbed."""

import contextlib
import os
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright import robust_beside
from worldwright.model import work_beside
from worldwright.model.errors import GateError
from worldwright.model.evidence import environment
from worldwright.model.evidence.audits import RobustReport
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.scan.audits import robustness, trials, unasked_audit
from worldwright.stage import tools as stage
from worldwright.stamp import scope
from worldwright.stamp.state import State


@pytest.fixture
def measured(reviewed: Path, copy: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.delenv(work_beside.SWITCH)
    return Run(copy(reviewed))


def kept(run: Run) -> Path:
    return run.evidence(run.evidence_key(environment.current().sha256())) / "robust.json"


def lines(run: Run) -> list[str]:
    return [str(entry.get("action")) for entry in run.entries()]


def processes(run: Run) -> list[int]:
    """Those that audit this run beside: each leads a session of its own, which a copy that it forks to start another does not."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            words, process = path.read_bytes().split(b"\0"), int(path.parent.name)
            if (
                unasked_audit.MODULE.encode() in words
                and str(run.folder).encode() in words
                and os.getsid(process) == process
            ):
                found.append(process)
    return found


@pytest.fixture
def ended(measured: Run) -> Iterator[None]:
    """Nothing goes on after the test."""
    yield
    for process in processes(measured):
        os.kill(process, signal.SIGKILL)
    for job in stage.status(str(measured.folder)).audits:
        (measured.jobs / job.job / "cancel").touch()


def until(holds: Callable[[], object]) -> None:
    end = time.monotonic() + 60
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.slow
@pytest.mark.usefixtures("ended")
def test_it_is_begun_once_in_a_process_of_lowest_priority(measured: Run) -> None:
    before = time.monotonic()
    assert "beside" in scan.begin_robust(measured) == scan.begin_robust(measured)
    assert time.monotonic() - before < 20, "the caller waits for none of it"
    until(lambda: stage.status(str(measured.folder)).audits)
    (process,) = processes(measured)
    assert os.getpriority(os.PRIO_PROCESS, process) == unasked_audit.LOWEST


@pytest.mark.gl
@pytest.mark.slow
def test_at_its_end_the_journal_vouches_for_it_and_the_report_tells_and_it_is_not_paid_again(
    measured: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(robustness, "WORLDS", (("--vary", "start=1.01"),))
    monkeypatch.setattr(os, "nice", lambda _: 0)  # the tests' own process keeps its priority
    measured.report.write_text("as it was", encoding="utf-8")
    robust_beside.main(str(measured.folder))
    report = RobustReport.model_validate_json(kept(measured).read_bytes())
    assert [(c.holds, c.of) for c in report.claims] == [(1, 1)]
    assert "1 of 1</span> <b>falls</b>" in measured.report.read_text(encoding="utf-8")
    assert list(scope.refusals(State(measured))) == []
    done = lines(measured)
    assert done.count("robust") == 1
    robust_beside.main(str(measured.folder))
    assert scan.begin_robust(measured) == report.text().splitlines()[-1] and lines(measured) == done
    assert processes(measured) == []


def test_who_looks_while_a_report_is_kept_finds_none_that_nobody_vouches_for(measured: Run) -> None:
    class Watched(Run):
        def keep(self, key, name, report):
            assert list(scope.refusals(State(Run(self.folder)))) == []
            super().keep(key, name, report)
            assert list(scope.refusals(State(Run(self.folder)))) == []

    run = Watched(measured.folder)
    key = run.evidence_key(environment.current().sha256())
    run.keep_vouched(key, "robust", RobustReport(trajectory_sha256=""), "scan", claims=0)
    assert kept(run).is_file()


def test_without_a_claim_that_holds_or_where_nothing_is_done_unasked_nothing_begins(
    measured: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(work_beside.SWITCH, work_beside.OFF)
    assert scan.begin_robust(measured) == ""
    monkeypatch.delenv(work_beside.SWITCH)
    kept(measured).with_name("expect.json").unlink()
    assert scan.begin_robust(measured) == "" and processes(measured) == []


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """A run whose recording has the hash `now`."""
    (tmp_path / "plan.md").write_text("a plan", encoding="utf-8")
    (tmp_path / "simulation.py").write_text("one = 1\n", encoding="utf-8")
    monkeypatch.setattr(unasked_audit, "read_trajectory", lambda _: SimpleNamespace(sha256="now"))
    return Run(tmp_path)


def test_a_report_of_another_recording_or_for_which_nobody_vouches_is_none(small: Run) -> None:
    key, report = small.evidence_key("here"), RobustReport(trajectory_sha256="now")
    Run(small.folder).keep(key, "robust", report)
    assert unasked_audit._kept(small, key) is None, "no line of the journal tells of it"
    small.keep_vouched(key, "robust", RobustReport(trajectory_sha256="before"), "scan")
    assert unasked_audit._kept(small, key) is None
    small.keep_vouched(key, "robust", report, "scan")
    assert unasked_audit._kept(small, key) == report


def test_one_world_is_made_at_a_time(small: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    under_way, together = dict[str, int](), []

    def run_variant(_: Run, variant: str, *__: object, **___: object) -> SimpleNamespace:
        under_way[variant] = 3
        together.append(len(under_way))
        return SimpleNamespace(ended=False, job=variant)

    def wait(_: str, job: str, **__: object) -> SimpleNamespace:
        under_way[job] -= 1
        ended = under_way[job] == 0 and under_way.pop(job) == 0
        return SimpleNamespace(ended=ended, state="succeeded" if ended else "running")

    monkeypatch.setattr(robustness, "report", lambda *_: RobustReport(trajectory_sha256="now"))
    monkeypatch.setattr(os, "nice", lambda _: 0)
    monkeypatch.setattr(stage, "run_variant", run_variant)
    monkeypatch.setattr(stage, "wait", wait)
    monkeypatch.setattr(stage, "variant_folder", lambda *_: small.folder)
    monkeypatch.setattr(trials, "read_trajectory", lambda _: None)
    monkeypatch.setattr(trials, "POLL_S", 0.0)
    unasked_audit.finish(small, small.evidence_key("here"), None, None)
    assert together == [1] * len(robustness.WORLDS)


@pytest.mark.parametrize("changed_in", [1, 2])
def test_a_world_that_is_changed_meanwhile_ends_the_audit(
    small: Run, monkeypatch: pytest.MonkeyPatch, changed_in: int
) -> None:
    started = []

    def run_variant(run: Run, variant: str, *_: object, **__: object) -> SimpleNamespace:
        started.append(variant)
        if len(started) == changed_in:
            run.program.write_text("one = 2\n", encoding="utf-8")
        return SimpleNamespace(ended=True, state="succeeded")

    monkeypatch.setattr(robustness, "WORLDS", (("--vary", "start=1.01"), ("--vary", "start=0.99")))
    monkeypatch.setattr(robustness, "report", lambda *_: RobustReport(trajectory_sha256="now"))
    monkeypatch.setattr(os, "nice", lambda _: 0)
    monkeypatch.setattr(stage, "run_variant", run_variant)
    monkeypatch.setattr(stage, "variant_folder", lambda *_: small.folder)
    monkeypatch.setattr(trials, "read_trajectory", lambda _: None)
    key = small.evidence_key("here")
    with pytest.raises(GateError, match="changed while"):
        unasked_audit.finish(small, key, None, None)
    assert len(started) == changed_in and not (small.evidence(key) / "robust.json").exists()


def test_what_keeps_it_from_its_end_stands_in_the_journal(measured: Run) -> None:
    measured.program.write_text("one = 2\n", encoding="utf-8")
    robust_beside.main(str(measured.folder))
    last = list(measured.entries())[-1]
    assert last["action"] == "robust_failed" and "no recording" in last["message"]
