"""Stills may be rendered: the physics pass of this key succeeded and its recording is here.

Why: stills and videos replay recorded states; without a recording there is nothing true to draw.
"""

from collections.abc import Iterator

from ..needs import held
from ..refusal import Refusal
from ..state import State

CODE = "WG030"


def check(state: State) -> Iterator[Refusal]:
    """Refusals while the physics pass of this key has not succeeded."""
    yield from held(state, "physics")
