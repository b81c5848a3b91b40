"""Programs that try to get out of the sandbox, or to fool whoever handles what they leave: none may succeed."""

import os
import time
from pathlib import Path

import pytest

from worldwright.stage.tools import log, start, wait

OUT = 'import json, os, pathlib, sys\nout = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])\n'
WELL = '\n(out / "result.json").write_text(json.dumps({"ok": True, "trajectory_sha256": "abc"}))\n'


@pytest.mark.parametrize("name", ["log.txt", "result.json", "progress.json", "MUJOCO_LOG.TXT"])
def test_a_link_left_where_we_write_is_not_followed(make, finish, upper_level, tmp_path, name):
    victim = tmp_path / "victim.txt"
    victim.write_text("mine")
    run = make(OUT + WELL + f"(out / {name!r}).unlink(missing_ok=True)\n(out / {name!r}).symlink_to({str(victim)!r})\n")
    finish(run)
    assert victim.read_text() == "mine"


@pytest.mark.parametrize("link", ["os.symlink({victim!r}, out / 'shot.png')", "os.mkfifo(out / 'shot.png')"])
def test_what_is_not_a_plain_file_never_becomes_evidence(make, finish, evidence, upper_level, tmp_path, link):
    victim = tmp_path / "victim.txt"
    victim.write_text("secret")
    run = make(OUT + link.format(victim=str(victim)) + WELL)
    job = finish(run)
    assert (job.state, job.code) == ("failed", "refused"), job.text()
    assert "shot.png" in job.message
    assert not (evidence(run) / "physics").exists()


def test_a_pipe_in_place_of_progress_does_not_stall_the_limits(make, finish, upper_level):
    run = make(OUT + "os.mkfifo(out / 'progress.json')\nwhile True: pass\n")
    began = time.monotonic()
    job = finish(run, wall_s=1.5)
    assert job.code == "timed_out"
    assert time.monotonic() - began < 15


def test_nothing_outlives_its_job(make, finish, level, tmp_path):
    beat = f"/tmp/worldwright-test-{os.getpid()}-{level}"
    daemon = f"""
import os, sys, time
for _ in range(2):
    if os.fork(): 
        time.sleep(0.3)
        os._exit(0)
    try:
        os.setsid()
    except OSError:
        pass
while True:
    time.sleep(0.05)
"""
    run = make(
        OUT
        + f"import subprocess, time\nsubprocess.Popen([sys.executable, '-c', {daemon!r}, {beat!r}])\ntime.sleep(0.8)"
        + WELL
    )
    assert finish(run).state == "succeeded"
    time.sleep(0.3)
    commands = [p.read_bytes() for p in Path("/proc").glob("[0-9]*/cmdline") if p.exists()]
    assert not any(beat.encode() in command for command in commands)


def test_the_supervisor_cannot_be_killed(make, finish, upper_level):
    run = make(
        OUT
        + """
import signal
for victim in (os.getppid(), 1, -1):
    for attempt in (lambda: os.kill(victim, signal.SIGKILL), lambda: signal.pidfd_send_signal(os.pidfd_open(victim), 9)):
        try:
            attempt()
            print("sent")
        except (OSError, OverflowError) as refusal:
            print(type(refusal).__name__)
"""
        + WELL
    )
    job = finish(run)
    assert job.state == "succeeded" or job.code == "killed", job.text()  # killing oneself is allowed, and said


@pytest.mark.parametrize(
    "attempt",
    [
        "open(os.path.expanduser({secret!r})).read()",
        "os.listdir({folder!r})",
        "open({folder!r} + '/new.txt', 'w')",
        "os.symlink('/etc/passwd', {folder!r} + '/link')",
        "os.mkdir({folder!r} + '/dir')",
        "os.rename({secret!r}, out / 'stolen')",
        "os.link({secret!r}, out / 'stolen')",
        "os.truncate({secret!r}, 0)",
        "os.unlink({secret!r})",
        "open(__file__, 'a').write('#')",
        "open(os.path.dirname(__file__) + '/plan.md', 'a').write('#')",
        "open('/proc/%d/environ' % os.getppid(), 'rb').read() or 1/0",
        "open('/proc/%d/mem' % os.getppid(), 'r+b')",
        "socket.socket(socket.AF_INET, socket.SOCK_STREAM).connect(('127.0.0.1', 9))",
        "socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b'x', ('127.0.0.1', 9))",
        "socket.socket(socket.AF_UNIX).bind('\\0worldwright-test')",
        "socket.socket(socket.AF_UNIX).connect('/run/dbus/system_bus_socket')",
        "libc('ptrace', 16, os.getppid(), 0, 0)",
        "libc('unshare', 0x10000000)",
        "libc('mount', 0, b'/', 0, 0, 0)",
        "libc('chroot', b'/tmp')",
        "raw({{'x86_64': 425, 'aarch64': 425}}, 8, ctypes.create_string_buffer(256))",
        "raw({{'x86_64': 321, 'aarch64': 280}}, 0, ctypes.create_string_buffer(128), 128)",
        "raw({{'x86_64': 250, 'aarch64': 219}}, 0, -3, 1)",
        "raw({{'x86_64': 0x40000029, 'aarch64': 198}}, 2, 1, 0)",
        "resource.prlimit(os.getppid(), resource.RLIMIT_CPU, (1, 1))",
        "os.setpriority(os.PRIO_PROCESS, os.getppid(), 19)",
        "resource.setrlimit(resource.RLIMIT_FSIZE, (-1, -1))",
    ],
)
def test_attempts_fail(make, finish, upper_level, tmp_path, attempt):
    folder = tmp_path / "home"
    folder.mkdir()
    secret = folder / "secret.txt"
    secret.write_text("the secret")
    run = make(
        OUT
        + f"""
import ctypes, platform, resource, socket
def checked(done):
    if done < 0:
        raise OSError(ctypes.get_errno(), "refused")
def libc(name, *arguments):
    checked(getattr(ctypes.CDLL(None, use_errno=True), name)(*arguments))
def raw(numbers, *arguments):
    checked(ctypes.CDLL(None, use_errno=True).syscall(numbers[platform.machine()], *arguments))
try:
    {attempt.format(folder=str(folder), secret=str(secret))}
except (OSError, ValueError) as refusal:
    print("refused", type(refusal).__name__, refusal)
else:
    print("got through")
"""
        + WELL
    )
    job = finish(run)
    said = log(str(run.folder), job.job).content
    assert said.startswith("refused"), said
    assert [p.name for p in folder.iterdir()] == ["secret.txt"]
    assert secret.read_text() == "the secret"
    assert run.plan.read_text() == "a plan"


def test_a_fork_bomb_is_stopped(make, finish, level):
    run = make("import os\nwhile True:\n    try:\n        os.fork()\n    except OSError:\n        pass\n")
    began = time.monotonic()
    job = finish(run, wall_s=20)
    assert job.code == "too_many_processes", job.text()
    assert time.monotonic() - began < 20


def test_the_disk_cannot_be_filled(make, finish, level):
    piece = "(out / str(i)).write_bytes(bytes(1 << 20))"
    job = finish(make(OUT + f"for i in range(5000): {piece}" + WELL))
    assert job.code == "too_much_disk", job.text()
    assert wait
    assert start
