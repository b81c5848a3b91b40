"""Worlds of a campaign without a simulator: what comes of each is said by the mass that its sweep sets.

The protocol of a world (look, hold, note the beginning, write the row) is the real one; only the walk is not.
"""

import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

from worldkit.files import write_atomic
from worldwright.campaign import one_world
from worldwright.campaign.one_world import Task, Walked
from worldwright.campaign.worker_processes import Ended
from worldwright.campaign.world_row import Cause, Row

KILLS, SLEEPS, FAILS, WAITS = -1.0, -2.0, -3.0, 1000.0
"""Masses whose world kills its worker each time, never ends (nor at a fraction beyond), says no; from the last on, it is begun and
waits until it is let in. None lies where a sweep of ordinary masses would come upon it."""
MASS = "simulation_parameters.masses.ball"


def _walked(store, begun, one, minutes, _deadline):
    folder = store.world(one.world)
    folder.mkdir(parents=True, exist_ok=True)
    if one.values.get(MASS, 1.0) >= WAITS:
        write_atomic(door(store.folder, one.number, "waits"), str(os.getpid()))
        while not door(store.folder, one.number, "open").exists():
            time.sleep(0.01)
    with (folder / "paid").open("a") as stream:
        stream.write(".")
    mass = one.values.get(MASS, 1.0)
    if mass == KILLS:
        os.kill(os.getpid(), signal.SIGKILL)
    if int(mass) == SLEEPS:
        time.sleep(600)
    minutes["physics"] = 0.5
    if mass == FAILS:
        return Walked("failed", Cause(kind="WL101", step="lint", said="a name that is not there", next_move="mend it"))
    return Walked("held")


def _row(store, begun, one, walked, minutes, seconds):
    return Row(
        world=one.world,
        number=one.number,
        values=one.values,
        outcome=walked.outcome,
        cause=walked.cause,
        runs=1,
        begun=store.begun_before(one.world),
        seconds=1.0,
        minutes=minutes,
        folder=store.world(one.world).relative_to(store.folder).as_posix(),
    )


def do(one: Task) -> object:
    """One such world."""
    with mock.patch.multiple(
        one_world, _walked=_walked, _row=_row
    ):  # a stand-in for Ray calls it in the test's own process
        return one_world.perform(one)


class Here:
    """Hands within the caller's own process: a world is done when it is asked for, and no worker has to start."""

    def __init__(self, count: int = 2, work: Callable[[Task], object] | None = None) -> None:
        self.count, self.work, self.under = count, work or do, deque[Task]()

    def free(self) -> int:
        """How many more are taken."""
        return self.count - len(self.under)

    def take(self, one: Task) -> None:
        """For later."""
        self.under.append(one)

    def ended(self, _timeout_s: float) -> Iterator[Ended]:
        """The one that was taken first."""
        self.work(one := self.under.popleft())
        yield Ended(task=one)

    def drop(self) -> list[Task]:
        """Nothing of it was begun."""
        return []

    def close(self) -> None:
        """Nobody is left."""


def door(folder: Path, number: int, what: str) -> Path:
    """Where world `number` says that it waits, or is told that it need not."""
    return folder / f"{what}-{number}"


def let_in(folder: Path, number: int) -> None:
    """World `number` waits no longer, nor would it when it is begun again."""
    door(folder, number, "open").touch()


def on_a_node(one: Task) -> object:
    """A real world on a node of Ray's, which is noted with its worker's niceness."""
    _note(one)
    return one_world.perform(one)


def stub_on_a_node(one: Task) -> object:
    """A stand-in there."""
    _note(one)
    return do(one)


def _note(one: Task) -> None:
    ray = sys.modules["ray"]  # whose worker this is
    write_atomic(Path(one.folder) / "nodes" / ray.get_runtime_context().get_node_id(), str(os.nice(0)))


def paid(folder: Path) -> dict[str, int]:
    """How often each world was walked, by its address."""
    return {path.parent.name: len(path.read_text()) for path in folder.glob("worlds/*/*/paid")}
