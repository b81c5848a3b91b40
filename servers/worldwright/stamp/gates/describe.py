"""What is seen may be described: stills or video of this key exist.

Why: a description of older pictures would vouch for a world that no longer exists.
"""

from collections.abc import Iterator

from ..needs import held
from ..refusal import Refusal
from ..state import State

CODE = "WG050"


def check(state: State) -> Iterator[Refusal]:
    """Refusals while this key has neither stills nor video."""
    stills, video = list(held(state, "stills")), list(held(state, "video"))
    films = state.plan is None or state.plan.recording_mode.mode != "none"
    if stills and (video or not films):
        yield from stills
