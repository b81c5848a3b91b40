"""Follow how fast a pass advances: whether it did since the last look, and how long the rest will take."""

from collections import deque
from collections.abc import Sequence
from itertools import pairwise

WINDOW_S = 10.0
"""The pace is that of the last seconds: a world that falls into a heap steps slower than at its beginning."""
MOST_SHARES = 1000


class Pace:
    """The recent progress of a pass.

    What goes before the first step or frame (compiling a world, opening a window, a renderer's programs) is done once and
    is no part of the pace: it begins with the first thing that is done.
    """

    def __init__(self) -> None:
        self._said: deque[tuple[float, float]] = deque()
        self._last: float | None = None
        self._shares: tuple[float, ...] = (0.0, 1.0)

    def spread(self, shares: object) -> None:
        """Take over how the work is spread: shares of it that are done after each of equal parts, from 0 to 1, rising.

        A program's own process tells it, so what is none counts for nothing.
        """
        if not isinstance(shares, Sequence) or isinstance(shares, str) or not 2 <= len(shares) <= MOST_SHARES:
            return
        if not all(isinstance(share, int | float) and 0 <= share <= 1 for share in shares):
            return
        if shares[0] == 0 and shares[-1] == 1 and all(a <= b for a, b in pairwise(shares)):
            self._shares = tuple(map(float, shares))

    def _work(self, done: float, total: float) -> float:
        """The share of the work of `total` with which `done` is done."""
        parts = len(self._shares) - 1
        place = min(max(done / total, 0.0), 1.0) * parts
        low = min(int(place), parts - 1)
        return self._shares[low] + (place - low) * (self._shares[low + 1] - self._shares[low])

    def advanced(self, now_s: float, done: float) -> bool:
        """Note how much is done; returns whether that has changed."""
        last, self._last = self._last, done
        if last is not None and done < last:  # the pass counts something else now
            self._said.clear()
        if done > 0:
            self._said.append((now_s, done))
        while len(self._said) > 2 and self._said[1][0] <= now_s - WINDOW_S:
            self._said.popleft()
        return last != done

    def left_s(self, total: float) -> float | None:
        """Seconds until `total` is done at the recent pace; None while that is not known."""
        if len(self._said) < 2:
            return None
        (began, before), (now, done) = self._said[0], self._said[-1]
        if not total > done > before:
            return None
        worked = self._work(done, total) - self._work(before, total)
        return (1.0 - self._work(done, total)) * (now - began) / worked if worked > 0 else None
