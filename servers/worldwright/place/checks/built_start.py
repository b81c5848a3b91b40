"""What is built already starts as the layout promised: nothing of it is inside anything else."""

from ..anchors import shown
from .checked_layout import OVERLAP_M, CheckedLayout

SHARE = 0.05
"""Part of the smaller shape's radius that it may be inside: lint allows as much (`WM112`)."""


def check(layout: CheckedLayout) -> None:
    """Report WP326 for each pair of objects that are inside each other at the start of the built world."""
    if layout.built is None:
        return
    names, held = set(layout.placed), layout.held
    found: dict[tuple[str, str], float] = {}
    for one, other, depth, radius in layout.built.contacts:
        first, second = sorted(layout.built.owner(name, names) for name in (one, other))
        inside = first != second and {first, second} & names and not {first, second} <= held
        if inside and depth > max(OVERLAP_M, SHARE * radius, layout.belonging.allowed_m(first, second)):
            found[first, second] = max(found.get((first, second), 0.0), depth)
    layout.at_start.append(f"the built world was looked at too (bundle): {len(layout.built.parents)} bodies")
    for (first, second), depth in found.items():
        layout.problems.add(
            "WP326",
            "overlap_as_built",
            f"in the built world, `{first}` and `{second}` start {shown(round(depth, 4))} m inside each other",
            "build them where the plan resolved them, or move one of them and build again",
            layout.path(second if second in names else first),
        )
