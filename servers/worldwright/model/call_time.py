"""By when the present call has to be answered, by the clock: a client hears that it is at work, but does not wait for ever.

Limits of own time (`stage.confined`) do not end work that only waits for a processor; this one does. A command on the shell
has none.
"""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

CALL_S = 280.0
"""A call of a client is answered after so long at the latest, s: less than the harness with the shortest patience waits (300 s)."""

_ENDS: ContextVar[float] = ContextVar("call_ends", default=math.inf)


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Within the block, and in threads that are given its context, `left_s` counts down from this, s, or from less."""
    before = _ENDS.set(min(_ENDS.get(), time.monotonic() + seconds))
    try:
        yield
    finally:
        _ENDS.reset(before)


def left_s() -> float:
    """Seconds until the present call must have ended; infinite where nothing limits it."""
    return _ENDS.get() - time.monotonic()
