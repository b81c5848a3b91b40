"""Sweeps of an accepted example, each a real world: a few in `make test`, all of them in `make test-campaign` and `make test-ray`.

`WORLDWRIGHT_SWEEPS` says how many. They differ in the height that the ball is dropped from: what falls freely falls alike whatever its
mass, and equal motions have one hash.
"""

import json
import os
from pathlib import Path

EXAMPLE = Path(__file__).parents[1] / "examples/bouncing-basketball"
HEIGHT = "topology.scene_predicates[0].params.bottom"
SWEEPS = int(os.environ.get("WORLDWRIGHT_SWEEPS", "2"))


def campaign(folder: Path, worlds: int = SWEEPS, **words: object) -> Path:
    """The file of a campaign over so many heights around the example's own, in a folder that is made."""
    folder.mkdir(parents=True, exist_ok=True)
    heights = [round(1.75 + 0.1 * number / max(1, worlds - 1), 6) for number in range(worlds)]
    said = {"plan": str(EXAMPLE), "report": False, "sweep": {"fields": {HEIGHT: {"values": heights}}}, **words}
    file = folder / "heights.yaml"
    file.write_text(json.dumps(said))
    return file
