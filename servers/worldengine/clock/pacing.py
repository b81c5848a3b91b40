"""Take steps at the pace of a wall clock, and measure where that is not kept.

A world that computes faster than it lives waits; one that is late catches up as long as it is not far behind. Beyond that
(the machine slept, the process was stopped, the world is too dear) the clock is set anew, since a world that ran through
what it owes would leave nobody the time to steer it. What was lost is told.
"""

import time
from collections.abc import Callable, Iterator

WAKE_S = 0.004
"""The clock is looked at about so often, s of wall-clock time: often enough for a hand, seldom enough for the processor."""
JITTER_S = 0.002
"""So late a wake-up is the system's own, s."""
MOST_BEHIND_S = 0.25
"""So far behind, s, the clock is set anew."""
LOOK_S = 0.05
"""In a long wait (a slow world's), whoever drives is heard so often, s."""


class Pace:
    """The numbers of the steps, each when it is due.

    Args:
        step_s: simulated seconds of a step.
        every: steps from one question to the next; the clock is looked at before some of the questions, never between.
        speed: simulated seconds in a second of the wall clock.
        most: so many steps are taken at most.
        between: called with the number of the step before which the clock is looked at, again and again where that is far off; False
            ends it.
        rows: every so many steps a state is recorded.
        steady: no answer changes between two looks at the clock.
        clock, sleep: of the wall, s.

    Attributes:
        ahead: how many steps after the one that was given last nobody has to do with; the next one comes behind them.
        overruns: how often a part was computed later than it was due.
        worst_s: the furthest it has been behind, s.
        lost_s: by how much all in all the clock was set anew, s.
        jumps: how often it was, forwards or back.
    """

    def __init__(
        self,
        step_s: float,
        every: int,
        speed: float,
        most: int,
        between: Callable[[int], bool],
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], object] = time.sleep,
        rows: int = 1,
        steady: bool = False,
    ) -> None:
        self.steps = every * max(1, round(WAKE_S * speed / (step_s * every)))
        """From one look at the clock to the next."""
        self._part_s, self._most = self.steps * step_s / speed, most
        self._stops = (rows, self.steps if steady else every)
        self._between, self._clock, self._sleep = between, clock, sleep
        self.overruns = self.jumps = self.ahead = 0
        self.worst_s = self.lost_s = 0.0

    def __iter__(self) -> Iterator[int]:
        due, step, (rows, asks) = self._clock(), 0, self._stops
        while step < self._most:
            if step % self.steps == 0:
                waited = self._wait(due, step)
                if waited is None or not self._between(step):
                    return
                due = (waited if step else self._clock()) + self._part_s  # before the first, somebody may be waited for
            following = step + 1
            self.ahead = min(self._most - following, -following % rows, -following % asks)
            yield step
            step = following + self.ahead

    def _wait(self, due: float, step: int) -> float | None:
        """Sleep until a part is due; returns when it was, by the clock as it may have been set anew, None where it is ended."""
        while (behind := self._clock() - due) < 0:
            if behind < -2 * self._part_s - MOST_BEHIND_S:  # no clock that only goes forwards shows this
                self.jumps += 1
                return self._clock()
            self._sleep(min(-behind, LOOK_S))
            if -behind <= LOOK_S:
                return due
            if not self._between(step):
                return None
        if behind > JITTER_S:
            self.overruns += 1
            self.worst_s = max(self.worst_s, behind)
        if behind > MOST_BEHIND_S:
            self.jumps += 1
            self.lost_s += behind
            return due + behind
        return due
