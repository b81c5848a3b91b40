"""The gates: each docstring says what the gate needs and why, each `check(state)` answers with what is missing."""

from functools import cache
from typing import TYPE_CHECKING

from ..refusal import Refusal, raise_if

if TYPE_CHECKING:
    from ...shelf import Shelf
    from ..state import State


@cache
def shelf() -> "Shelf":
    """Every gate by its code."""
    from types import FunctionType

    from ...shelf import Shelf

    return Shelf("worldwright.stamp.gates", {"check": FunctionType})


def refusals(name: str, state: "State") -> list[Refusal]:
    """What the gate of this name or code lacks; empty when it opens."""
    return list(shelf().find(name).check(state))


def pass_through(name: str, state: "State") -> None:
    """Raise a `GateError` unless the gate opens."""
    raise_if(name.replace("_", " "), refusals(name, state), state.place)
