"""kill -9 of the server, of the job, and of everything at once, at random moments: what was proven stays proven.

A real world, a real server process, real kills. `make test-faults` does a hundred; `make test` a few, with another
kind of victim each.
"""

import json
import os
import random
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from worldwright.model.evidence import environment
from worldwright.model.evidence.run import SOURCE, Run, sha256_file
from worldwright.stage import family
from worldwright.stage.job import Job
from worldwright.stage.tools import start, wait

from .lock_holders import supervisors

KILLS = int(os.environ.get("WORLDWRIGHT_KILLS", "4"))
VICTIMS = ("server", "supervisor", "program", "everything")
SERVER = """
import sys
from worldwright.stage.tools import start, wait
for stage in ("physics", "stills"):
    job = start(sys.argv[1], stage=stage)
    print(stage, flush=True)
    while not job.ended:
        job = wait(sys.argv[1], job=job.job, timeout_s=20)
print("done", flush=True)
"""


@pytest.fixture(scope="module")
def approved(planned, tmp_path_factory) -> Path:
    """A drafted world that may run."""
    from worldwright.lint import tools as lint
    from worldwright.stamp import tools as stamp

    folder = tmp_path_factory.mktemp("approved") / planned.name
    shutil.copytree(planned, folder)
    stamp.approve(str(folder), by="tester")
    lint.check_program([folder / "simulation.py"])
    return folder


def proven(run: Run) -> dict[str, str]:
    """Digest of every pass that stands; each one must be whole."""
    found = {}
    for folder in run.folder.glob("evidence/*/*"):
        if folder.is_dir() and folder.name != SOURCE:
            result = json.loads((folder / "result.json").read_text())
            assert result["ok"]
            for name, sha256 in result["files"].items():
                assert sha256_file(folder / name) == sha256, f"{folder / name} is not what its result says"
            found[str(folder)] = sha256_file(folder / "result.json")
    return found


def kill(victim: str, server: "subprocess.Popen[str]", run: Run) -> None:
    targets = {
        "server": [server.pid],
        "supervisor": supervisors(run),
        "program": [p for job in Job.all(run) for p in family.bearing(job.spec.token)],
    }
    chosen = list(targets) if victim == "everything" else [victim]
    for process in (pid for name in chosen for pid in targets[name]):
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            continue


@pytest.mark.parametrize("number", range(KILLS))
def test_what_was_proven_survives_a_kill_at_any_moment(approved, tmp_path, number):
    chance = random.Random(number)
    victim = VICTIMS[number % len(VICTIMS)]
    run = Run(shutil.copytree(approved, tmp_path / approved.name))
    call = [sys.executable, "-c", SERVER, str(run.folder)]
    server = subprocess.Popen(call, stdout=subprocess.PIPE, text=True, start_new_session=True)
    time.sleep(chance.uniform(0.0, 3.5))
    before = proven(run)
    kill(victim, server, run)
    after = proven(run)
    assert before.items() <= after.items(), "the kill took evidence away"
    server.kill()
    server.wait()

    for stage in ("physics", "stills"):  # the restarted server goes on where things stand
        for _ in range(3):
            job = start(str(run.folder), stage=stage)
            while not job.ended:
                job = wait(str(run.folder), job=job.job, timeout_s=20)
            if job.state == "succeeded":
                break
            assert job.code == "killed", job.text()  # joined just before its kill was noticed
        assert job.state == "succeeded", job.text()
    end = proven(run)
    assert after.items() <= end.items()
    assert len(end) == 2
    lines = run.journal.read_text().splitlines()
    assert all(json.loads(line) for line in lines)
    for job in Job.all(run):
        assert job.read().ended
        assert not family.bearing(job.spec.token)
    key = run.evidence_key(environment.current().sha256())
    assert not [path for path in run.evidence(key).iterdir() if path.name.startswith(".")]


