"""A campaign of real worlds, an accepted example swept, whose driver and then a worker are killed, ends with every row.

`make test` does two worlds on one worker; `make test-campaign` does twenty-four on two, up to their measured claims.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import example_sweeps
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import task

WHOLE = example_sweeps.SWEEPS >= 24
PATIENCE_S = 3600.0


def test_real_worlds_outlive_their_driver_and_a_worker(tmp_path):
    workers, until = (2, "expect") if WHOLE else (1, "physics")
    file = example_sweeps.campaign(tmp_path, workers=workers, hands="processes", until=until)
    worlds, folder = example_sweeps.SWEEPS, tmp_path / "campaign"
    store = Store(folder)
    driver = started(tmp_path, "run", str(file), "--approve", "--folder", str(folder))
    until_it_is(lambda: rows(store) >= worlds // 3 and at_work(store), driver)
    driver.send_signal(signal.SIGKILL)
    driver.wait()

    driver = started(tmp_path, "resume", str(folder))
    until_it_is(lambda: rows(store) >= 2 * worlds // 3 and at_work(store, driver.pid), driver)
    world, worker = at_work(store, driver.pid)[-1]
    os.kill(worker, signal.SIGKILL)
    assert driver.wait(PATIENCE_S) == 0, said(tmp_path)

    found = sorted(store.rows(), key=lambda row: row.number)
    assert [row.number for row in found] == list(range(worlds))
    assert [task(store, store.begun, row.number).world for row in found] == [row.world for row in found]
    for row in found:
        assert row.outcome == "held", (row.cause, said(tmp_path))
        assert row.begun == (2 if row.world == world else 1), "nothing is begun twice but what was killed"
        assert row.runs == 1 and (store.folder / row.recording).is_dir(), "nor its physics paid for again"
        assert row.trajectory_sha256 and row.world_sha256 and (row.margins or not WHOLE)
    assert len({row.trajectory_sha256 for row in found}) == worlds
    told = subprocess.run(words("status", str(folder), "--format", "json"), capture_output=True, text=True, check=True)
    assert json.loads(told.stdout)["outcomes"] == {"held": worlds}


def words(*told: str) -> list[str]:
    return [sys.executable, "-m", "worldwright.cli", "campaign", *told]


def started(folder: Path, *told: str) -> "subprocess.Popen[bytes]":
    """A driver in a process of its own."""
    with (folder / "said.txt").open("ab") as log:
        return subprocess.Popen(words(*told), cwd=folder, stdout=log, stderr=log)


def said(folder: Path) -> str:
    return (folder / "said.txt").read_text()[-3000:]


def rows(store: Store) -> int:
    return sum(1 for _ in store.folder.glob("rows/*/*.json"))


def at_work(store: Store, driver: int | None = None) -> list[tuple[str, int]]:
    """Worlds that are begun and have no row, each with the process that holds it; those of a driver's own children."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            if driver is not None and int(stat.read_text().rpartition(")")[2].split()[1]) != driver:
                continue
            for handle in (stat.parent / "fd").iterdir():
                at = handle.readlink()
                if (
                    at.parent.parent == store.folder / "locks"
                    and store.begun_before(at.name)
                    and not store.done(at.name)
                ):
                    found.append((at.name, int(stat.parent.name)))
    return sorted(found)


def until_it_is(condition, driver) -> None:
    ends = time.monotonic() + PATIENCE_S
    while not condition():
        assert driver.poll() is None, f"it ended early, with status {driver.returncode}"
        assert time.monotonic() < ends
        time.sleep(0.1)
