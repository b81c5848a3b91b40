"""What a frame that is not traced looks like between two that are, and whether that can be told."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from . import carrying

if TYPE_CHECKING:
    import numpy as np

    from .carrying import Surfaces

COARSER = 4
"""Whether a frame can be reckoned is told by pictures so many times smaller each way."""
UNSEEN, MOST_UNSEEN = 0.01, 0.03
"""Of a frame so much may be seen in neither neighbour: of one between wide gaps, and of every second one, which shows for 1/24 s."""
STRAYS, SWIMS = 0.06, 0.15
"""Across wide gaps a thing that goes farther than this share of the picture's height has a shadow that would be seen twice; and
where the camera carries everything so far, so would be what is mirrored."""
TOO_MUCH = 0.15
"""Of a frame of which more is unknown the nearest traced one is shown instead."""
KEPT = 24
"""Of so many frames it is remembered what they show."""


class Geometry:
    """What the frames of a film show, remembered for a while.

    Args:
        surfaces: draws what a frame shows, so many times smaller each way; any exception says that it cannot be drawn here.
    """

    def __init__(self, surfaces: "Callable[[int, int], Surfaces]") -> None:
        self._surfaces = surfaces
        self._known: dict[tuple[int, int], Surfaces] = {}

    def of(self, frame: int, coarser: int = 1) -> "Surfaces":
        """What a frame shows."""
        key = (frame, coarser)
        if key not in self._known:
            while len(self._known) >= (KEPT if coarser > 1 else 4):
                del self._known[next(iter(self._known))]
            self._known[key] = self._surfaces(frame, coarser)
        else:
            self._known[key] = self._known.pop(key)
        return self._known[key]

    def lacking(self, frame: int, before: int, after: int) -> bool:
        """Whether a frame cannot well be reckoned from these two."""
        now, sides = self.of(frame, COARSER), [self.of(side, COARSER) for side in (before, after)]
        found, height = carrying.fit(now, sides), now.depth.shape[0]
        if after - before <= 2:
            return found.unseen > MOST_UNSEEN
        if found.unseen > UNSEEN or found.melts > UNSEEN:
            return True
        return carrying.strayed(*sides) > STRAYS * height or found.way > SWIMS * height


def neighbours(frame: int, drawn: Sequence[float], shot: range) -> list[int]:
    """The nearest drawn frames of a shot before and after one of it, as far as there are any."""
    before = next((k for k in range(frame, shot.start - 1, -1) if drawn[k] > 0), None)
    after = next((k for k in range(frame, shot.stop) if drawn[k] > 0), None)
    return [k for k in (before, after) if k is not None]


def reckoned(
    frame: int, sides: Sequence[int], geometry: Geometry, read: "Callable[[int], np.ndarray]", shutter: float
) -> "np.ndarray | None":
    """The picture of a frame by its neighbours' pictures: uint8 (H, W, 3); None where they show too little of it.

    `shutter` is the share of the time between two frames for which it is open.
    """
    now, pictures = geometry.of(frame), [(geometry.of(side), read(side)) for side in sides]
    gap = max(abs(side - frame) for side in sides)
    share = (frame - sides[0]) / (sides[-1] - sides[0]) if len(sides) > 1 else 0.0
    image, missing = carrying.between(now, pictures, share, 0.5 * shutter / max(gap, 1))
    return image if missing <= TOO_MUCH else None
