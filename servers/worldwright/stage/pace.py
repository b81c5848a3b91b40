"""Follow how fast a pass advances: whether it did since the last look, and how long the rest will take."""

from collections import deque

WINDOW_S = 10.0
"""The pace is that of the last seconds: a world that falls into a heap steps slower than at its beginning."""


class Pace:
    """The recent progress of a pass."""

    def __init__(self) -> None:
        self._said: deque[tuple[float, float]] = deque()

    def advanced(self, now_s: float, done: float) -> bool:
        """Note how much is done; returns whether that has changed."""
        moved = not self._said or self._said[-1][1] != done
        if self._said and done < self._said[-1][1]:  # the pass counts something else now
            self._said.clear()
        self._said.append((now_s, done))
        while len(self._said) > 2 and self._said[1][0] <= now_s - WINDOW_S:
            self._said.popleft()
        return moved

    def left_s(self, total: float) -> float | None:
        """Seconds until `total` is done at the recent pace; None while that is not known."""
        if len(self._said) < 2:
            return None
        (began, before), (now, done) = self._said[0], self._said[-1]
        return (total - done) * (now - began) / (done - before) if total > done > before else None
