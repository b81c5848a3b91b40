"""By when the present call has to be answered, by the clock: a client hears that it is at work, but does not wait for ever.

Limits of own time (`stage.confined`) do not end work that only waits for a processor; this one does. A command on the shell
has none.
"""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from .errors import CallOverError

CALL_S = 280.0
"""A call of a client is answered after so long at the latest, s: less than the harness with the shortest patience waits (300 s)."""
SPARE_S = 60.0
"""Of a call, what stays for what it compiles and measures itself, after it has waited for jobs, s."""

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


def waiting_s(seconds: float) -> float:
    """For how much of the seconds that a caller gives a call may wait for jobs, so that it is answered in time, s."""
    return min(seconds, max(left_s() - SPARE_S, 0.0))


def over(again: str = "") -> CallOverError:
    """What a call is answered with whose time ended before its work was done; `again` is its command on the shell."""
    on_the_shell = f": `{again}`" if again else ""
    return CallOverError(
        f"it was not done within the {CALL_S:g} s that a call may take",
        next_move=f"call it again when the machine has less to do, or on the shell, which waits longer{on_the_shell}",
    )
