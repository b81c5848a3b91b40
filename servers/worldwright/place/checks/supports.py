"""Nothing floats and nothing hangs over: what is loose stands on something, its centre of mass above what it stands on."""

from collections import defaultdict

from ...model.plan import SceneObject
from ...model.scene import PlacedObject
from ..anchors import TOLERANCE_M, Box, Surface, shown
from ..footprints import area_of, centre_of_mass, clipped, footprint, hull, inset, rows, turned
from .layout import CONTACT_M, Layout

SURE_M = 1e-3
"""How far outside its support a centre of mass must be before the object is said to tip."""


def check(layout: Layout) -> None:
    """WP304 for loose objects that start in mid-air, WP307 for those that tip over the edge of what they stand on."""
    scene_rows = rows(layout.plan)
    below: dict[str, list[str]] = defaultdict(list)
    for first, second, _ in layout.close:
        below[first].append(second)
        below[second].append(first)
    _scenery(layout, below)
    for placed in layout.scene.objects:
        name = placed.name
        if placed.fixed or name in layout.held or name in layout.hidden:
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
                _floats(layout, placed, low)
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
                _floats(layout, placed, low)
            continue
        margin = inset(hull(touching), centre)
        if margin < -SURE_M:
            _tips(layout, placed, [box.name for box, _ in contacts], -margin)


def _own_base(layout: Layout, placed: PlacedObject, row: SceneObject | None) -> None:
    """On the ground only a compound can stand beside its own centre of mass: its parts differ in weight."""
    if row is not None and row.parts:
        margin = inset(footprint(placed, row), centre_of_mass(placed, row, layout.plan))
        if margin < -SURE_M:
            _tips(layout, placed, ["ground"], -margin)


def _scenery(layout: Layout, touching: dict[str, list[str]]) -> None:
    """WP309 for fixed things that hang in the air: neither they nor the fixed things they touch reach the ground."""
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
    """Surfaces of an object at a height."""
    return [(box, s) for s in box.surfaces() if abs(box.low("z") + s.height_m - height) <= CONTACT_M]


def _tips(layout: Layout, placed: PlacedObject, names: list[str], away: float) -> None:
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


def _floats(layout: Layout, placed: PlacedObject, low: float) -> None:
    drop, below = _drop(layout, placed, low)
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


def _drop(layout: Layout, placed: PlacedObject, low: float) -> tuple[float, str]:
    """How far below an object's lowest point the next surface under its centre is, and whose."""
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
