"""Sizes are those of the real things: heights against their category, and related sizes against each other."""

from ...model.plan.committed import AssetRow, SceneObject
from ...model.plan.layout import PlacedObject
from .. import categories
from ..anchors import shown
from ..categories import Category
from .checked_layout import CheckedLayout, others

ABSURD = 3.0
"""No variant of a model from the catalog is outside its category's range by this factor.

What the author builds, of primitives or as a sculpture, is known by its name alone, and that may mislead: the bed of a press, a stove that is a plate.
"""
REACH_M = 0.8
"""A seat nearer to a table than this belongs to it."""
KNEES_M = (0.15, 0.45)
"""The height from a seat to its table's top; 0.23 to 0.30 m is common for meals and desk work, the rest is our judgement."""


def check(layout: CheckedLayout) -> None:
    """Report WP316 for a height that its category does not have, WP317 for a seat that does not fit its table."""
    plan = layout.plan
    alike: dict[tuple[Category, float, bool], list[tuple[str, tuple[str | int, ...]]]] = {}
    heights: list[tuple[SceneObject | AssetRow, float, tuple[str | int, ...]]] = [
        (row, row.extents[2], ("scene_objects", index, "size")) for index, row in enumerate(plan.scene_objects)
    ]
    heights += [
        (asset, plan.asset_dimensions[asset.name], ("asset_dimensions", asset.name))
        for asset in plan.assets
        if asset.name in plan.asset_dimensions
    ]
    heights += [(a, a.size[2], ("assets", index, "size")) for index, a in enumerate(plan.assets) if a.size is not None]
    for row, height, path in heights:
        category = categories.of(row, row.name)
        if category is not None and not category.low_m <= height <= category.high_m:
            known = isinstance(row, AssetRow) and row.type != "sculpt"
            alike.setdefault((category, height, known), []).append((row.name, path))
    for (category, height, known), rows in alike.items():
        _height(layout, rows, category, height, known)
    _seats(layout)


def _height(
    layout: CheckedLayout,
    rows: list[tuple[str, tuple[str | int, ...]]],
    category: Category,
    height: float,
    known: bool,
) -> None:
    """Report one finding for all alike objects."""
    factor = category.low_m / height if height < category.low_m else height / category.high_m
    layout.problems.add(
        "WP316",
        "unlikely_height",
        f"`{rows[0][0]}`{others(rows)} {'are' if rows[1:] else 'is'} {shown(height)} m high; a {category.name} is {shown(category.low_m)} to {shown(category.high_m)} m "
        f"({category.source})",
        "correct its height, or say in its name that it is a `toy`, a `model` or `giant`"
        + ("" if known else ", or what it is if the name means something else"),
        rows[0][1],
        severity="error" if known and factor > ABSURD else "warning",
    )


def _seats(layout: CheckedLayout) -> None:
    kinds = layout.categories
    seats = [o for o in layout.scene.objects if (c := kinds.get(o.name)) and c.kind == "seat" and c.seat_share]
    tables = [o for o in layout.scene.objects if (c := kinds.get(o.name)) and _table(c)]
    for seat in seats:
        low, high = layout.reach(seat, REACH_M)
        near = [t for t in tables if all(t.bounds()[0][i] <= high[i] and t.bounds()[1][i] >= low[i] for i in (0, 1))]
        for table in sorted(near, key=lambda t: _distance(seat, t))[:1]:
            _fits(layout, seat, table, kinds[seat.name])


def _table(category: Category) -> bool:
    return category.kind == "support" and category.head in ("table", "desk", "counter", "bar", "island", "workbench") and (
        category.name not in ("coffee table", "side table", "bedside table", "console table", "pool table")
    )  # fmt: skip


def _distance(a: PlacedObject, b: PlacedObject) -> float:
    return (a.position[0] - b.position[0]) ** 2 + (a.position[1] - b.position[1]) ** 2


def _fits(layout: CheckedLayout, seat: PlacedObject, table: PlacedObject, category: Category) -> None:
    top = table.position[2] + table.size[2] / 2
    floor = seat.position[2] - seat.size[2] / 2
    named = next((s.height_m for s in layout.resolution.boxes[seat.name].surfaces() if s.name == "seat"), None)
    share = category.seat_share or (0.5, 0.5)
    lowest, highest = (named, named) if named is not None else (share[0] * seat.size[2], share[1] * seat.size[2])
    room = (top - floor - highest, top - floor - lowest)
    if room[1] >= KNEES_M[0] and room[0] <= KNEES_M[1]:
        return
    above = room[1] <= 0
    layout.problems.add(
        "WP317",
        "seat_does_not_fit",
        f"the seat of `{seat.name}`, {shown(round(lowest, 3))} m high, is "
        + (
            "not below"
            if above
            else f"{shown(round(max(room[1], 0.0) if room[1] < KNEES_M[0] else room[0], 3))} m below"
        )
        + f" the top of `{table.name}` at {shown(round(top, 3))} m",
        f"between them belong {KNEES_M[0]} to {KNEES_M[1]} m: change one of the two heights in asset_dimensions",
        layout.path(seat.name),
        severity="error" if above else "warning",
    )
