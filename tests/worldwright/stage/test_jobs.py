"""Jobs with small real programs at every level of the sandbox that works here."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from worldwright.model.errors import GateError, JobError, NotFoundError
from worldwright.stage import family, sandbox
from worldwright.stage.job import Job
from worldwright.stage.tools import cancel, log, start, status, wait

from .lock_holders import supervisors

GOOD = """
import mujoco
from worldkit import program

HEIGHT = 1.0

def build():
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball", pos=(0, 0, HEIGHT))
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0, 0))
    return spec

print("said something")
program.main(build, duration=0.02)
"""
WORLD = {"world.mjz", "program.json", "inputs.json"}
"""What the engine was given, which stands in the evidence beside what it recorded."""


def test_a_pass_that_succeeds_becomes_evidence_and_is_never_paid_twice(make, level, finish, evidence):
    run = make(GOOD)
    job = finish(run)
    assert (job.state, job.sandbox, job.cached) == ("succeeded", level, False), job.text()
    result = json.loads((evidence(run) / "physics/result.json").read_text())
    assert result["ok"]
    assert result["sandbox"] == level
    assert result["summary"]["world_sha256"] == result["files"]["world.mjz"]
    assert {"environment.json", "trajectory/complete.json", *WORLD} <= set(result["files"])
    assert log(str(run.folder)).content.startswith("said something\n")
    again = start(str(run.folder))
    assert again.cached
    assert again.job == job.job
    assert len(list(run.jobs.iterdir())) == 1
    run.program.write_text(GOOD + "\n# changed\n")
    with pytest.raises(GateError, match="not linted"):
        start(str(run.folder))


def test_a_job_tells_the_processor_time_of_its_confined_processes(make, level, finish):
    """Also at the level that leaves the program's process to whoever adopts it."""
    burning = "import time\nwhile time.process_time() < 1.0:\n    pass\n"
    job = finish(make(burning + GOOD), stage="bundle")
    assert job.state == "succeeded" and job.cpu_s >= 1.0, job


PREAMBLE = """
import json, pathlib, sys
OUT = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
def told(kind, error, trace):
    sys.__excepthook__(kind, error, trace)
    facts = {"type": kind.__name__, "message": str(error), "file": "simulation.py", "line": 1, "code": "crashed"}
    (OUT / "error.json").write_text(json.dumps(facts))
sys.excepthook = told
"""
# Bounded on purpose: at most 400 children, each gone after a few seconds by itself.
BORN = """
import os, threading, time
def threaded():
    threading.Thread(target=time.sleep, args=(4,), daemon=True).start()
    return 1
for _ in range(400):
    try:
        if os.fork() == 0:
            time.sleep(4)
            os._exit(0)
    except (OSError, RuntimeError):
        pass
time.sleep(4)
"""
DAEMONS = """
import os, time
for _ in range(200):
    try:
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                time.sleep(4)
            os._exit(0)
    except OSError:
        pass
time.sleep(4)
"""


@pytest.mark.parametrize(
    ("source", "code", "options"),
    [
        ("raise ValueError('no')", "crashed", {}),
        ("while True: pass", "timed_out", {"still_s": 1.0}),
        (
            "import time; x = bytearray(600 << 20); x[::4096] = b'1' * len(x[::4096]); time.sleep(9)",
            "out_of_memory",
            {"memory_mb": 256},
        ),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "killed", {}),
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "crashed", {}),
        ("import sys\nwhile True: sys.stdout.write('x' * 65536)", "too_much_output", {}),
        ("print('nothing')", "no_result", {}),
        (BORN, "too_many_processes", {}),
        (BORN.replace("os.fork", "threaded").replace("range(400)", "range(4000)"), "too_many_processes", {}),
        (DAEMONS, "too_many_processes", {}),
        ("while True: pass", "out_of_cpu_time", {"cpu_s": 1.0}),
        ("open(OUT / 'big', 'wb').write(bytes(3 << 20))", "file_too_large", {"file_mb": 1}),
        (
            "for n in range(40): (OUT / str(n)).write_bytes(bytes(1 << 20))\nimport time; time.sleep(9)",
            "disk_full",
            {"disk_mb": 8},
        ),
    ],
)
def test_every_way_to_fail_has_a_name_and_leaves_no_evidence(level, make, source, code, options, finish, evidence):
    run = make(PREAMBLE + source)
    job = finish(run, **options)
    assert job.state == "failed", job.text()
    assert job.code == code, job.text()
    assert job.message
    assert job.next_move
    assert not (evidence(run) / "physics").exists()
    assert list(run.entries())[-1]["code"] == code


