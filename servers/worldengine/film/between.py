"""What a frame that is not traced looks like between two that are, and whether that can be told."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from . import carrying
from .fitting import Fit, fit, parts

if TYPE_CHECKING:
    from .carrying import Surfaces
    from .renderers.preview.eye import View

COARSER = 4
"""Whether a frame can be reckoned is told by pictures so many times smaller each way."""
UNSEEN, MOST_UNSEEN = 0.01, 0.03
"""Of a frame so much may be seen in neither neighbour: of one between wide gaps, and of every second one, which shows for 1/24 s."""
STRAYS, SWIMS = 0.06, 0.15
"""Across wide gaps a thing that goes farther than this share of the picture's height has a shadow that would be seen twice; and
where the camera carries everything so far, so would be what is mirrored."""
APART_PX = 1.0
"""What is seen through something may go so far beside it from a traced frame to one that is reckoned."""
TOO_MUCH = 0.15
"""Of a frame of which more is unknown the nearest traced one is shown instead."""
SPUN, TORN = math.radians(35.0), math.radians(90.0)
"""What turns farther to a traced frame has its light and its streaks turned with it; and so far that nothing of it fits."""
SPUN_SHARE = 0.004
"""That is seen of what covers so much of the picture."""
KEPT = 24
"""Of so many frames it is remembered what they show."""


class Geometry:
    """What the frames of a film show, remembered for a while.

    Args:
        surfaces: draws what a frame shows, so many times smaller each way; any exception says that it cannot be drawn here.
        placed: tells where things are in a frame (N, 3, 4), and its view, which takes less than to draw it.
    """

    def __init__(
        self,
        surfaces: "Callable[[int, int], Surfaces]",
        placed: "Callable[[int], tuple[np.ndarray, View]] | None" = None,
    ) -> None:
        self._surfaces, self._placed = surfaces, placed
        self._known: dict[tuple[int, int], Surfaces] = {}
        self._misleads: dict[tuple[int, ...], bool] = {}

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
        found, height = fit(now, sides), now.depth.shape[0]
        if found.lost or _misleads(now, sides, found, after - before) or self._spun(frame, (before, after)) > SPUN:
            return True
        if after - before <= 2:
            return found.unseen > MOST_UNSEEN
        if found.unseen > UNSEEN:
            return True
        if carrying.strayed(*sides) > STRAYS * height or found.way > SWIMS * height:
            return True
        others = (k for k in range(before + 1, after) if k != frame and self._comes(k, sides))
        return any(fit(self.of(k, COARSER), sides).lost for k in others)

    def misleads(self, frame: int, sides: Sequence[int]) -> bool:
        """Whether it would show what never was, as something behind glass at two places, if it were reckoned from these; between two,
        it is asked of the middle one, as while the film is drafted."""
        middle = frame if len(sides) < 2 else (sides[0] + sides[-1]) // 2
        key = (middle, *sides)
        if key not in self._misleads:
            now, known = self.of(middle, COARSER), [self.of(side, COARSER) for side in sides]
            gap = max(frame, *sides) - min(frame, *sides)
            torn = self._spun(middle, sides) > TORN
            self._misleads[key] = torn or _misleads(now, known, fit(now, known), gap)
        return self._misleads[key]

    def _spun(self, frame: int, sides: "Sequence[int]") -> float:
        """How far what is seen turns at most to the farther side, by how fast it does in this frame, radians: what goes round more
        than once between two moments would not be found by its poses there."""
        if self._placed is None:
            return 0.0
        shown, count = np.unique(self.of(frame, COARSER).things, return_counts=True)
        near = frame + (1 if sides[-1] > frame else -1)  # of the same shot
        (before, _), (after, _) = self._placed(frame), self._placed(near)
        shown = shown[(shown >= 0) & (count > SPUN_SHARE * count.sum()) & (shown < min(len(before), len(after)))]
        if not len(shown):
            return 0.0
        turn, _ = carrying.motion(before[shown], after[shown])
        turn = (
            turn / np.cbrt(np.maximum(np.linalg.det(turn), 1e-9))[:, None, None]
        )  # what grows or shrinks turns no more for that
        skew = 0.5 * (turn - np.swapaxes(turn, 1, 2))
        sine = np.sqrt(skew[:, 2, 1] ** 2 + skew[:, 0, 2] ** 2 + skew[:, 1, 0] ** 2)
        angle = np.arctan2(sine, 0.5 * (np.trace(turn, axis1=1, axis2=2) - 1.0))
        return float(angle.max()) * max(abs(side - frame) for side in sides)

    def _comes(self, frame: int, sides: "list[Surfaces]") -> bool:
        """Whether a frame may show a thing that neither side does: it moves there, or is in the picture only meanwhile."""
        if self._placed is None:
            return True
        poses, view = self._placed(frame)
        if any(len(side.poses) != len(poses) for side in sides):
            return True
        at_sides = [within(side.poses, side.view) for side in sides]
        shown = np.isin(np.arange(len(poses)), np.concatenate([side.things.ravel() for side in sides]))
        moves = np.any([np.abs(side.poses - poses).max(axis=(1, 2)) > carrying.LEAST_M for side in sides], axis=0)
        return bool((~shown & within(poses, view) & (moves | ~np.any(at_sides, axis=0))).any())


def _misleads(now: "Surfaces", sides: "list[Surfaces]", found: Fit, gap: int) -> bool:
    return any(parts(now, side, APART_PX / COARSER) for side in sides) or (gap > 2 and found.melts > UNSEEN)


def within(poses: "np.ndarray", view: "View") -> "np.ndarray":
    """Whether the middle of each thing (N, 3, 4) is in the picture: bool (N,)."""
    place = (poses[:, :, 3] - view.eye) @ view.axes
    inside: np.ndarray = (place[:, 2] < 0) & (np.abs(place[:, :2]) <= -place[:, 2:] * view.tangents).all(axis=1)
    return inside


def neighbours(frame: int, drawn: Sequence[float], shot: range) -> list[int]:
    """The nearest drawn frames of a shot before and after one of it, as far as there are any."""
    before = next((k for k in range(frame, shot.start - 1, -1) if drawn[k] > 0), None)
    after = next((k for k in range(frame, shot.stop) if drawn[k] > 0), None)
    return [k for k in (before, after) if k is not None]


def reckoned(
    frame: int, sides: Sequence[int], geometry: Geometry, read: "Callable[[int], np.ndarray]", shutter: float
) -> "np.ndarray | None":
    """The picture of a frame by its neighbours' pictures: uint8 (H, W, 3); None where they show too little of it, or would mislead.

    `shutter` is the share of the time between two frames for which it is open.
    """
    if geometry.misleads(frame, sides):
        return None
    now, pictures = geometry.of(frame), [(geometry.of(side), read(side)) for side in sides]
    gap = max(abs(side - frame) for side in sides)
    share = (frame - sides[0]) / (sides[-1] - sides[0]) if len(sides) > 1 else 0.0
    image, missing = carrying.between(now, pictures, share, 0.5 * shutter / max(gap, 1))
    return image if missing <= TOO_MUCH else None
