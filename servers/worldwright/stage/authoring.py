"""Hand a recording to a film's author, and ask it what the film is to show; where nobody wrote a film, the house's own tells."""

import json
import re
import sys
from pathlib import Path
from typing import Any

import worldkit

from ..model.errors import WorldwrightError
from ..model.evidence import pictures_of
from . import plain

PROGRAM = pictures_of.FILM
MOTION, FOLDER = "motion.npz", "film"
UNASKED = Path(worldkit.__file__).parent / "filming" / "unasked.py"
"""The film of a run whose author wrote none."""
TITLE_COUNTS = 3
MOST_WORDS = 2000


def lay_out(recording: Path, facts: Path, motion: Path, source: Path | None = None) -> None:
    """Write the part of a recording that the film's author sees; `facts` is the program's `program.json`, `source` the plan."""
    from worldengine.film import motion_facts
    from worldengine.recording import stored

    motion.parent.mkdir(parents=True, exist_ok=True)
    motion_facts.write(stored.open(recording), motion, plain.read_json(facts), place(source) if source else None)


def place(source: Path) -> dict[str, Any]:
    """What a plan tells of where it is: `setting`, `floor`, `light`, `wind`, `words`, and `looks`, rows of a name and a look; `{}` of no plan."""
    from ..model.plan.plan_text import read_plan

    try:
        document = read_plan(source)
    except (WorldwrightError, OSError):
        return {}
    plan, text = document.plan, source.read_text(encoding="utf-8")
    head = text.partition("\n## ")[0].strip()
    title, _, intro = head.partition("\n")
    names = " ".join(plan.object_names())
    words = re.findall(r"[a-z]+", f"{f'{title} ' * TITLE_COUNTS} {intro} {names}".lower().replace("_", " "))
    rows: list[Any] = [*plan.scene_objects, *plan.assets]
    looks = [[row.name, row.look] for row in rows if row.look]
    shown = plan.visualization
    return {
        "setting": shown.setting,
        "floor": shown.floor or "",
        "words": words[:MOST_WORDS],
        "looks": looks or [["", ""]],
        "light": json.dumps(shown.light),
        "wind": list(map(str, medium.wind if (medium := plan.simulation_parameters.medium) else (0, 0, 0))),
    }


def call(program: Path, motion: Path, out: Path | str, unmoved: bool = False) -> list[str]:
    """The command line that lets the author describe the film; `unmoved`: the motion is that of no recording."""
    words = [str(program), "--motion", str(motion), "--out", str(out), *(["--unmoved"] if unmoved else [])]
    return [sys.executable, "-s", "-P", "-m", "worldkit.filming.telling", *words]