def test_the_programs_own_error_is_named_with_its_line(make, finish):
    run = make(
        """
        import json, pathlib, sys
        out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
        error = {"type": "KeyError", "message": "'cue'", "file": "/world/simulation.py", "line": 7, "code": "crashed"}
        (out / "error.json").write_text(json.dumps(error))
        sys.exit(1)
        """
    )
    job = finish(run)
    assert (job.code, job.place, job.message) == ("crashed", "simulation.py:7", "KeyError: 'cue'")


def test_the_log_is_capped(make, finish):
    run = make("print('y' * 3_000_000)")
    job = finish(run)
    assert job.code == "no_result"
    page = log(str(run.folder))
    assert 1_000_000 <= page.size < 1_001_000
    assert page.next_offset == len(page.content)


def test_writing_outside_and_connecting_are_refused(make, level, tmp_path, finish):
    target = tmp_path / "outside.txt"
    run = make(
        f"""
        import pathlib, socket
        for attempt in (lambda: pathlib.Path({str(target)!r}).write_text("x"),
                        lambda: pathlib.Path({str(tmp_path / "world" / "plan.md")!r}).write_text("x"),
                        lambda: socket.create_connection(("127.0.0.1", 9), timeout=1)):
            try:
                attempt()
                print("succeeded")
            except OSError as refusal:
                print(type(refusal).__name__)
        """
    )
    finish(run)
    words = log(str(run.folder)).content.split()
    if level == "rlimits":
        assert run.plan.read_text() == "x"  # the weakest level only limits resources, and says so in the evidence
        return
    assert "succeeded" not in words
    assert not target.exists()
    assert run.plan.read_text() == "a plan"


def test_cancel_ends_the_whole_family(make):
    child = "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60.25)'])"
    run = make(f"import subprocess, sys, time\n{child}\ntime.sleep(60)")
    job = start(str(run.folder))
    time.sleep(1.0)
    assert cancel(str(run.folder), job.job).state == "cancelled"
    commands = [p.read_bytes() for p in Path("/proc").glob("[0-9]*/cmdline") if p.exists()]
    assert not any(b"time.sleep(60.25)" in command for command in commands)


def test_cancel_without_a_job_takes_what_runs_and_not_the_latest(make, finish):
    run = make("import time; time.sleep(60)")
    running = start(str(run.folder))
    behind = start(str(run.folder), stage="stills")
    (run.jobs / behind.job / "cancel").write_text("")
    assert wait(str(run.folder), job=behind.job, timeout_s=20).state == "cancelled"
    told = cancel(str(run.folder))
    assert (told.job, told.state) == (running.job, "cancelled")
    more = [start(str(run.folder)), start(str(run.folder), stage="stills")]
    assert f"ended with it: {more[1].job}" in cancel(str(run.folder)).account
    assert {wait(str(run.folder), job=job.job, timeout_s=5).state for job in more} == {"cancelled"}
    assert cancel(str(run.folder)).job == more[1].job, "nothing runs: the latest pass, as it ended"


def test_a_new_pass_ends_one_that_is_at_work_for_other_files(make):
    """What started it may have been killed: the job is detached and goes on beside the new one."""
    run = make("import time; time.sleep(60)")
    old = start(str(run.folder))
    make("import time; time.sleep(61)")
    new = start(str(run.folder))
    assert new.account == (f"ended {old.job}, which was at work for another program or plan than there is now",)
    ended = wait(str(run.folder), job=old.job, timeout_s=40)
    assert ended.state == "cancelled" and "the physics pass was started anew" in ended.message
    assert start(str(run.folder)).job == new.job, "the same is not begun twice"
    cancel(str(run.folder))


def test_an_edit_that_is_taken_back_ends_what_is_at_work_for_it(make, finish):
    """The answer stands already, and nobody wants the other."""
    done = finish(make(GOOD))
    run = make("import time; time.sleep(60)")
    between = start(str(run.folder))
    make(GOOD)
    again = start(str(run.folder))
    assert again.cached and again.job == done.job
    said = f"ended {between.job}, which was at work for another program or plan than there is now"
    assert again.account[0] == said and len(again.account) > 1
    assert wait(str(run.folder), job=between.job, timeout_s=40).state == "cancelled"


