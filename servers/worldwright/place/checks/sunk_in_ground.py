"""Nothing reaches below the ground."""

from ..anchors import shown
from .checked_layout import OVERLAP_M, CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP303 for what does; a warning for scenery, which may be sunk on purpose."""
    for placed in layout.scene.objects:
        low = placed.position[2] - placed.size[2] / 2
        if low < -OVERLAP_M:
            layout.problems.add(
                "WP303",
                "below_ground",
                f"`{placed.name}` reaches {shown(-low)} m below the ground",
                f"raise it: PLACE-ON-BASE puts its lowest point at z = 0 (its centre at {shown(placed.size[2] / 2)} m)",
                layout.path(placed.name),
                severity="warning" if placed.fixed else "error",
            )
