"""The distances that `layout_density.clearance` demands are free."""

from ...model.plan.layout_density import Clearance, read
from ..anchors import shown
from ..asking import RefusedLayoutError, simulate
from .checked_layout import CheckedLayout

Pair = tuple[str, str]


def check(layout: CheckedLayout) -> None:
    """Report WP308 for each pair that is nearer than a clearance allows: boxes first, then the exact collision shapes."""
    _, clearances, _ = read(layout.plan.layout_density)
    for index, clearance in clearances:
        path = ("layout_density", "clearance", index)
        names = clearance.between or (str(clearance.around), *clearance.ignoring)
        unknown = [name for name in names if name not in layout.placed]
        if unknown:
            known = layout.plan.object_names()
            for name in unknown:
                if name not in known:
                    layout.problems.add(
                        "WP320",
                        "unreadable_density",
                        f"there is no object `{name}`",
                        f"known: {', '.join(known)}",
                        path,
                    )
            continue
        near = [p for p in _pairs(layout, clearance) if _gap(layout, p) < clearance.min_m]
        distances = {p: _gap(layout, p) for p in near}
        if near and layout.exact:
            try:
                distances = _exact(layout, near, clearance.min_m)
            except RefusedLayoutError as error:
                layout.problems.add(
                    "WP308", "too_close", f"clearances could not be measured: {error.cause}", error.next_move, path
                )
                continue
        for (first, second), distance in sorted(distances.items(), key=lambda item: item[1]):
            if distance < clearance.min_m:
                layout.problems.add(
                    "WP308",
                    "too_close",
                    f"`{second}` is {shown(round(distance, 4))} m from `{first}`, nearer than {shown(clearance.min_m)} m",
                    f"move it {shown(round(clearance.min_m - distance, 4))} m away, add it to `ignoring`, or demand less",
                    path,
                )


def _pairs(layout: CheckedLayout, clearance: Clearance) -> list[Pair]:
    if clearance.between is not None:
        return [clearance.between]
    centre = str(clearance.around)
    carriers = _below(layout, centre)
    return [
        (centre, name)
        for name in layout.bounds
        if name != centre
        and name not in clearance.ignoring
        and name not in carriers
        and centre not in _below(layout, name)
        and not carriers.intersection(_below(layout, name)) - {"ground"}
    ]


def _below(layout: CheckedLayout, name: str) -> set[str]:
    """The objects on which an object rests, directly or not."""
    found: set[str] = set()
    current = layout.placed[name].supported_by
    while current and current not in found:
        found.add(current)
        current = layout.placed[current].supported_by if current in layout.placed else None
    return found


def _gap(layout: CheckedLayout, pair: Pair) -> float:
    """Distance of two world boxes, metres; 0 when they touch or overlap."""
    (low_a, high_a), (low_b, high_b) = (layout.placed[name].bounds() for name in pair)
    return float(sum(max(low_a[i] - high_b[i], low_b[i] - high_a[i], 0.0) ** 2 for i in range(3)) ** 0.5)


def _exact(layout: CheckedLayout, pairs: list[Pair], far_m: float) -> dict[Pair, float]:
    names = {name for pair in pairs for name in pair}
    result = simulate(layout.plan, layout.scene, only=names, loose=True, pairs=pairs, far_m=far_m)
    return {(a, b): distance for a, b, distance in result["distances"]}
