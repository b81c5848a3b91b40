"""The gates of the tools here: each docstring says what the gate needs and why, each `check` returns what is missing.

`worldwright.stage.gates` checks what a pass needs before it may start.
"""

from functools import cache
from typing import TYPE_CHECKING

from ..refusal import Refusal, raise_if

if TYPE_CHECKING:
    from ...shelf import Shelf
    from ..state import State


@cache
def shelf() -> "Shelf":
    """Every gate by its code."""
    from ...shelf import Attribute, Function, Shelf

    return Shelf("worldwright.stamp.gates", {"check": Attribute(Function, "(State) -> the refusals; none: it opens")})


def refusals(name: str, state: "State") -> list[Refusal]:
    """The refusals of the gate of this name or code; empty when it opens. A gate that raises an error stays shut."""
    from ...shelf import failed

    gate = shelf().find(name)
    try:
        return list(gate.check(state))
    except Exception as defect:
        return [Refusal(cause=f"the gate {failed(gate, defect)}", next_move="ask again when it is mended")]


def pass_through(name: str, state: "State") -> None:
    """Raise a `GateError` unless the gate opens."""
    raise_if(name.replace("_", " "), refusals(name, state), state.place)
