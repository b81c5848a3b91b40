"""Follow how fast a pass advances: whether it did since the last look, and how long the rest will take."""

from collections import deque

WINDOW_S = 10.0
"""The pace is that of the last seconds: a world that falls into a heap steps slower than at its beginning."""


class Pace:
    """The recent progress of a pass.

    What goes before the first step or frame (compiling a world, opening a window, a renderer's programs) is done once and
    is no part of the pace: it begins with the first thing that is done.
    """

    def __init__(self) -> None:
        self._said: deque[tuple[float, float]] = deque()
        self._last: float | None = None

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
        return (total - done) * (now - began) / (done - before) if total > done > before else None