def _kill(run, job):
    """Kill a job's supervisor, with what it has just forked, which still holds its lock, too."""
    held = supervisors(run, job)
    assert held
    for one in held:
        with suppress(ProcessLookupError):
            os.kill(one, signal.SIGKILL)


def test_a_killed_supervisor_leaves_a_lost_job_and_no_evidence(make, evidence):
    run = make("import time; time.sleep(60)")
    job = start(str(run.folder))
    deadline = time.monotonic() + 60
    while status(str(run.folder)).jobs[0].state != "running" and time.monotonic() < deadline:
        time.sleep(0.05)
    _kill(run, job.job)
    lost = wait(str(run.folder), job=job.job, timeout_s=40)
    assert (lost.state, lost.code) == ("lost", "killed")
    assert not (evidence(run) / "physics").exists()
    assert start(str(run.folder)).job != job.job
    cancel(str(run.folder))


def test_what_a_killed_supervisor_leaves_behind_is_ended_by_the_next_start(level, make, finish):
    child = "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(20.75)'], start_new_session=True)"
    run = make(f"import subprocess, sys, time\n{child}\ntime.sleep(20)")
    job = start(str(run.folder))
    spec = Job.find(run, job.job).spec
    deadline = time.monotonic() + 60
    while len(family.bearing(spec.token)) < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    assert len(family.bearing(spec.token)) >= 2
    _kill(run, job.job)
    assert wait(str(run.folder), job=job.job, timeout_s=40).state == "lost"
    again = start(str(run.folder))
    assert not family.bearing(spec.token)
    assert not Job.find(run, job.job).scratch.exists()
    cancel(str(run.folder), again.job)


def test_a_supervisor_killed_after_its_proof_stood_has_succeeded(make, finish, evidence):
    run = make(GOOD)
    done = finish(run)
    path = run.jobs / done.job / "state.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "state": "running"}))
    again = wait(str(run.folder), job=done.job, timeout_s=5)
    assert (again.state, again.result) == ("succeeded", str(evidence(run) / "physics"))


def test_a_job_survives_its_server(make):
    run = make("import time; time.sleep(1.5)\n" + GOOD)
    code = f"from worldwright.stage.tools import start; print(start({str(run.folder)!r}).job)"
    job = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()
    assert wait(str(run.folder), job=job, timeout_s=20).state == "succeeded"


def test_a_forced_rerun_that_differs_is_said_and_the_first_evidence_stays(make, finish, evidence):
    run = make(GOOD.replace("= 1.0", "= __import__('time').time() % 1"))
    assert finish(run).state == "succeeded"
    before = (evidence(run) / "physics/result.json").read_bytes()
    job = finish(run, force=True)
    assert (job.state, job.code) == ("failed", "not_repeatable")
    assert (evidence(run) / "physics/result.json").read_bytes() == before


def test_gates_name_the_next_command(make):
    run = make(GOOD)
    with pytest.raises(GateError) as refusal:
        start(str(run.folder), stage="video")
    assert "--stage stills" in refusal.value.next_move
    run.plan.write_text("another plan")
    with pytest.raises(GateError, match="not approved"):
        start(str(run.folder))


def test_unknown_runs_jobs_and_levels_list_the_known(make, monkeypatch):
    run = make(GOOD)
    with pytest.raises(NotFoundError, match="no run"):
        status("no-such-run")
    with pytest.raises(NotFoundError, match="no job"):
        wait(str(run.folder), job="physics-none")
    monkeypatch.setenv("WORLDWRIGHT_SANDBOX", "moat")
    sandbox.level.cache_clear()
    with pytest.raises(JobError, match="moat"):
        sandbox.level()
    monkeypatch.undo()
    sandbox.level.cache_clear()


def test_a_supervisor_starts_without_what_reads_plans_and_assets():
    """Every pass pays for its start, and most of them never ask what the plan or an asset says, only where assets lie."""
    unused = ("worldwright.model.plan", "worldkit.assets", "yaml", "numpy")
    code = "import sys, worldwright.stage.supervisor\nfrom worldwright.stage.sandbox import confinement\n"
    code += "confinement.runtime_paths(), confinement.environment('/tmp')\n"
    code += f"print([m for m in sys.modules if m.startswith({unused})])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"
