"""Check a resolved layout: one module per question, all asked of one `CheckedLayout`."""

from collections.abc import Callable, Sequence

from ...model.plan.committed import Plan
from ..built_world import BuiltWorld
from ..engine import uncollected
from ..placement_results import CheckReport
from ..resolution import Resolution
from ..statements import Locate, Problems
from . import (
    built_start,
    clearance,
    completeness,
    containment,
    density,
    filled,
    framing,
    frictions,
    image,
    penetration,
    sizes,
    stale,
    start_pose,
    sunk_in_ground,
    supports,
)
from .checked_layout import CheckedLayout
from .marks import flagged

CHECKS: tuple[Callable[[CheckedLayout], None], ...] = (
    sunk_in_ground.check,
    penetration.check,
    start_pose.check,
    built_start.check,
    supports.check,
    containment.check,
    filled.check,
    clearance.check,
    density.check,
    sizes.check,
    completeness.check,
    image.check,
    stale.check,
    framing.check,
    frictions.check,
)
"""The checks, in the order of their findings."""


def check(
    plan: Plan,
    resolution: Resolution,
    *,
    file: str = "plan.md",
    locate: Locate,
    exact: bool = True,
    only: Sequence[Callable[[CheckedLayout], None]] = CHECKS,
    built: BuiltWorld | None = None,
) -> CheckReport:
    """Check a resolved layout.

    Args:
        plan: the plan.
        resolution: its layout, with the findings of the resolver (they come first).
        file, locate: the plan's file, and the line of a path in it.
        exact: measure with the real collision shapes, in a process of its own, what boxes are too coarse for: pairs whose
            boxes overlap, clearances, and what cameras see.
        only: the checks to make.
        built: what its program has built of it already.
    """
    layout = CheckedLayout(plan, resolution, Problems(file, locate), exact, built=built)
    with uncollected():
        for one in only:
            one(layout)
    return CheckReport(
        objects=len(resolution.scene.objects),
        rows=len({row.path for row in resolution.statements}),
        pairs_tested=layout.pairs_tested,
        findings=(*resolution.scene.findings, *layout.problems.findings),
        margins=tuple(sorted((*resolution.margins, *layout.margins), key=lambda m: m.margin)),
        at_start=tuple(layout.at_start),
        views=tuple(layout.views),
        smallest=layout.smallest,
    )


__all__ = ["CHECKS", "CheckedLayout", "check", "flagged"]
