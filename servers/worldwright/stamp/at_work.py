"""What is told of a pass while `go` waits for it, on a terminal or not, and what would make a long one cheaper."""

import time
from collections.abc import Callable, Iterable
from typing import Protocol

from ..model.evidence.reports import PassName
from ..model.evidence.run import Run
from ..model.plan import law_costs
from ..model.progress import Progress
from .state import State

SILENT_S, MOST_S = 30.0, 30.0
"""A pass is told of after so long, and then each time after twice as long; a call of `wait` takes no longer than the latter."""


class Pass(Protocol):
    """What is asked of a job's state (`stage`)."""

    @property
    def stage(self) -> str:
        """Its name."""

    @property
    def eta_s(self) -> float | None:
        """How long it still takes, s."""

    def text(self) -> str:
        """What is told of it, in its first line."""


def line(job: Pass, state: State) -> str:
    """How far a job is; of a long physics with an author's law also the cheaper choice."""
    said, plan = job.text().splitlines()[0], state.plan
    rows = plan.simulation_parameters.interventions if plan is not None else ()
    if job.stage != "physics" or (job.eta_s or 0.0) <= law_costs.LONG_S:
        return said
    if not any(row.solver and row.solver.file for row in rows):
        return said
    return f"{said}; {law_costs.CHEAPER}; `worldwright stage cancel {state.place}` ends it"


class Waiting:
    """One wait for a pass.

    Args:
        say: told how far the pass is, now and then.
        state: of the run.
        silent_s: nothing is said before; 0: what begins is told at once.
    """

    def __init__(self, say: Callable[[str, str, str], None], state: State, silent_s: float = SILENT_S) -> None:
        self.say, self.state, self.began, self.silent_s = say, state, time.monotonic(), silent_s

    def within_s(self, job: Pass, left_s: float) -> float:
        """Tell of the job if that is due; how long the next call may wait, s."""
        waited = self.tell(job.stage, lambda: line(job, self.state))
        return min(left_s, MOST_S, self.silent_s - waited)

    def tell(self, name: str, said: Callable[[], str]) -> float:
        """Say it if that is due; s waited."""
        waited = time.monotonic() - self.began
        if waited >= self.silent_s:
            self.say(name, "waiting", said())
            while self.silent_s <= waited:
                self.silent_s = max(SILENT_S, 2 * self.silent_s)
        return waited


class Heard:
    """Passes progress on, and keeps the last that was said of it."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self.said = progress, ""

    def __call__(self, done: float, total: float, message: str = "") -> None:
        """Report `done` of `total`."""
        self.said = message or (f"{done:g} of {total:g}" if total else self.said)
        self._progress(done, total, message)


def beside(run: Run, audits: str, passes: Iterable[PassName]) -> str:
    """What is at work while audits are waited for: how far these are, and each of some passes behind them that has not ended."""
    from ..stage.tools import latest

    jobs = (latest(run, stage) for stage in passes)
    behind = [job.text().splitlines()[0] for job in jobs if job is not None and not job.ended]
    return "\n".join(
        [f"audits running{f' · {audits}' if audits else ''}", *(f"beside them: {line}" for line in behind)]
    )
