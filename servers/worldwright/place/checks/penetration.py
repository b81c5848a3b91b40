"""Nothing is inside anything else: boxes first, then the exact collision shapes of those that overlap."""

from ...model.errors import JobError
from ..anchors import shown
from ..asking import simulate
from .checked_layout import OVERLAP_M, CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP302 for each pair that penetrates by more than a millimetre; parts on joints may overlap each other."""
    held = layout.held
    pairs = [p for p in layout.close if p[2] > OVERLAP_M and not (p[0] in held and p[1] in held)]
    layout.pairs_tested = len(pairs)
    if not pairs:
        return
    if layout.exact:
        names = {name for pair in pairs for name in pair[:2]}
        close = {pair[:2] for pair in pairs}
        try:
            touching = simulate(layout.plan, layout.scene, only=names, loose=True)["contacts"]
        except JobError as error:
            layout.problems.add(
                "WP302", "overlap", f"overlaps could not be tested exactly: {error.cause}", error.next_move
            )
        else:
            pairs = [(a, b, depth) for a, b, depth in touching if (a, b) in close and depth > OVERLAP_M]
    rows_of: dict[str, list[str]] = {}
    for row in layout.resolution.statements:
        rows_of.setdefault(row.subject, []).append(str(row))
    for first, second, depth in pairs:
        rows = [*rows_of.get(first, []), *rows_of.get(second, [])]
        layout.problems.add(
            "WP302",
            "overlap",
            f"`{first}` and `{second}` penetrate each other by {shown(depth)} m",
            f"move one of them by {shown(depth)} m or more: {'; '.join(rows[:4]) or 'see body_positions'}",
            layout.path(second),
        )
