"""Every way out that we can think of is barred on both confining levels, tried for real in a real job."""

import hashlib
import json
import os
import secrets
import socket
import subprocess
import sys
import sysconfig
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace

import pytest

import worldkit
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stage import sandbox
from worldwright.stage.sandbox.probe import started
from worldwright.stage.tools import start, wait

from . import escapes

WORLD = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(size=(0.1, 0, 0))
    return spec

program.main(build, duration=0.02)
"""
"""Whatever became of the attempts, a world is built, so that the pass has something to succeed with."""


def world(folder: Path, name: str) -> dict:
    """Things worth stealing or spoiling, outside of the job."""
    outside, home = folder / "outside", folder / "home"
    for path in (outside / "empty", home / ".ssh"):
        path.mkdir(parents=True)
    (outside / "victim").write_text("precious")
    (home / ".ssh" / "id_ed25519").write_text("secret")
    disks = [path for path in map(Path, ("/dev/vda", "/dev/sda", "/dev/nvme0n1", "/dev/xvda")) if path.exists()]
    return {
        "name": name,
        "outside": str(outside),
        "victim": str(outside / "victim"),
        "home": str(home),
        "real_home": str(Path.home()),
        "real_names": sorted(path.name for path in Path.home().iterdir()),
        "secret": str(home / ".ssh" / "id_ed25519"),
        "worldkit": str(Path(next(iter(worldkit.__path__))) / "__init__.py"),
        "packages": sysconfig.get_path("purelib"),
        "disk": str(disks[0] if disks else "/dev/sda"),
        "pid": os.getpid(),
        "start": started(os.getpid()),
        "unix": str(folder / "unix"),
    }


def digest(folder: Path) -> str:
    """Names, modes and contents of everything below a folder."""
    lines = []
    for path in sorted(folder.rglob("*")):
        content = path.read_bytes() if path.is_file() else b""
        lines.append(f"{path} {path.lstat().st_mode} {path.lstat().st_mtime_ns} {hashlib.sha256(content).hexdigest()}")
    return "\n".join(lines)


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    """Run every attempt once at a level, in a world where somebody really listens."""
    done: dict[str, dict[str, str]] = {}

    def outcomes(level: str) -> dict[str, str]:
        if level not in done:
            done[level] = {}
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("WORLDWRIGHT_SANDBOX", level)
                patch.setenv("WORLDWRIGHT_TEST_SECRET", "secret")
                sandbox.level.cache_clear()
                try:
                    done[level] = _escape(tmp_path_factory.mktemp(level))
                finally:
                    sandbox.level.cache_clear()
        return done[level]

    return outcomes


def _escape(folder: Path) -> dict[str, str]:
    name = f"worldwright-escape-{secrets.token_hex(6)}"
    facts = world(folder, name)
    run = Run(folder / "world")
    run.folder.mkdir()
    run.plan.write_text("a plan")
    shared = Path("/dev/shm", name)
    if shared.parent.is_dir():
        shared.write_bytes(b"shared")
    with ExitStack() as stack:
        kinds = (socket.AF_INET, socket.SOCK_STREAM), (socket.AF_INET, socket.SOCK_DGRAM)
        kinds += (socket.AF_UNIX, socket.SOCK_STREAM), (socket.AF_UNIX, socket.SOCK_STREAM)
        tcp, udp, unix, abstract = (stack.enter_context(socket.socket(*kind)) for kind in kinds)
        tcp.bind(("127.0.0.1", 0))
        udp.bind(("127.0.0.1", 0))
        unix.bind(facts["unix"])
        abstract.bind("\0" + name)
        for listener in (tcp, unix, abstract):
            listener.listen()
        facts |= {"tcp": tcp.getsockname()[1], "udp": udp.getsockname()[1]}
        facts |= {"plan": str(run.plan), "program": str(run.program), "journal": str(run.journal)}
        facts["evidence"] = str(run.folder / "evidence" / "earlier" / "physics" / "result.json")
        Path(facts["evidence"]).parent.mkdir(parents=True)
        Path(facts["evidence"]).write_text("{}")
        source = Path(escapes.__file__).read_text() + f"\n\nmain({facts!r})\n" + WORLD
        run.program.write_text(source)
        run.log("test", "approve", plan_sha256=sha256_file(run.plan))
        run.keep(run.evidence_key(environment.current().sha256()), "lint", LintReport(rules=1))
        before = (
            digest(folder / "outside"),
            digest(folder / "home"),
            run.plan.read_bytes(),
            sha256_file(run.program),
        )
        job = start(str(run.folder))
        while not job.ended:
            job = wait(str(run.folder), job=job.job, timeout_s=20)
    shared.unlink(missing_ok=True)
    assert job.state == "succeeded", job.text() + (run.jobs / job.job / "log.txt").read_text()
    assert before == (
        digest(folder / "outside"),
        digest(folder / "home"),
        run.plan.read_bytes(),
        sha256_file(run.program),
    )
    assert [entry["action"] for entry in run.entries()] == ["approve", "stage"]
    assert not any((Path(place) / name).exists() for place in ("/tmp", "/var/tmp", "/etc", "/usr", "/dev/shm"))
    assert not (Path(facts["packages"]) / "worldwright-escape-test.pth").exists()
    out = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    said = [line for line in (out / "log.txt").read_text().splitlines() if line.startswith(escapes.MARK)]
    return json.loads(said[-1].removeprefix(escapes.MARK))


@pytest.mark.parametrize("level", sandbox.CONFINING)
@pytest.mark.parametrize("name", escapes.ATTEMPTS)
def test_there_is_no_way_out(level, name, outcomes):
    if reason := sandbox.unusable(level):
        pytest.skip(f"{level} does not work here: {reason}")
    outcome = outcomes(level).get(name, "the attempts could not be made")
    if outcome.startswith("not feasible"):
        pytest.skip(outcome)
    assert outcome.startswith("barred"), outcome


def test_what_one_installation_has_tried_another_does_not_make_it_try_again(tmp_path, monkeypatch):
    tried = []
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path / "data"))
    monkeypatch.setitem(sandbox.LADDER, "landlock", SimpleNamespace(unavailable=lambda: ""))
    monkeypatch.setattr(sandbox.probe, "ways_out", lambda level: tried.append(level) or ([], 14, ""))
    for installation in ("one", "another", "one", "another"):
        monkeypatch.setattr(sandbox, "_state", lambda installation=installation: installation)
        assert not sandbox.unusable("landlock")
    assert len(tried) == 2


def test_no_file_says_that_a_level_does_not_work(tmp_path, monkeypatch):
    """What a shell of an agent leaves in the user's folders, or what fails in that shell alone, takes no protection away."""
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path))
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    monkeypatch.setitem(sandbox.LADDER, "landlock", SimpleNamespace(unavailable=lambda: ""))
    for outcome in ((["UDP"], 14, ""), ([], 0, "the kernel forbids it here"), ([], 14, "")):
        monkeypatch.setattr(sandbox.probe, "ways_out", lambda level, outcome=outcome: outcome)
        assert bool(sandbox.unusable("landlock")) == (outcome != ([], 14, ""))
        lie = {"tried": [{"state": sandbox._state(), "reason": "the kernel forbids it here", "attempts": 1}]}
        for name in sandbox.CONFINING:
            (tmp_path / f"sandbox-{name}-{os.geteuid()}.json").write_text(json.dumps(lie))
    assert not sandbox.unusable("landlock")


def test_a_shell_that_gave_rights_up_is_another_state():
    """bubblewrap works outside of it and not inside: neither may hear from the other that it does."""
    asked = (
        "import sys; sys.path.insert(0, sys.argv[1]); from worldwright.stage import sandbox; print(sandbox._state())"
    )
    call = [sys.executable, "-P", "-c", asked, str(Path(sandbox.__file__).parents[3])]
    inside = ["setpriv", "--no-new-privs", *call]
    said = [subprocess.run(words, capture_output=True, text=True, check=True).stdout for words in (call, inside)]
    assert said[0] != said[1] and all(said)


def test_a_broken_wall_is_noticed(tmp_path):
    """The attempts themselves can succeed: outside of any sandbox, the harmless ones do."""
    escapes.W.update(world(tmp_path, "x"), out=str(tmp_path))
    there = Path.cwd()
    os.chdir(tmp_path)
    try:
        for name in (
            "write_absolute",
            "read_a_secret",
            "listen",
            "signal_the_server",
            "change_a_time",
            "truncate_outside",
        ):
            escapes.ATTEMPTS[name]()
    finally:
        os.chdir(there)
