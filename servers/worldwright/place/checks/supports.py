"""Nothing floats or hangs over: loose things stand on something, with their centre of mass above it."""

from collections import defaultdict

from ...model.plan.committed import AssetRow, SceneObject
from ...model.plan.layout import PlacedObject
from ..anchors import TOLERANCE_M, Box, Surface, shown
from ..asking import RefusedLayoutError, simulate, tied
from ..footprints import area_of, centre_of_mass, clipped, footprint, hull, inset, rows, turned
from .checked_layout import CONTACT_M, CheckedLayout

SURE_M = 1e-3
"""An object tips when its centre of mass is outside its support by more than this."""


def check(layout: CheckedLayout) -> None:
    """Report WP304 for loose objects that start in mid-air, WP307 for those that tip over the edge of what they stand on.

    What a declared constraint holds (a pinned cloth) is not loose.
    """
    scene_rows, pinned = rows(layout.plan), tied(layout.plan)
    below: dict[str, list[str]] = defaultdict(list)
    for first, second, _ in layout.close:
        below[first].append(second)
        below[second].append(first)
    _scenery(layout, below)
    floating: dict[str, tuple[PlacedObject, float]] = {}
    for placed in layout.scene.objects:
        name = placed.name
        if placed.fixed or name in layout.held or name in layout.hidden or name in pinned:
            continue
        low = placed.position[2] - placed.size[2] / 2
        row = scene_rows.get(name)
        if low <= CONTACT_M:
            _own_base(layout, placed, row)
            continue
        contacts: list[tuple[Box, Surface]] = []
        for other in below[name]:
            contacts += _planes(layout.resolution.boxes[other], low)
        if not contacts:
            if not placed.supported_by:
                floating[name] = (placed, low)
            continue
        centre = centre_of_mass(placed, row, layout.plan)
        own = footprint(placed, row)
        touching = []
        for box, surface in contacts:
            region = turned(area_of(surface), box.get("x"), box.get("y"), 0.0 if box.round else box.get("yaw"))
            if len(own) == 1:
                touching += own if inset(region, own[0]) >= -TOLERANCE_M else []
            elif all(inset(region, corner) >= -TOLERANCE_M for corner in own):
                touching = own
                break
            else:
                touching += clipped(own, region)
        if not touching:
            if not placed.supported_by:
                floating[name] = (placed, low)
            continue
        margin = inset(hull(touching), centre)
        if margin < -SURE_M:
            _tips(layout, placed, [box.name for box, _ in contacts], -margin)
    measured = _drops(layout, floating)
    for name, (placed, low) in floating.items():
        _floats(layout, placed, *measured.get(name) or _drop(layout, placed, low))


def _own_base(layout: CheckedLayout, placed: PlacedObject, row: SceneObject | None) -> None:
    """Report a compound or a form on the ground that stands beside its own centre of mass: its base may lie aside."""
    if row is not None and (row.parts or row.formed):
        margin = inset(footprint(placed, row), centre_of_mass(placed, row, layout.plan))
        if margin < -SURE_M:
            _tips(layout, placed, ["ground"], -margin)


def _scenery(layout: CheckedLayout, touching: dict[str, list[str]]) -> None:
    """Report WP309 for fixed things in the air: neither they nor the fixed things they touch reach the ground."""
    fixed = {
        o.name: o for o in layout.scene.objects if o.fixed and o.name not in layout.hidden and o.name not in layout.held
    }
    waiting = [n for n, o in fixed.items() if o.position[2] - o.size[2] / 2 <= CONTACT_M]
    held = set(waiting)
    while waiting:
        for other in touching[waiting.pop()]:
            if other in fixed and other not in held:
                held.add(other)
                waiting.append(other)
    for name in fixed.keys() - held:
        placed = fixed[name]
        _, below = _drop(layout, placed, placed.position[2] - placed.size[2] / 2)
        layout.problems.add(
            "WP309",
            "scenery_in_mid_air",
            f"`{name}` is fixed {shown(placed.position[2] - placed.size[2] / 2)} m up, touches nothing that stands, and nothing "
            f"holds it (below it is {below})",
            "put it on or against something fixed (a wall, a post, a ceiling), or add what it hangs from; what is `visual_only` "
            "holds nothing",
            layout.path(name),
            severity="warning",
        )


def _planes(box: Box, height: float) -> list[tuple[Box, Surface]]:
    """The surfaces of an object at a height."""
    return [(box, s) for s in box.surfaces() if abs(box.low("z") + s.height_m - height) <= CONTACT_M]


def _tips(layout: CheckedLayout, placed: PlacedObject, names: list[str], away: float) -> None:
    expected = placed.name in layout.movers
    on = ", ".join(f"`{name}`" for name in dict.fromkeys(names))
    layout.problems.add(
        "WP307",
        "hangs_over",
        f"the centre of mass of `{placed.name}` is {shown(away)} m beyond the edge of what it stands on ({on}): it tips",
        "nothing to do: motion_expectations names it"
        if expected
        else f"move it {shown(away)} m or more towards the middle of its support, or name it in motion_expectations",
        layout.path(placed.name),
        severity="info" if expected else "error",
    )


def _floats(layout: CheckedLayout, placed: PlacedObject, drop: float, below: str) -> None:
    if drop <= TOLERANCE_M:
        return
    expected = placed.name in layout.movers
    layout.problems.add(
        "WP304",
        "unsupported",
        f"`{placed.name}` starts {shown(drop)} m above {below} and falls",
        "nothing to do: motion_expectations names it"
        if expected
        else "name it in motion_expectations if it should fall; else PLACE-ON something, or `fixed: true`",
        layout.path(placed.name),
        severity="info" if expected else "warning",
    )


def _drop(layout: CheckedLayout, placed: PlacedObject, low: float) -> tuple[float, str]:
    """(distance in m, owner) of the next surface below an object's lowest point, under its centre."""
    best, name = 0.0, "the ground"
    x, y, _ = placed.position
    for other, ((x0, y0, z0), (x1, y1, _)) in layout.bounds.items():
        if other == placed.name or not (x0 <= x <= x1 and y0 <= y <= y1) or z0 > low:
            continue
        box = layout.resolution.boxes[other]
        for surface in box.surfaces():
            level = box.low("z") + surface.height_m
            if best < level <= low + TOLERANCE_M and surface.inset(*box.to_own(x, y)) >= 0:
                best, name = level, f"`{other}`"
    return low - best, name


def _drops(layout: CheckedLayout, floating: dict[str, tuple[PlacedObject, float]]) -> dict[str, tuple[float, str]]:
    """The drop of each object over things that are no boxes (hills, stairs, bowls), by their shapes, and onto what."""
    shaped = {n: layout.bounds[n] for n, row in layout.rows.items() if isinstance(row, AssetRow) and n in layout.bounds}
    over = [
        name
        for name in floating
        if any(
            other != name and all(low[i] <= own[1][i] and own[0][i] <= high[i] for i in (0, 1))
            for own in [layout.bounds[name]]
            for other, (low, high) in shaped.items()
        )
    ]
    if not over or not layout.exact:
        return {}
    try:
        told = simulate(layout.plan, layout.scene, falling=over)["drops"]
    except RefusedLayoutError:
        return {}  # what the pre-roll cannot take is told by the checks that cannot do without it
    found = {}
    for name, way, below in told:
        low = floating[name][1]
        found[name] = (way, f"`{below}`") if below is not None and way < low else (low, "the ground")
    return found
