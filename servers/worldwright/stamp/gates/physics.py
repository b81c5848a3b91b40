"""The physics pass may run: the plan is approved, and this exact program lints clean against this exact plan.

Why: a run that cannot work costs minutes and teaches less than the finding that would have prevented it; and code for
a plan that nobody approved answers a question that nobody asked.
"""

from collections.abc import Iterator

from ..needs import held
from ..refusal import Refusal
from ..state import State

CODE = "WG020"


def check(state: State) -> Iterator[Refusal]:
    """Refusals for a missing approval, program or clean lint."""
    yield from held(state, "approved", "program", "lint")
