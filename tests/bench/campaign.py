"""What a campaign costs beside its worlds: the report of ten thousand rows, the first of a thousand worlds, each world's overhead.

Worlds here are stand-ins without a simulator (`stub_worlds`), so what is measured is the driver, its worker processes and the
files. Goals: ten thousand rows are a table and a page in under 10 s; the first of a thousand worlds is begun in under 5 s; a world
costs at most 1 s beside what its walk costs; the driver's memory does not grow with the number of worlds.

    python tests/bench/campaign.py
"""

import json
import sys
import tempfile
import time
import tracemalloc
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from figures import Figure, report

import stub_worlds
from worldwright.campaign import conducting, setting_out, wall
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import task
from worldwright.campaign.world_row import Cause, Margin, Row

PLAN = Path(__file__).parents[1] / "worldwright/world/dropped-ball.md"
ROWS, PLANNED, DONE = 10_000, 1000, 60


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


def peak(store: Store, worlds: int) -> int:
    """Bytes that going through so many worlds' addresses takes at most."""
    begun = store.begun
    tracemalloc.start()
    for number in range(worlds):
        store.done(task(store, begun, number).world)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


def main() -> int:
    """Measure all of it."""
    with tempfile.TemporaryDirectory() as scratch:
        large = campaign(Path(scratch) / "large", ROWS)
        rows(large)
        began = time.perf_counter()
        wall.write(large)
        told = time.perf_counter() - began

        planned = campaign(Path(scratch) / "planned", PLANNED, budget={"runs": 1})
        began = time.perf_counter()
        conducting.conduct(planned, stub_worlds.do)
        first = time.perf_counter() - began

        many = campaign(Path(scratch) / "many", DONE)
        began = time.perf_counter()
        conducting.conduct(many, stub_worlds.do)
        each = (time.perf_counter() - began) / DONE
        grown = peak(large, ROWS) / peak(large, ROWS // 10)
    return report(
        Figure("report of 10,000 rows", told, 10, "s"),
        Figure("first of 1,000 worlds, done", first, 5, "s"),
        Figure("overhead of a world", each, 1, "s"),
        Figure("driver's memory, ten times the worlds", grown, 1.2),
    )


if __name__ == "__main__":
    sys.exit(main())
