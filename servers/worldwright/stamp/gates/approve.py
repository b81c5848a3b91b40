"""The plan may be approved: it reads as a plan, its lint has no error, nothing is left to clarify, and its poses are its rows'.

Why: the approved plan is what the program, the evidence and the review are held against. A number that nobody chose
would otherwise be chosen by whoever writes the code.
"""

from collections.abc import Iterator
from contextlib import suppress

from ...model.errors import WorldwrightError
from ...place.tools import stale_poses
from ..needs import held, no_rehearsal
from ..refusal import Refusal
from ..state import State

CODE = "WG010"
MOST = 3


def check(state: State) -> Iterator[Refusal]:
    """Refusals for an unreadable, faulty or open plan, and for a rehearsal's copy of one."""
    yield from no_rehearsal(state)
    yield from held(state, "check", "place")
    with suppress(WorldwrightError):  # a plan that cannot be read was refused above
        for found in stale_poses(state.run.plan)[:MOST]:
            yield Refusal(cause=f"place: {found.message}", next_move=f"worldwright place resolve {state.place}/plan.md")
