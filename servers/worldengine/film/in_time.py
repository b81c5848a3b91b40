"""Whether a film can be traced in the minutes given: if not, a plainer renderer draws all of it rather than a few frames held long.

After its first frames are drafted, what one takes is known; what is lacking between frames far apart is asked in some of the gaps.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise

from .drawing_order import FARTHEST, skeleton
from .kept_frames import DRAFT, Refined

LEAST = 3
"""So many frames are drafted before any is judged by them."""
LOOKED_INTO = 6
"""Gaps between frames far apart, of all shots, in which it is asked what is lacking."""
Lacking = Callable[[int, int, int], bool]


class InTime:
    """Judges a film by what its drafts take, once its first frames are drawn and again once those far apart are.

    Args:
        shots: the frames of each shot.
        lacking: whether a frame cannot well be reckoned from two others.
        end: when drawing ends, s on the clock that `judged` is asked by.
    """

    def __init__(self, shots: Sequence[range], lacking: Lacking, end: float) -> None:
        self._shots, self._lacking, self._end = shots, lacking, end
        self._far = sorted({number for shot in shots for number in skeleton(shot, FARTHEST)})
        self.done = False
        """Nothing is left to be judged."""

    def judged(self, state: Refined, now: float) -> float:
        """The seconds of drawing that a whole film takes, where they do not fit in what is left; else 0."""
        drawn = {number for number, samples in enumerate(state.samples) if samples > 0}
        if len(drawn) < min(LEAST, len(self._far)):
            return 0.0
        each, rest, between = state.pace.expected(DRAFT, False, 0.0), len(set(self._far) - drawn), 0.0
        if not rest:
            self.done = True
            between = missing(self._shots, self._lacking)
            rest = round(max(between - len(drawn - set(self._far)), 0.0))
            if 2 * state.taken_over > len(self._far) + between:  # a film that is mostly traced is not given up
                return 0.0
        if each * rest <= self._end - now:
            return 0.0
        return each * (len(self._far) + (between if self.done else missing(self._shots, self._lacking)))


def missing(shots: Sequence[range], lacking: Lacking) -> float:
    """About how many frames have to be traced between those far apart, by some of the gaps, halved and halved again."""
    gaps = [gap for shot in shots for gap in pairwise(skeleton(shot, FARTHEST)) if gap[1] - gap[0] > 1]
    some = gaps[:: max(1, -(-len(gaps) // LOOKED_INTO))]
    return sum(_within(*gap, lacking) for gap in some) * len(gaps) / len(some) if some else 0.0


def _within(before: int, after: int, lacking: Lacking) -> int:
    """How many of a gap: where its middle lacks, what lacks in its first half counts twice."""
    middle = (before + after) // 2
    if after - before < 2 or not lacking(middle, before, after):
        return 0
    return min(1 + 2 * _within(before, middle, lacking), after - before - 1)
