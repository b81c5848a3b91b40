"""Find lists that are meant to hold many states and hold one many times."""

from typing import Any

import mujoco
from said import SAID

KINDS = (mujoco.MjData,)


def _states(thing: Any) -> list[Any]:
    if isinstance(thing, KINDS):
        return [thing]
    inside = getattr(thing, "__dict__", None)
    return (
        [v for v in inside.values() if isinstance(v, KINDS)]
        if isinstance(inside, dict) and hasattr(thing, "step")
        else []
    )


def appended(found: Any, thing: Any) -> None:
    """As `found.append(thing)`."""
    states = {id(s) for s in _states(thing)}
    if states and type(found) is list and 0 < len(found) < 10_000:
        before = {id(s) for s in _states(found[0])}
        if states & before and (thing is not found[0] or isinstance(thing, KINDS)):
            SAID.event("one_state_listed", times=len(found) + 1)
    found.append(thing)


def listed(found: Any) -> Any:
    """Look at a list that was just made."""
    if type(found) is list and 1 < len(found) < 10_000:
        first = {id(s) for s in _states(found[0])}
        if first and all(first & {id(s) for s in _states(f)} for f in found[1:]):
            SAID.event("one_state_listed", times=len(found))
    return found
