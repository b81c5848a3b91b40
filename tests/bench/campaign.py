"""What a campaign costs beside its worlds: the report of ten thousand rows, the first of a thousand worlds, each world's overhead.

Worlds here are stand-ins without a simulator (`stub_worlds`), so what is measured is the driver, its worker processes and the
files. Goals: ten thousand rows are a table and a page in under 10 s; the first of a thousand worlds is begun in under 5 s; a world
costs at most 1 s beside what its walk costs; the driver's memory does not grow with the number of worlds, neither of those that it
hands out nor of those that were done before.

    python tests/bench/campaign.py
"""

import json
import sys
import tempfile
import time
import tracemalloc
from collections import deque
from collections.abc import Iterator
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[1]))

from figures import Figure, report

import stub_worlds
from worldwright.campaign import conducting, setting_out, wall
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import Task, task
from worldwright.campaign.worker_processes import Ended
from worldwright.campaign.world_row import Cause, Margin, Row

PLAN = Path(__file__).parents[1] / "worldwright/world/dropped-ball.md"
ROWS, PLANNED, DONE, DRIVEN = 10_000, 1000, 60, 5000


def campaign(folder: Path, worlds: int, **words: object) -> Store:
    """A campaign over so many masses of a ball."""
    folder.mkdir()
    (folder / "plan.md").write_bytes(PLAN.read_bytes())
    fields = {stub_worlds.MASS: {"from": 0.1, "to": 0.9, "steps": worlds}}
    file = folder / "c.yaml"
    said = {
        "plan": "plan.md",
        "hands": "processes",
        "workers": 2,
        "report": False,
        "sweep": {"fields": fields},
        **words,
    }
    file.write_text(json.dumps(said))
    return setting_out.begun(setting_out.checked(file), file, folder / "campaign", approved=False)


def rows(store: Store) -> None:
    """A row for each world, one in four of them refuted."""
    for number in range(ROWS):
        one = task(store, store.begun, number) if number == 0 else None
        margin = 0.3 - number % 4 * 0.12
        said = [
            Margin(objective=n, name="falls", status="holds", measured=1.0, margin=margin, unit="m") for n in range(4)
        ]
        cause = Cause(kind="refuted", step="expect", said="it does not fall") if margin < 0 else None
        outcome = "refuted" if cause else "held"
        world = one.world if one else f"{number:016x}"
        folder = f"worlds/{world[:2]}/{world}"
        store.keep(
            Row(
                world=world,
                number=number,
                outcome=outcome,
                cause=cause,
                margins=tuple(said),
                values={stub_worlds.MASS: number / ROWS},
                folder=folder,
                report=f"{folder}/report.html",
                minutes={"lint": 0.01, "physics": 0.02},
            )
        )


class Here:
    """Hands within the driver's own process: a world is done when it is taken."""

    def __init__(self, store: Store) -> None:
        self.store, self.under, self.most = store, deque[Task](), 0

    def free(self) -> int:
        """One at a time."""
        return 1 - len(self.under)

    def take(self, one: Task) -> None:
        """Its row, and nothing else; how much memory the driver holds at that moment."""
        self.most = max(self.most, tracemalloc.get_traced_memory()[0])
        self.store.keep(Row(world=one.world, number=one.number, values=one.values, outcome="held", seconds=1.0))
        self.under.append(one)

    def ended(self, _timeout_s: float) -> Iterator[Ended]:
        """What was taken."""
        while self.under:
            yield Ended(task=self.under.popleft())

    def drop(self) -> list[Task]:
        """Nothing is ever under way."""
        return []

    def close(self) -> None:
        """Nobody is left."""


def peak(store: Store) -> int:
    """Bytes of Python's that driving a campaign takes at most: when worlds are handed out, and in going through those that are done."""
    hands, done = Here(store), 0
    with mock.patch.object(conducting, "crew_of", return_value=hands):
        for _ in range(2):
            tracemalloc.start()
            end = conducting.conduct(store)
            _, done = tracemalloc.get_traced_memory()
            tracemalloc.stop()
    assert end.done == end.worlds
    return max(hands.most, done)


def waited() -> float:
    """Seconds for which this thread could have run and got no processor; 0 where the system does not tell."""
    told = Path("/proc/self/schedstat")
    return int(told.read_text().split()[1]) / 1e9 if told.is_file() else 0.0


def main() -> int:
    """Measure all of it."""
    with tempfile.TemporaryDirectory() as scratch:
        large = campaign(Path(scratch) / "large", ROWS)
        rows(large)
        began, queued = time.perf_counter(), waited()
        wall.write(large)
        told = time.perf_counter() - began - (waited() - queued)  # disks count, what else the machine is at does not

        planned = campaign(Path(scratch) / "planned", PLANNED, budget={"runs": 1})
        began = time.perf_counter()
        conducting.conduct(planned, stub_worlds.do)
        first = time.perf_counter() - began

        many = campaign(Path(scratch) / "many", DONE)
        began = time.perf_counter()
        conducting.conduct(many, stub_worlds.do)
        each = (time.perf_counter() - began) / DONE
        room = [sys.intern(f"room-{n}") for n in range(400_000)]  # its table of names would else grow at some moment
        peak(campaign(Path(scratch) / "warm", 10))  # what is loaded and kept once
        few, most = (peak(campaign(Path(scratch) / f"driven-{worlds}", worlds)) for worlds in (DRIVEN // 10, DRIVEN))
        del room
    return report(
        Figure("report of 10,000 rows", told, 10, "s"),
        Figure("first of 1,000 worlds, done", first, 5, "s"),
        Figure("overhead of a world", each, 1, "s"),
        Figure("driver's memory, a world more", (most - few) / (DRIVEN * 0.9), 20, "B"),
    )


if __name__ == "__main__":
    sys.exit(main())
