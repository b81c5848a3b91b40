"""Processor time of short processes that this one had made beside it (confined runs, pre-rolls): who waits for one adds it."""

import resource
import threading

_LOCK = threading.Lock()
_BESIDE = [0.0]


def add(seconds: float) -> None:
    """Count a run that has ended, s."""
    with _LOCK:
        _BESIDE[0] += seconds


def spent_s() -> float:
    """Processor time of this process so far and of the runs that were counted, s; jobs tell their own (`JobStatus.cpu_s`)."""
    own = resource.getrusage(resource.RUSAGE_SELF)
    return own.ru_utime + own.ru_stime + _BESIDE[0]
