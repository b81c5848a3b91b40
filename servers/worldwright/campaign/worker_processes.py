"""Our own worker processes: each does one world after the other, and may die without taking the others along.

A worker is a fresh process (nothing is forked that holds an engine), told by a pipe. When the driver dies its workers see the
pipe close and end after the world that they are at, whose row they write as always.
"""

import contextlib
import multiprocessing as mp
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any, Protocol

from ..model.frozen import Frozen
from .one_world import Task

Work = Callable[[Task], Any]
BEGUN = "begun"
"""What a worker says when it takes a world up; afterwards, its address."""


class Ended(Frozen):
    """A world that a worker is no longer at."""

    task: Task
    died: str = ""
    """How its worker ended, when that did not come back; the row is on disk otherwise."""
    over_time: bool = False
    """It was ended because it took too long."""
    seconds: float = 0.0
    """For so long a worker was at it that left no row."""


class Hands(Protocol):
    """Whoever does the work."""

    def free(self) -> int:
        """How many worlds it would take now."""

    def take(self, task: Task) -> None:
        """Begin a world."""

    def ended(self, timeout_s: float) -> Iterator[Ended]:
        """What ended, waiting at most so long for the first, s."""

    def drop(self) -> list[Task]:
        """End everybody at once; what they were at."""


@dataclass
class _Worker:
    process: Any
    pipe: Connection
    at: Task | None = None
    deadline: float = float("inf")
    began: float | None = None
    """Monotonic; None before it said so."""

    @property
    def seconds(self) -> float:
        """For how long it has been at its world."""
        return 0.0 if self.began is None else time.monotonic() - self.began


class Processes:
    """Hands that are processes of this machine.

    Args:
        count: how many.
        work: what is done with a task; it can be pickled by its name.
        seconds: a world that takes longer is ended together with its worker.
    """

    def __init__(self, count: int, work: Work, seconds: float = float("inf")) -> None:
        self._context = mp.get_context("spawn")
        self._work, self._seconds = work, seconds
        self._workers: list[_Worker] = []
        self._count = count

    def free(self) -> int:
        """See `Hands`."""
        return self._count - sum(worker.at is not None for worker in self._workers)

    def take(self, task: Task) -> None:
        """See `Hands`."""
        idle = next((worker for worker in self._workers if worker.at is None), None) or self._new()
        idle.at, idle.deadline, idle.began = (
            task,
            float("inf"),
            None,
        )  # its seconds begin when the worker does: a new one starts first
        with contextlib.suppress(OSError):  # it died while it was idle: `ended` finds it
            idle.pipe.send(task)

    def ended(self, timeout_s: float) -> Iterator[Ended]:
        """See `Hands`."""
        busy = [worker for worker in self._workers if worker.at is not None]
        if not busy:
            return
        now = time.monotonic()
        patience = max(0.0, min(timeout_s, min(worker.deadline for worker in busy) - now))
        heard = wait([handle for worker in busy for handle in (worker.pipe, worker.process.sentinel)], patience)
        for worker in busy:
            task = worker.at
            assert task is not None
            if worker.pipe in heard or worker.process.sentinel in heard:
                said = None
                with contextlib.suppress(EOFError, OSError):
                    said = worker.pipe.recv() if worker.pipe.poll() else None
                if said == BEGUN:
                    worker.began = time.monotonic()
                    worker.deadline = worker.began + self._seconds
                    continue
                worker.at = None
                if said == task.world:
                    yield Ended(task=task)
                else:
                    worker.process.join()
                    self._bury(worker)
                    yield Ended(task=task, died=_how(worker.process.exitcode), seconds=worker.seconds)
            elif worker.deadline <= time.monotonic():
                worker.at = None
                self._bury(worker)
                yield Ended(task=task, over_time=True, seconds=worker.seconds)

    def drop(self) -> list[Task]:
        """See `Hands`."""
        left = [worker.at for worker in self._workers if worker.at is not None]
        for worker in list(self._workers):
            self._bury(worker)
        return left

    def close(self) -> None:
        """Let idle workers end by themselves."""
        for worker in self._workers:
            worker.pipe.close()
        for worker in self._workers:
            worker.process.join(10)
            self._bury(worker)

    def _new(self) -> _Worker:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_serve, args=(theirs, self._work), daemon=False)
        process.start()
        theirs.close()
        self._workers.append(worker := _Worker(process, ours))
        return worker

    def _bury(self, worker: _Worker) -> None:
        self._workers = [other for other in self._workers if other is not worker]
        if worker.process.is_alive():
            worker.process.kill()
        worker.process.join()
        worker.pipe.close()


def _how(code: int | None) -> str:
    return f"its worker was killed by signal {-code}" if code and code < 0 else f"its worker ended with status {code}"


def _serve(pipe: Connection, work: Work) -> None:
    """The life of a worker."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the driver's to answer
    alone()
    with contextlib.suppress(EOFError, OSError):
        while True:
            task = pipe.recv()
            pipe.send(BEGUN)
            work(task)
            pipe.send(task.world)


def alone() -> None:
    """One world has one processor: nothing is left at work beside it, and libraries start no threads of their own."""
    os.environ["WORLDWRIGHT_BESIDE"] = "0"
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
