"""Videos may be rendered: the stills of this key succeeded.

Why: a still per camera is cheap and shows bad framing before the full recording is paid for.
"""

from collections.abc import Iterator

from ..needs import held
from ..refusal import Refusal
from ..state import State

CODE = "WG040"


def check(state: State) -> Iterator[Refusal]:
    """Refusals while the physics and stills of this key have not succeeded."""
    yield from held(state, "physics", "stills")