def confined(script: str, folder: Path, options: str) -> "subprocess.CompletedProcess[str]":
    """Run Python in a mount namespace of its own, where the folder is a small or read-only file system."""
    mount = f"mount {options} && exec {shlex.join([sys.executable, '-c', script, str(folder)])}"
    words = ["unshare", "--mount", "sh", "-c", mount]
    if os.geteuid():
        words[1:1] = ["--user", "--map-root-user"]
    if not shutil.which("unshare") or subprocess.run([*words[:-1], "true"], capture_output=True).returncode:
        pytest.skip("no mount namespace can be made here")
    return subprocess.run(words, capture_output=True, text=True, timeout=90)


SMALL = """
import json, pathlib, sys, time
sys.path.insert(0, sys.argv[1])
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import SOURCE, Run, sha256_file
from worldwright.stage.tools import start, wait
run = Run(pathlib.Path(sys.argv[1], "world"))
run.folder.mkdir()
run.plan.write_text("a plan")
def go(source):
    run.program.write_text(source)
    run.log("test", "approve", plan_sha256=sha256_file(run.plan))
    run.keep(run.evidence_key(environment.current().sha256()), "lint", LintReport(rules=1))
    job = start(str(run.folder))
    while not job.ended:
        job = wait(str(run.folder), job=job.job, timeout_s=20)
    return job.state, job.code
small = "import pathlib, sys, time; out = pathlib.Path(sys.argv[sys.argv.index(\\"--out\\") + 1]); "
good = "import mujoco; from worldkit import program\\ndef build():\\n    spec = mujoco.MjSpec()\\n"
good += "    spec.worldbody.add_geom(size=(0.1, 0, 0))\\n    return spec\\nprogram.main(build, duration=0.02)\\n"
said = [go(good)]
said.append(go(small + "[((out / str(n)).write_bytes(bytes(4 << 20)), time.sleep(0.1)) for n in range(40)]"))
said.append(go(good + "  # once more"))
print(json.dumps(said))
"""


def test_a_full_disk_is_named_and_the_next_run_succeeds(tmp_path):
    done = confined(SMALL, tmp_path, f"-t tmpfs -o size=100m tmpfs {shlex.quote(str(tmp_path))}")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == [["succeeded", "ok"], ["failed", "disk_full"], ["succeeded", "ok"]]


def test_a_disk_that_was_full_before_and_a_folder_that_cannot_be_written_are_refused(make):
    run = make("print()")
    script = (
        "import sys; from worldwright.model.errors import JobError; from worldwright.stage.tools import start, status\n"
        "print(status(sys.argv[1]).key)\n"
        "try: start(sys.argv[1])\n"
        "except JobError as refusal: print(refusal.code, bool(refusal.next_move))"
    )
    folder, place = run.folder, shlex.quote(str(run.folder))
    done = confined(script, folder, f"--bind {place} {place} && mount -o remount,bind,ro {place}")
    assert done.stdout.split()[1:] == ["not_writable", "True"], done.stderr
    copy = shlex.quote(str(folder.with_name("copy")))
    fill = f"mkdir -p {copy} && mount -t tmpfs -o size=64k tmpfs {copy} && cp -r {place}/. {copy} "
    fill += f"&& (head -c 1m /dev/zero > {copy}/fill || true) 2>/dev/null && mount --bind {copy} {place}"
    done = confined(script, folder, f"-t tmpfs none /mnt && {fill}")
    assert done.stdout.split()[1:] == ["disk_full", "True"], done.stderr


def test_a_clock_that_jumps_changes_neither_the_order_of_jobs_nor_their_deadlines(make, finish):
    run = make("import time; time.sleep(30)")
    first = finish(run, still_s=0.5)
    for path in (run.jobs / first.job).iterdir():
        os.utime(path, (2**32, 2**32))  # the clock was far ahead when it ran, and was set back since
    job = start(str(run.folder), still_s=30)
    assert Job.find(run, None).folder.name == job.job
    spec = run.jobs / job.job / "spec.json"
    spec.write_text(json.dumps({**json.loads(spec.read_text()), "created": 0.0}))
    for _ in range(100):
        if (state := Job.find(run, None).read().state) != "queued":
            break
        time.sleep(0.1)
    time.sleep(0.5)  # a deadline counted from 1970 would be over by now
    assert (state, Job.find(run, None).read().state) == ("running", "running")
    (run.jobs / job.job / "cancel").touch()
    assert wait(str(run.folder), timeout_s=10).state == "cancelled"
