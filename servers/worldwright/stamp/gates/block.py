"""The run may be called blocked: this program and plan have not been accepted.

Why: a run has one ending. What was accepted stays accepted; a doubt about it is answered by `verify`.
"""

from collections.abc import Iterator

from ..refusal import Refusal
from ..state import State
from ..steps import steps

CODE = "WG080"


def check(state: State) -> Iterator[Refusal]:
    """A refusal when this program and plan are accepted."""
    if steps(state)["accept"].holds:
        yield Refusal(cause="this program and plan are accepted", next_move=f"worldwright stamp verify {state.place}")
