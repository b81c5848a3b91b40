"""Worlds of a campaign without a simulator: what comes of each is said by the mass that its sweep sets.

The protocol of a world (look, hold, note the beginning, write the row) is the real one; only the walk is not.
"""

import os
import signal
import time
from pathlib import Path
from unittest import mock

from worldwright.campaign import one_world
from worldwright.campaign.one_world import Task, Walked
from worldwright.campaign.world_row import Cause, Row

KILLS, SLEEPS, FAILS, LEAVES = 13.0, 17.0, 19.0, 23.0
"""Masses whose world kills its worker each time, never ends, says no, kills its worker once."""
MASS = "simulation_parameters.masses.ball"


def _walked(store, begun, one, minutes):
    folder = store.world(one.world)
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "paid").open("a") as stream:
        stream.write(".")
    mass = one.values.get(MASS, 1.0)
    if mass == KILLS or (mass == LEAVES and len((folder / "paid").read_text()) == 1):
        os.kill(os.getpid(), signal.SIGKILL)
    if mass == SLEEPS:
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


def slowly(one: Task) -> object:
    """The same, long enough to be interrupted."""
    time.sleep(0.2)
    return do(one)


def paid(folder: Path) -> dict[str, int]:
    """How often each world was walked, by its address."""
    return {path.parent.name: len(path.read_text()) for path in folder.glob("worlds/*/*/paid")}
