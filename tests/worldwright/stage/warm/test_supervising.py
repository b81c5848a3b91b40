"""A job whose supervisor and engine are forked ends as one whose processes are started, bit for bit."""

import json
import os
import shutil
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.evidence.run import Run
from worldwright.stage import family, launch, sandbox, tools
from worldwright.stage.job import Job
from worldwright.stage.warm import kept_warm, letters
from worldwright.stamp import tools as stamp

from .warm_engines import nursery

TIMED = ("started", "wall_s", "job")


def ended(run: Run, stage: str, **options):
    job = tools.start(str(run.folder), stage=stage, **options)
    while not job.ended:
        job = tools.wait(str(run.folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text() + (run.jobs / job.job / "supervisor.log").read_text()
    return job


def result(run: Run, stage: str) -> dict:
    (folder,) = run.folder.glob(f"evidence/*/{stage}")
    said = json.loads((folder / "result.json").read_text())
    files = {name: sha256 for name, sha256 in said.pop("files").items() if name != "log.txt"}
    summary = {name: value for name, value in said.pop("summary").items() if not name.endswith("_s")}
    return {**{name: value for name, value in said.items() if name not in TIMED}, "files": files, "summary": summary}


class Seen:
    """What the processes of a run's jobs were started as, by whether they bear a job's token."""

    def __init__(self, run: Run) -> None:
        self.run, self.engines, self.over = run, set[bytes](), threading.Event()
        self.thread = threading.Thread(target=self._look, daemon=True)

    def __enter__(self) -> "Seen":
        self.thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.over.set()
        self.thread.join()

    def _look(self) -> None:
        while not self.over.is_set():
            for job in Job.all(self.run):
                for pid in family.bearing(job.spec.token):
                    self.engines.add(family._read(f"/proc/{pid}/cmdline"))
            time.sleep(0.002)


@pytest.fixture(scope="module")
def approved(planned: Path, tmp_path_factory) -> Path:
    folder = Path(shutil.copytree(planned, tmp_path_factory.mktemp("approved") / planned.name))
    stamp.approve(str(folder), by="tester")
    report = lint.check_program([folder / "simulation.py"])
    assert not [f for f in report.findings if f.severity == "error"], report.text()
    return folder


def passes(folder: Path) -> dict[str, dict]:
    run = Run(folder)
    return {stage: result(run, ended(run, stage).stage) for stage in ("physics", "stills")}


@pytest.mark.gl
@pytest.mark.slow
def test_what_it_proves_is_the_same_bit_for_bit(approved, tmp_path, monkeypatch):
    one, other = (Path(shutil.copytree(approved, tmp_path / name / approved.name)) for name in ("cold", "warm"))
    monkeypatch.setenv(kept_warm.SWITCH, "0")
    cold = passes(one)
    forked = []
    monkeypatch.setattr(
        kept_warm, "supervisor", lambda *given, begin=kept_warm.supervisor: forked.append(begin(*given)) or forked[-1]
    )
    with nursery(), Seen(Run(other)) as seen:
        assert passes(other) == cold
    assert forked == [True, True]
    if sandbox.level() == "bubblewrap":
        assert any(b"worldwright.stage.warm.nursery" in words for words in seen.engines)


@pytest.mark.parametrize("before", ["", "/opt/lib:/usr/local/lib"])
def test_what_opencv_adds_when_it_is_imported_keeps_nobody_from_a_warm_start(before):
    code = "import cv2, json; from worldwright.stage import launch; print(json.dumps(launch._environment()))"
    theirs = {**kept_warm.ITS_ENVIRONMENT} | ({launch.LIBRARIES: before} if before else {})
    done = subprocess.run([sys.executable, "-c", code], env=theirs, capture_output=True, text=True, check=True)
    environment = json.loads(done.stdout)
    assert environment.get(launch.LIBRARIES, "") == before
    assert kept_warm.starts_alike(environment) == (not before)


def test_a_nursery_that_dies_costs_nothing_but_its_warmth(approved, tmp_path):
    run = Run(shutil.copytree(approved, tmp_path / approved.name))
    with nursery() as now:
        now.process.kill()
        now.process.wait()
        ended(run, "physics")


def test_what_is_loaded_ahead_starts_no_thread_and_keeps_no_answer():
    """What is forked would go on without the thread, and with an answer to what another job asked."""
    code = """
import functools, gc, importlib, os
from worldwright.stage.warm import nursery
for name in nursery.LOADED:
    importlib.import_module(name)
ours = ("worldwright", "worldengine", "worldkit")
kept = [one for one in gc.get_objects() if isinstance(one, functools._lru_cache_wrapper) and one.cache_info().currsize]
print([one.__qualname__ for one in kept if one.__module__.startswith(ours)], len(os.listdir("/proc/self/task")))
"""
    call = [sys.executable, "-s", "-P", "-c", code]
    done = subprocess.run(call, env=kept_warm.ITS_ENVIRONMENT, capture_output=True, text=True, check=True)
    assert done.stdout == "[] 1\n"


@pytest.mark.parametrize(("name", "value", "alike"), [
    ("PYTHONHASHSEED", "0", True), ("PYTHONHASHSEED", "7", False), ("PYTHONOPTIMIZE", "1", False), ("LD_PRELOAD", "/x", False),
    ("PYTHONPATH", "/elsewhere", False), ("PYTHONUNBUFFERED", "1", True), ("HOME", "/x", True), ("NPY_DISABLE_CPU_FEATURES", "AVX2", False),
    ("OPENBLAS_CORETYPE", "Haswell", True), ("OPENBLAS_NUM_THREADS", "4", False),
])  # fmt: skip
def test_an_environment_that_an_interpreter_reads_at_its_start_must_be_the_nurserys(name, value, alike):
    assert kept_warm.starts_alike({name: value}) == alike


def test_a_request_arrives_whole_with_its_descriptors(tmp_path):
    ours, theirs = socket.socketpair()
    request = {"environment": {"NAME": "x" * 300_000, "ODD": "\udcff"}}
    with ours, theirs, (tmp_path / "file").open("wb") as file:
        sent = threading.Thread(target=letters.send, args=(ours, request, (file.fileno(), file.fileno())))
        sent.start()
        got, descriptors = letters.receive(theirs)
        sent.join()
        assert got == request and len(descriptors) == 2
        for number in descriptors:
            assert os.fstat(number).st_ino == os.fstat(file.fileno()).st_ino and not os.get_inheritable(number)
            os.close(number)
        ours.close()
        with pytest.raises(EOFError):
            letters.receive(theirs)
