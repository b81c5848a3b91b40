"""A full disk, a folder that cannot be written, a clock that jumps, kill -9 at any moment: refused by name, or survived.

`make test` kills a few times, `make test-faults` a hundred.
"""

import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from worldwright.model.evidence import run as runs
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import SOURCE, Run, sha256_file
from worldwright.model.storage import StorageError
from worldwright.stamp import acceptance, bundle, gates
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State

Copy = Callable[[Path], Path]
KILLS = int(os.environ.get("WORLDWRIGHT_KILLS", "2"))
PIPELINE = """
import sys
from pathlib import Path
from worldwright.lint import tools as lint
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement, tools as stamp
run = sys.argv[1]
lint.check_program([Path(run, "simulation.py")])
for name in ("physics", "stills"):
    job = stage.start(run, stage=name)
    while not job.ended:
        job = stage.wait(run, job=job.job, timeout_s=20)
scan.scan(run)
scan.expect(run)
stamp.describe(run, by_measurement.describe(Run(run)))
stamp.review(run, by_measurement.review(Run(run)))
while not stamp.accept(run, timeout_s=40).ok:
    pass
print("done")
"""


@pytest.fixture(scope="module")
def approved(planned: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A world without films that may run."""
    folder = tmp_path_factory.mktemp("faults") / planned.name
    shutil.copytree(planned, folder)
    plan = folder / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none"), encoding="utf-8")
    stamp.approve(str(folder), by="tester")
    return folder


def whole(run: Run) -> dict[str, str]:
    """Everything that stands, each piece whole: reports that parse, passes whose files are as their results say."""
    found: dict[str, str] = {}
    for path in run.folder.glob("evidence/*/*"):
        if path.suffix == ".json":
            assert json.loads(path.read_text()), path
            found[str(path)] = sha256_file(path)
        elif path.is_dir() and path.name != SOURCE:
            result = json.loads((path / "result.json").read_text())
            assert result["ok"]
            for name, sha256 in result["files"].items():
                assert sha256_file(path / name) == sha256, path / name
            found[str(path)] = sha256_file(path / "result.json")
    assert Journal(run.journal).breaks() == []
    if run.accepted.exists():
        assert all(c.ok for c in stamp_checks(run))
        found["accepted"] = sha256_file(run.accepted / "stamp.json")
    return found


def stamp_checks(run: Run) -> list:
    from worldwright.stamp.verification import static

    return static(run, run.accepted)


@pytest.mark.parametrize("number", range(KILLS))
def test_a_kill_at_any_moment_from_lint_to_stamp_loses_nothing(approved: Path, tmp_path: Path, number: int) -> None:
    chance = random.Random(1000 + number)
    run = Run(shutil.copytree(approved, tmp_path / approved.name))
    before: dict[str, str] = {}
    for _ in range(2):
        process = subprocess.Popen(
            [sys.executable, "-c", PIPELINE, str(run.folder)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        time.sleep(chance.uniform(0.2, 7.0))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        standing = whole(run)
        lost = {name for name in before if name not in standing}
        assert not lost, f"the kill took away {lost}"
        assert stamp.status(str(run.folder)).state == ("accepted" if run.accepted.exists() else "open")
        before = standing
    call = [sys.executable, "-c", PIPELINE, str(run.folder)]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert stamp.status(str(run.folder)).state == "accepted"
    whole(run)
    assert not list(run.folder.glob(f"{bundle.PREFIX}*"))


class Enough(Exception):  # noqa: N818 - how a test stops what it watches
    """The proof run has ended."""


def proved(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the proof run end, so that what follows is only writing."""

    def stop(*_: object) -> None:
        raise Enough

    with monkeypatch.context() as patch, pytest.raises(Enough):  # noqa: PT012 - it is called until it stops
        patch.setattr(acceptance, "_assemble", stop)
        while stamp.accept(str(folder), timeout_s=60):
            pass


def test_a_disk_that_fills_while_accepting_leaves_no_half_stamp(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copy(reviewed)
    proved(folder, monkeypatch)
    usual = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    for size in (0, 3_000, 20_000):
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
        try:
            with pytest.raises(StorageError) as caught:
                acceptance.accept(State.find(str(folder)), 40)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert caught.value.code == "disk_full"
        assert "free some space" in caught.value.next_move
        assert not (folder / "accepted").exists()
        assert Journal(Run(folder).journal).breaks() == []
    signal.signal(signal.SIGXFSZ, usual)
    assert stamp.accept(str(folder), timeout_s=60).ok
    whole(Run(folder))
    assert not list(folder.glob(f"{bundle.PREFIX}*"))


READ_ONLY = """
import json, sys
from pathlib import Path
from worldwright.lint import tools as lint
from worldwright.model.errors import WorldwrightError
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.stamp import by_measurement, tools as stamp
run, said = sys.argv[1], {"status": stamp.status(sys.argv[1]).state}
for name, call in {
    "approve": lambda: stamp.approve(run),
    "describe": lambda: stamp.describe(run, by_measurement.describe(Run(run))),
    "review": lambda: stamp.review(run, by_measurement.review(Run(run))),
    "block": lambda: stamp.block(run, cause="no reason"),
    "lint": lambda: lint.check_program([Path(run, "simulation.py")]),
    "scan": lambda: scan.scan(run),
    "expect": lambda: scan.expect(run),
    "accept": lambda: stamp.accept(run, timeout_s=30),
}.items():
    try:
        call()
        said[name] = "ok"
    except WorldwrightError as refusal:
        said[name] = f"{refusal.code}: {bool(refusal.next_move)}"
print(json.dumps(said))
"""


def test_a_folder_that_cannot_be_written_is_refused_by_name(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    before = {str(p): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    call = [sys.executable, "-c", READ_ONLY, str(folder)]
    if os.geteuid() == 0:  # root writes through modes: a read-only mount it is
        mount = f'mount --bind {folder} {folder} && mount -o remount,bind,ro {folder} && exec "$@"'
        call = ["unshare", "--mount", "sh", "-c", mount, "sh", *call]
        if not shutil.which("unshare") or subprocess.run([*call[:2], "true"], check=False).returncode:
            pytest.skip("no mount namespace can be made here")
    else:
        for path in (folder, *folder.rglob("*")):
            path.chmod(0o555 if path.is_dir() else 0o444)
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    said = json.loads(done.stdout)
    assert said.pop("status") == "open"
    assert set(said.values()) == {"not_writable: True"}, said
    for path in (folder, *folder.rglob("*")):
        path.chmod(0o755 if path.is_dir() else 0o644)
    assert {str(p): p.read_bytes() for p in folder.rglob("*") if p.is_file()} == before


def test_a_clock_that_jumps_changes_no_answer(
    planned: Path, copy: Copy, prepare: Callable[[Path], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every line of the journal is written at a wild time, every file is dated anew; what holds holds by its order."""
    chance = random.Random(7)

    class Wild(datetime):
        @classmethod
        def now(cls, tz=None):  # type: ignore[no-untyped-def]
            return datetime(1970, 1, 2, tzinfo=UTC) + timedelta(days=chance.randrange(60_000))

    monkeypatch.setattr(runs, "datetime", Wild)
    folder = copy(planned)
    plan = folder / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none"), encoding="utf-8")
    prepare(folder)
    for path in folder.rglob("*"):
        moment = chance.randrange(2**31)
        os.utime(path, (moment, moment))
    assert gates.refusals("accept", State.find(str(folder))) == []
    assert stamp.accept(str(folder), timeout_s=60).ok
    assert stamp.verify(str(folder), timeout_s=60).ok
    times = [e["time"] for e in Run(folder).entries()]
    assert times != sorted(times)


def test_an_older_acceptance_stands_until_the_newer_one_is_whole(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    run = Run(folder)
    draft = bundle.draft_folder(run)
    (draft / "new.txt").write_text("new")
    seen = []

    def watch(event: str, _: tuple) -> None:
        if event == "os.rename":
            seen.append((run.accepted / "stamp.json").exists() or (run.accepted / "new.txt").exists())

    sys.addaudithook(watch)
    bundle.publish(draft, run.accepted)
    assert (run.accepted / "new.txt").exists()
    assert not draft.exists()
    assert all(seen)
