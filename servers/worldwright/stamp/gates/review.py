"""The run may be reviewed: scan, expectations and visual description of this key are all there.

Why: the verdict triangulates three channels. Each can be wrong alone: numbers cannot see a missing object, a picture
cannot show a force, and a plan's claim is only a claim. They need not be good, since a review may order a repair.
"""

from collections.abc import Iterator

from ..needs import answered
from ..refusal import Refusal
from ..state import State

CODE = "WG060"


def check(state: State) -> Iterator[Refusal]:
    """Refusals for each channel that has not answered for this key."""
    yield from answered(state, "check", "physics", "scan", "expect", "describe")
