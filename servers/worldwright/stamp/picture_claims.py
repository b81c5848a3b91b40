"""Claims that are measured in pictures: they wait for the stills, and are measured again when those are drawn."""

from collections.abc import Callable

from ..model.evidence.reports import ExpectReport
from ..model.evidence.run import Run
from .state import State


def measured(run: Run, draw: Callable[[], object]) -> ExpectReport | None:
    """The report of the expectations; where some wait for stills and none is refuted, after drawing those."""
    from ..scan.tools import expect

    report = State(run).expect.value
    if report is None or not report.waits or any(o.status == "refuted" for o in report.objectives):
        return report
    draw()
    expect(str(run.folder))
    return State(run).expect.value
