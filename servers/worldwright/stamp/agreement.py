"""Whether two measurements of the same claims agree: what was reported or stamped, and what a new run of the world shows."""

from collections.abc import Iterator, Mapping, Sequence

from ..model.evidence.reports import ExpectReport

SAME, ALIKE = 1e-6, 0.1
"""Share of a measured number by which it may differ: where the motion is the same bit for bit, and on other processors."""
LEAST = 0.1
"""The smallest number, in its unit, of which a share is taken."""

Measured = tuple[int, str, str, float | None, float | None]
"""An expectation: its objective, name, status, measured number and margin."""


def statuses(report: ExpectReport) -> dict[int, str]:
    """The status of every objective by its index."""
    return {o.index: o.status for o in report.objectives}


def numbers(report: ExpectReport) -> list[Measured]:
    """What every expectation of every objective measures, in the report's order."""
    return [(o.index, e.name, e.status, e.measured, e.margin) for o in report.objectives for e in o.expectations]


def other_statuses(said: Mapping[int, str], now: Mapping[int, str], origin: str = "stamped") -> Iterator[str]:
    """A sentence for each objective whose status is another one now; `origin` says what `said` is."""
    for index in sorted({*said, *now}):
        if said.get(index) != now.get(index):
            yield f"objective {index} is {now.get(index, 'none of the plan')} ({origin} {said.get(index, 'absent')})"


def other_numbers(
    said: Sequence[Measured], now: Sequence[Measured], slack: float, origin: str = "stamped"
) -> Iterator[str]:
    """A sentence for each expectation whose number differs now by more than `slack` of it (of 0.1, where it is smaller)."""
    if len(said) != len(now):
        yield f"{len(now)} expectations are measured ({origin} {len(said)})"
        return
    for (index, name, status, *before), (i, n, new, *after) in zip(said, now, strict=True):
        if (index, name, status) != (i, n, new):
            yield f"{n} of objective {i} is {new} ({origin} {name} of objective {index}: {status})"
            continue
        for verb, a, b in zip(("measures", "has the margin"), before, after, strict=True):
            scale = max(LEAST, *(abs(number) for number in after if number is not None))
            if not _close(a, b, slack * scale):
                yield f"{n} of objective {i} {verb} {b} ({origin} {a})"
                break


def _close(before: float | None, after: float | None, slack: float) -> bool:
    if before is None or after is None:
        return before is after
    return abs(before - after) <= slack
