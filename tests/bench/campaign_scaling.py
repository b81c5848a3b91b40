"""What two workers get done in the time of one, where worlds are bound by their physics.

Worlds here step a real model in their worker, and nothing else; driver, worker processes, rows and locks are those of every campaign.
Two workers do twice the work of one, less what they wait between worlds and less what a world takes longer beside another. Both are
measured as shares: of the workers' time how much is spent in worlds, and processor time of a world alone and beside another. So the
figure hardly depends on what else the machine does. Goal: two workers do at least 1.7 times the work of one.

    python tests/bench/campaign_scaling.py
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

import mujoco
from campaign import campaign
from figures import Figure, report

from worldwright.campaign import conducting
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import Task
from worldwright.campaign.world_row import Row

WORLDS, STEPS, WORKERS = 12, 4000, 2
BALLS = "".join(
    f'<body pos="{x} {y} {1 + x + y}"><freejoint/><geom type="sphere" size=".2"/></body>'
    for x in range(4)
    for y in range(4)
)
WORLD = f'<mujoco><worldbody><geom type="plane" size="9 9 1"/>{BALLS}</worldbody></mujoco>'


def fall(one: Task) -> None:
    """Balls fall on a floor and on each other; its row, with its processor time, s, as its seconds."""
    began, store = (time.monotonic(), time.process_time()), Store(one.folder)
    with store.working(one.world):
        model = mujoco.MjModel.from_xml_string(WORLD)
        data = mujoco.MjData(model)
        for _ in range(STEPS // 100):
            mujoco.mj_step(model, data, 100)
        spent = time.process_time() - began[1]
        minutes = {"begun": began[0], "ended": time.monotonic()}
        worker = str(os.getpid())
        store.keep(
            Row(world=one.world, number=one.number, outcome="held", seconds=spent, minutes=minutes, worker=worker)
        )


def measured(folder: Path, workers: int) -> tuple[float, float]:
    """Of a campaign by so many workers: the share of their time that is spent in worlds, and a world's processor time, s."""
    store = campaign(folder, WORLDS, workers=workers)
    conducting.conduct(store, fall)  # type: ignore[arg-type]
    rows, spans = list(store.rows()), dict[str, list[float]]()
    for row in rows:
        spans.setdefault(row.worker, []).extend((row.minutes["begun"], row.minutes["ended"]))
    assert len(spans) == workers, "each did its share"
    inside = sum(row.minutes["ended"] - row.minutes["begun"] for row in rows)
    return inside / sum(max(span) - min(span) for span in spans.values()), sum(row.seconds for row in rows) / WORLDS


def main() -> int:
    """Measure both, one after the other."""
    with tempfile.TemporaryDirectory() as scratch:
        share_alone, alone = measured(Path(scratch) / "one", 1)
        share, beside = measured(Path(scratch) / "two", WORKERS)
    said = {"share alone": share_alone, "share": share, "s alone": alone, "s beside another": beside}
    print(json.dumps({name: round(value, 4) for name, value in said.items()}))
    return report(
        Figure("work of two workers, of one", WORKERS * share / share_alone * alone / beside, 0.85 * WORKERS, "x", True)
    )


if __name__ == "__main__":
    sys.exit(main())
