"""The files that a copy of a plan needs to be run elsewhere: what its rows name, and its laws with the modules and data of theirs.

An approval binds only the former (`evidence/approval.py`): a law is the program's, whose hash is part of every evidence key.
"""

from contextlib import suppress
from pathlib import Path

from .. import companions
from ..errors import WorldwrightError
from . import imported
from .committed import Plan
from .plan_text import read_plan


def of(folder: Path) -> dict[str, bytes]:
    """Content by path relative to a run folder; nothing when its plan cannot be read."""
    with suppress(WorldwrightError, OSError):
        plan = read_plan(folder / "plan.md").plan
        return imported.contents(plan) | _laws(plan, folder)
    return {}


def _laws(plan: Plan, folder: Path) -> dict[str, bytes]:
    rows = plan.simulation_parameters.interventions
    found: dict[str, bytes] = {}
    for name in sorted({row.solver.file for row in rows if row.solver and row.solver.file}):
        path = folder / name
        if ".." in Path(name).parts or not path.resolve().is_relative_to(folder.resolve()) or not path.is_file():
            continue
        found |= {name: path.read_bytes()} | companions.of(path, folder)
    return found
