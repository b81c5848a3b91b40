"""Whether a resolved layout holds: one module for each question, all asked of one `Layout`."""

from collections.abc import Callable, Sequence

from ...model.plan import Plan
from ..engine import uncollected
from ..reports import CheckReport
from ..resolution import Resolution
from ..statements import Locate, Problems
from . import (
    below_ground,
    clearance,
    completeness,
    containment,
    density,
    framing,
    image,
    penetration,
    sizes,
    stale,
    start_pose,
    supports,
)
from .layout import Layout
from .marks import flagged

CHECKS: tuple[Callable[[Layout], None], ...] = (
    below_ground.check,
    penetration.check,
    start_pose.check,
    supports.check,
    containment.check,
    clearance.check,
    density.check,
    sizes.check,
    completeness.check,
    image.check,
    stale.check,
    framing.check,
)
"""In the order in which their findings are told."""


def check(
    plan: Plan,
    resolution: Resolution,
    *,
    file: str = "plan.md",
    locate: Locate,
    exact: bool = True,
    only: Sequence[Callable[[Layout], None]] = CHECKS,
) -> CheckReport:
    """Check a resolved layout.

    Args:
        plan: the plan.
        resolution: its layout, with the findings of the resolver (they come first).
        file, locate: where the plan stands.
        exact: measure with the real collision shapes, in a process of its own, where boxes are too coarse: pairs whose
            boxes overlap, clearances, and what cameras see.
        only: which checks to make.
    """
    layout = Layout(plan, resolution, Problems(file, locate), exact)
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
    )


__all__ = ["CHECKS", "Layout", "check", "flagged"]
