"""The plan may be approved: it reads as a plan, its lint has no error, and nothing is left to clarify.

Why: the approved plan is what the program, the evidence and the review are held against. A number that nobody chose
would otherwise be chosen by whoever writes the code.
"""

from collections.abc import Iterator

from ..needs import held, no_rehearsal
from ..refusal import Refusal
from ..state import State

CODE = "WG010"


def check(state: State) -> Iterator[Refusal]:
    """Refusals for an unreadable, faulty or open plan, and for a rehearsal's copy of one."""
    yield from no_rehearsal(state)
    yield from held(state, "check", "place")
