"""Many threads may ask one nursery, and whatever goes wrong with it costs its warmth alone."""

import fcntl
import os
import shutil
import socket
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from worldwright.stage import sandbox
from worldwright.stage.warm import joining, kept_warm, letters
from worldwright.stage.warm import nursery as its_process

from .warm_engines import confinement, nursery


@pytest.fixture
def none_yet(monkeypatch):
    """As in a process that keeps a nursery and has asked nothing yet."""
    monkeypatch.setattr(kept_warm, "_kept", kept_warm.Kept(wanted=True))
    monkeypatch.setenv(kept_warm.SWITCH, "1")
    yield
    if (left := kept_warm.use(None)) is not None:
        left.close()
        left.process.wait()


def test_threads_that_ask_at_first_start_one(none_yet, monkeypatch):
    began, at_once, start = [], threading.Barrier(8), kept_warm.Nursery.start

    def counted(since_s=None):
        began.append(start(since_s))
        return began[-1]

    def ask(_):
        at_once.wait()
        return kept_warm.ask(letters.ENGINE)

    monkeypatch.setattr(kept_warm.Nursery, "start", counted)
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(ask, range(8))) == [None] * 8
    for one in began[:-1]:
        one.close()
        one.process.wait()
    assert len(began) == 1


def test_one_that_cannot_be_started_is_done_without(none_yet, monkeypatch):
    def full(*_, **__):
        raise BlockingIOError("no room for one more process")

    with monkeypatch.context() as now:
        now.setattr(subprocess, "Popen", full)
        assert kept_warm.ask(letters.ENGINE) is None
    assert kept_warm._kept.nursery is None


def test_one_that_another_thread_closes_meanwhile_is_given_up_once():
    with nursery() as now:
        before = kept_warm._kept.given_up
        now.close()
        assert kept_warm.ask(letters.ENGINE) is None
        kept_warm.give_up(now)
        assert kept_warm._kept.nursery is None and kept_warm._kept.given_up == before + 1


def test_who_gives_up_an_old_one_leaves_the_new():
    with nursery() as old, nursery() as new:
        kept_warm.give_up(old)
        assert kept_warm.use(new) is new and kept_warm.ask(letters.ENGINE) is not None


def test_it_is_asked_at_a_high_number_too():
    ours, theirs = socket.socketpair()
    high = socket.socket(fileno=fcntl.fcntl(ours.fileno(), fcntl.F_DUPFD_CLOEXEC, 1030))
    theirs.send(letters.READY)
    with ours, theirs, high:
        asked = kept_warm.Nursery(high, ready=False).ask(letters.ENGINE)
        assert asked is not None
        asked.close()


def test_where_its_own_folder_is_gone_a_job_is_started_cold(tmp_path, monkeypatch):
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    with nursery(), (tmp_path / "file").open("wb") as file:
        here.rmdir()
        assert not kept_warm.supervisor(tmp_path, file.fileno(), file.fileno(), {})


def test_what_fails_leaves_no_descriptor_open(tmp_path, monkeypatch):
    given = confinement(tmp_path)
    with nursery():
        before = len(os.listdir("/proc/self/fd"))  # noqa: PTH208
        monkeypatch.setattr(joining.bubblewrap, "command", lambda *_: [str(tmp_path / "is not here")])
        assert joining.join([], given, 100, (), subprocess.PIPE) is None
        assert len(os.listdir("/proc/self/fd")) == before - 1  # noqa: PTH208 - the nursery's own, which is given up


@pytest.mark.skipif(bool(sandbox.unusable("bubblewrap")), reason="bubblewrap does not confine here")
@pytest.mark.parametrize(("says", "made"), [("echo", True), ("(echo)", False)])
def test_the_shell_that_waits_can_start_nothing(tmp_path, monkeypatch, says, made):
    """Nobody asks about its births, and an engine may write into its memory where the kernel lets equals do so."""
    monkeypatch.setattr(joining, "HOLD", ["/bin/sh", "-c", f"{says} || exit; read s"])
    sandboxed = joining.Made(confinement(tmp_path), subprocess.PIPE)
    try:
        if made:
            sandboxed.inside()
        else:
            with pytest.raises(OSError, match="no sandbox"):
                sandboxed.inside()
    finally:
        sandboxed.end()


def test_what_runs_is_not_writable(tmp_path):
    program = tmp_path / "program"
    shutil.copy(shutil.which("sleep"), program)
    running = subprocess.Popen([str(program), "60"])
    assert not its_process.writable(str(program))
    running.kill()
    running.wait()
    assert its_process.writable(str(program))


def test_a_loaded_file_is_changed_by_another_content_not_by_another_link(tmp_path):
    module = tmp_path / "loaded_here.py"
    module.write_text("A = 1\n")
    assert its_process.Loaded(time.time() - 60, {str(module)}).late
    time.sleep(2 * its_process.SLACK_S)
    loaded = its_process.Loaded(time.time(), {str(module)})
    os.link(module, tmp_path / "in_another_environment.py")
    assert not loaded.late and not loaded.changed()
    module.write_text("A = 2\n")
    assert loaded.changed()
