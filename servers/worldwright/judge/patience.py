"""How often a judge is asked before it is given up, and how long is waited in between.

What counts is tries, not time: an answer that is none, a server that is busy or away is asked again; who has no right, gets
too much, or declines to judge will say the same again.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from .judges import JudgeError

AGAIN = frozenset({"unreachable", "timed_out", "failed", "rate_limited", "cut_off", "garbage"})
T = TypeVar("T")


@dataclass(frozen=True)
class Patience:
    """What is borne of one question."""

    tries: int = 4
    most_wait_s: float = 120.0
    """A server that asks for more is given up for now."""
    pause_s: float = 1.0
    """The first pause where a server asks for none; each further one is twice as long."""
    sleep: Callable[[float], None] = time.sleep

    def ask(self, once: Callable[[], T]) -> tuple[T, int]:
        """Ask until there is an answer; returns it and the number of tries.

        Raises:
            JudgeError: the last one, once nothing more is to be expected.
        """
        for number in range(1, self.tries + 1):
            try:
                return once(), number
            except JudgeError as error:
                wait = error.after_s if error.after_s is not None else self.pause_s * 2 ** (number - 1)
                if error.code not in AGAIN or number == self.tries or wait > self.most_wait_s:
                    raise
                self.sleep(wait)
        raise AssertionError("a question is asked at least once")
