"""`inferred` lists a value that the plan does not have.

What it does: resolves every dotted name under `inferred`; rows of lists go by their name, placement rows by their subject.

Why is this bad: the list tells the user which numbers to audit, and auto mode which were chosen. A name that leads nowhere
hides the number it was meant for.

Use instead: the dotted path as it stands in `simulation_parameters`, or from the section on; for what only an author's law
holds (its spacing, its mouth), the law's file as its row of `interventions` names it: `laws/snow.py`, or a name
in it, `laws/snow.py.spacing`.
"""

import re
from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP124"
SEVERITY = "error"
LAW = {
    "kind": "solver",
    "bodies": ["crate"],
    "law": "snow that lies on it",
    "source": "handbook",
    "solver": {"name": "snow", "file": "laws/snow.py", "shown_by": "crate"},
}
GOOD: Changes = (
    {
        "simulation_parameters": {
            "inferred": ["materials.wood.friction", "simulation_duration", "scene_objects.crate.size"]
        }
    },
    {
        "simulation_parameters": {
            "inferred": ["topology.scene_predicates.crate", "topology.scene_predicates.crate.params"]
        }
    },
    {"simulation_parameters": {"interventions": [LAW], "inferred": ["laws/snow.py", "laws/snow.py.spacing"]}},
    {},
)
BAD: Changes = (
    {"simulation_parameters": {"inferred": ["laws/snow.py"]}},
    {"simulation_parameters": {"interventions": [LAW], "inferred": ["laws/snow.pyx"]}},
    {"simulation_parameters": {"inferred": ["materials.steel.friction"]}},
    {"simulation_parameters": {"inferred": ["duration"]}},
    {"simulation_parameters": {"inferred": ["topology.scene_predicates.crane"]}},
)
EVIDENCE = Argued("the list is for the user who approves the plan; no run reads it")


def check(view: PlanView) -> Iterator[Problem]:
    """Check each name, in the parameters and in the whole plan."""
    whole = view.plan.model_dump()
    rows = view.plan.simulation_parameters.interventions
    laws = {row.solver.file for row in rows if row.solver is not None and row.solver.file}
    for index, name in enumerate(view.plan.simulation_parameters.inferred):
        if any(name == law or (name.startswith(f"{law}.") and _says(view, law, name[len(law) + 1 :])) for law in laws):
            continue  # its numbers stand there alone
        parts = name.replace("[", ".").replace("]", "").split(".")
        copied = [view.plan.families.get(part, (part,))[0] for part in parts]
        if not any(
            _leads_somewhere(root, way) for root in (whole["simulation_parameters"], whole) for way in (parts, copied)
        ):
            place = ("simulation_parameters", "inferred", index)
            near = get_close_matches(name, _paths(whole["simulation_parameters"]), n=3, cutoff=0.6)
            near = near or get_close_matches(name, _paths(whole), n=3, cutoff=0.6)
            meant = f"did you mean {', '.join(near)}?" if near else "write its path, e.g. materials.wood.friction"
            yield view.at(place, f"`{name}` leads to nothing in the plan", meant)


def _says(view: PlanView, law: str, word: str) -> bool:
    """Whether a law's file beside the plan has a name; of one in memory, and of one not written yet, nobody knows."""
    folder = view.plan.folder
    if not word.isidentifier():
        return False
    if folder is None or not (file := (folder / law).resolve()).is_relative_to(folder.resolve()) or not file.is_file():
        return True
    return re.search(rf"\b{word}\b", file.read_text(encoding="utf-8", errors="replace")) is not None


def _paths(value: Any, above: str = "", room: int = 4) -> list[str]:
    """The dotted names of everything in a plan, rows of lists by their name."""
    rows: list[tuple[str, Any]] = list(value.items()) if isinstance(value, dict) else []
    if isinstance(value, list | tuple):
        rows = [(str(_name(row) or i), row) for i, row in enumerate(value[:200]) if isinstance(row, dict)]
    own = [f"{above}{key}" for key, _ in rows]
    inside = [_paths(part, f"{above}{key}.", room - 1) for key, part in rows] if room else []
    return [*own, *(path for paths in inside for path in paths)]


def _leads_somewhere(value: Any, parts: list[str]) -> bool:
    """Whether a dotted path leads somewhere; rows of a list may be named by number or by name, keys may hold dots."""
    if not parts:
        return True
    if isinstance(value, dict):
        keys = ((".".join(parts[:n]), parts[n:]) for n in range(1, len(parts) + 1))
        return any(key in value and _leads_somewhere(value[key], rest) for key, rest in keys)
    if isinstance(value, list | tuple):
        named = (v for i, v in enumerate(value) if str(i) == parts[0] or _name(v) == parts[0])
        return any(_leads_somewhere(v, parts[1:]) for v in named)
    return False


def _name(row: Any) -> Any:
    return row.get("name", row.get("subject")) if isinstance(row, dict) else None
