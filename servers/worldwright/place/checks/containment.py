"""What rests inside a container is inside it: its whole footprint between the inner walls."""

from ..anchors import TOLERANCE_M, shown
from ..predicates.place_in import free
from .checked_layout import CONTACT_M, CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP310 for what rests on an inner floor and reaches into a wall; rows of PLACE-IN are measured on their own."""
    own_row = {row.subject for row in layout.resolution.statements if row.entry.INSIDE}
    for placed in layout.scene.objects:
        holder = layout.resolution.boxes.get(placed.supported_by or "")
        if holder is None or placed.name in own_row or placed.name in layout.hidden:
            continue
        inside = next((s for s in holder.surfaces() if s.name == "inside"), None)
        low = placed.position[2] - placed.size[2] / 2
        if inside is None or abs(low - holder.low("z") - inside.height_m) > CONTACT_M or low >= holder.high("z"):
            continue
        margin = free(layout.resolution.boxes[placed.name], holder, inside)
        if margin < -TOLERANCE_M and not _rolls(layout, placed.name):
            layout.problems.add(
                "WP310",
                "not_contained",
                f"`{placed.name}` rests inside `{holder.name}` and reaches {shown(-margin)} m into its wall",
                f"move it {shown(-margin)} m inwards, turn it, or PLACE-ON the `top` of `{holder.name}`",
                layout.path(placed.name),
                severity="error" if layout.resolution.boxes[holder.name].floor_datum else "warning",
            )


def _rolls(layout: CheckedLayout, name: str) -> bool:
    """Whether an object is a ball: in a bowl it touches the narrowing wall and finds its place."""
    return layout.resolution.boxes[name].round and name in layout.movers
