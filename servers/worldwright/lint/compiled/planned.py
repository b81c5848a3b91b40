"""The world that a plan describes, as it would act: its own draft, compiled in the sandbox.

Every number of the plan becomes a friction, a rebound, a mass, a limit or a servo in the engine's own terms. A
program's world is held against it (`rules/model/acting`), however the program is written.
"""

import hashlib
import re
import tempfile
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from pathlib import Path

from worldkit.files import write_atomic

from ...model.errors import CallOverError, WorldwrightError
from ...model.plan import imported
from ...model.plan.committed import Plan
from ...stage.tools import sculpt_of
from . import fetch


def source(plan: Plan) -> str:
    """The draft of a plan, in which no law of the author's runs: one could change what is held against it.

    Raises:
        PlanError: something is open, or an object has no resolved pose.
    """
    from ...draft import draft
    from ...place.tools import laid_out

    return draft(plan, laid_out(plan), alone=True).source


def world(plan: Plan, wall_s: float = fetch.WALL_S) -> fetch.Outcome:
    """The compiled world of a plan's draft; with status `failed` when the plan makes none, and why.

    Raises:
        CallOverError: the client's call ended first, which says nothing of the plan.
    """
    try:
        text = source(plan)
    except CallOverError:
        raise
    except (WorldwrightError, ValueError, KeyError) as error:
        return _none(error)
    near = imported.contents(plan)
    parts = [(name, hashlib.sha256(content).hexdigest()) for name, content in sorted(near.items())]
    key = hashlib.sha256(repr((text, parts)).encode()).hexdigest()
    kept = _KEPT.get(key)
    if kept is None:
        try:
            sculpt_of(plan)
        except CallOverError:
            raise
        except WorldwrightError as error:
            return _none(error)
        kept = _compiled(text, near, wall_s)
        if kept.status == "compiled":
            _KEPT.clear()  # people work on one run at a time
            _KEPT[key] = kept
    return kept


def _none(error: Exception) -> fetch.Outcome:
    """No world, by the fault of the plan, or of the machine that was to make it."""
    code, move = getattr(error, "code", ""), getattr(error, "next_move", "")
    cause = str(getattr(error, "cause", error))
    if code in MACHINES:
        return fetch.Outcome("wanting", failure=code, message=cause, next_move=move or "worldwright doctor")
    if missing := MISSING.search(cause):
        return fetch.Outcome("failed", failure="ModuleNotFoundError", message=missing[0])
    return fetch.Outcome("failed", failure=type(error).__name__, message=str(error))


def beside(
    plan: Plan, program: str, make: Callable[[], fetch.Outcome], wall_s: float
) -> tuple[fetch.Outcome, fetch.Outcome]:
    """The world of a program, which `make` gives, and that of its plan, each from a process that cannot see the other.

    A program that is the plan's draft word for word makes the planned world: it is not built a second time. (Acceptance holds
    the file that is stamped against a draft that it builds itself.)
    """
    if drafted(plan, program):
        made = make()
        return made, made if made.status == "compiled" else world(plan, wall_s)
    with ThreadPoolExecutor(1) as other:
        waiting = other.submit(copy_context().run, world, plan, wall_s)
        return make(), waiting.result()


def drafted(plan: Plan, program: str) -> bool:
    """Whether a program's text is the draft of a plan."""
    try:
        return source(plan) == program
    except (WorldwrightError, ValueError, KeyError):  # a plan that makes no world says why where that is asked for
        return False


MACHINES = frozenset(
    ("disk_full", "not_writable", "too_many_processes", "out_of_memory", "killed", "refused", "cancelled")
)
"""Codes of errors that say nothing of a plan. What took all its processor time does: that is counted, however loaded the machine is."""
MISSING = re.compile(r"No module named '[^']+'")
_KEPT: dict[str, fetch.Outcome] = {}
"""The last plan's world: a program is linted many times against one plan."""


def _compiled(text: str, near: Mapping[str, bytes], wall_s: float) -> fetch.Outcome:
    """The draft compiled, with the files beside it that the plan names."""
    with tempfile.TemporaryDirectory(prefix="worldwright-plan-") as folder:
        path = Path(folder) / "simulation.py"
        for name, content in near.items():
            write_atomic(path.parent / name, content)
        path.write_text(text, encoding="utf-8")
        return fetch.world(path, wall_s=wall_s, lasting_s=fetch.UNPRICED)
