"""The world that a plan describes, as it would act: its own draft, compiled in the sandbox.

Every number of the plan becomes a friction, a rebound, a mass, a limit or a servo in the engine's own terms. A
program's world is held against it (`rules/model/acting`), however the program is written.
"""

import hashlib
import tempfile
from collections.abc import Mapping
from pathlib import Path

from worldkit.files import write_atomic

from ...model.errors import WorldwrightError
from ...model.plan import imported
from ...model.plan.committed import Plan
from ...stage.tools import sculpt_of
from . import fetch


def source(plan: Plan) -> str:
    """The draft of a plan.

    Raises:
        PlanError: something is open, or an object has no resolved pose.
    """
    from ...draft import draft
    from ...place.tools import laid_out

    return draft(plan, laid_out(plan)).source


def world(plan: Plan, wall_s: float = fetch.WALL_S) -> fetch.Outcome:
    """The compiled world of a plan's draft; with status `failed` when the plan makes none, and why."""
    try:
        text = source(plan)
    except (WorldwrightError, ValueError, KeyError) as error:
        return fetch.Outcome("failed", failure=type(error).__name__, message=str(error))
    near = imported.contents(plan)
    key = hashlib.sha256(repr((text, near)).encode()).hexdigest()
    kept = _KEPT.get(key)
    if kept is None:
        try:
            sculpt_of(plan)
        except WorldwrightError as error:
            return fetch.Outcome("failed", failure=type(error).__name__, message=str(error))
        kept = _compiled(text, near, wall_s)
        if kept.status == "compiled":
            _KEPT.clear()  # people work on one run at a time
            _KEPT[key] = kept
    return kept


_KEPT: dict[str, fetch.Outcome] = {}
"""The last plan's world: a program is linted many times against one plan."""


def _compiled(text: str, near: Mapping[str, bytes], wall_s: float) -> fetch.Outcome:
    """The draft compiled, with the files beside it that the plan names."""
    with tempfile.TemporaryDirectory(prefix="worldwright-plan-") as folder:
        path = Path(folder) / "simulation.py"
        for name, content in near.items():
            write_atomic(path.parent / name, content)
        path.write_text(text, encoding="utf-8")
        return fetch.world(path, wall_s=wall_s)
