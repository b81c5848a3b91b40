"""What is told of a pass while `go` waits for it, on a terminal or not, and what would make a long one cheaper."""

import time
from collections.abc import Callable
from typing import Protocol

from ..model.plan import law_costs
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
    """

    def __init__(self, say: Callable[[str, str, str], None], state: State) -> None:
        self.say, self.state, self.began, self.silent_s = say, state, time.monotonic(), SILENT_S

    def within_s(self, job: Pass, left_s: float) -> float:
        """Tell of the job if that is due; how long the next call may wait, s."""
        waited = time.monotonic() - self.began
        if waited >= self.silent_s:
            self.say(job.stage, "waiting", line(job, self.state))
            while self.silent_s <= waited:
                self.silent_s *= 2
        return min(left_s, MOST_S, self.silent_s - waited)
