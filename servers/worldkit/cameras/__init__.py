"""Cameras that frame what moves.

`add` puts a fixed camera into the world, posed from the rest geometry, and stores what it is meant to show. Before
anything is drawn, `aim` poses every such camera again from the recorded motion, so that the space its subjects cross
fills the frame; `track` moves those that follow. The direction of a view never depends on the motion, only its
distance and centre do, so a picture before and a picture after a repair can be compared.

Frame: z up, +X front, +Y left, metres; `fovy` is vertical, in degrees.
"""

from .framing import aim, track
from .intent import Intent, add
from .views import VIEWS

__all__ = ["VIEWS", "Intent", "add", "aim", "track"]
