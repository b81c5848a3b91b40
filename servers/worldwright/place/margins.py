"""Measure how well every row holds at the resolved poses, with what it demands beyond the coordinates that it sets."""

from .anchors import TOLERANCE_DEG, TOLERANCE_M, CannotResolveError, shown
from .placement_results import RowMargin
from .resolution import Resolution
from .statements import Problems
from .vocabulary import ask


def measure(resolution: Resolution, problems: Problems) -> list[RowMargin]:
    """The signed margin of each row whose objects are placed; a violated one is reported as WP301."""
    margins = []
    for row in resolution.statements:
        subject, reference = resolution.subject(row), resolution.reference(row)
        if subject is None or reference is None or not resolution.measurable(row):
            continue
        unit = row.entry.UNIT
        try:
            margin = float(ask(row.entry, "holds", subject, reference, row.params))
        except CannotResolveError as error:
            problems.add("WP301", "row_does_not_hold", f"{row.label}: {error}", error.fix, row.path)
            continue
        if margin < 0:
            tolerance = TOLERANCE_DEG if unit == "deg" else TOLERANCE_M
            problems.add(
                "WP301",
                "row_does_not_hold",
                f"{row.label} is violated by {shown(tolerance - margin)} {unit}",
                "change the row, or the rows that set the coordinates it speaks about"
                + (f"; {row.entry.OTHERWISE}" if row.entry.OTHERWISE else ""),
                row.path,
            )
        margins.append(RowMargin(row=row.label, line=row.line, margin=round(margin, 6), unit=unit))
    return margins
