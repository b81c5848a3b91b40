"""The scene is as full as `layout_density` wants it."""

from collections import defaultdict

from ...model.plan.committed import SceneObject
from ...model.plan.layout import PlacedObject
from ...model.plan.layout_density import CLEARANCE, SCENE, Target, read
from ..anchors import TOLERANCE_M, shown
from ..footprints import area, area_of, shadow
from .checked_layout import CONTACT_M, CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP320 for a target that cannot be read, WP315 for one that is missed."""
    section = layout.plan.layout_density
    targets, _, wrong = read(section)
    for path, cause in wrong:
        layout.problems.add("WP320", "unreadable_density", cause, "see skills/layouts/SKILL.md, `layout_density`", path)
    if not targets:
        return
    carried = _carried(layout)
    for name, target in targets.items():
        if name == SCENE:
            _scene(layout, target)
        elif name in layout.placed:
            _surface(layout, name, target, carried)
        elif name != CLEARANCE and name not in layout.plan.object_names():
            layout.problems.add(
                "WP320",
                "unreadable_density",
                f"there is no object `{name}`",
                f"name an object, `{SCENE}` or `{CLEARANCE}`",
                ("layout_density", name),
            )


def kind_of(layout: CheckedLayout, placed: PlacedObject) -> str:
    """The kind of an object: its catalog key, or its shape, role and size."""
    row = layout.rows.get(placed.name)
    if isinstance(row, SceneObject):
        return f"{row.primitive} {row.role} {row.size}"
    return placed.kind


def _carried(layout: CheckedLayout) -> dict[str, list[str]]:
    """The objects that rest directly on each object."""
    found: dict[str, list[str]] = defaultdict(list)
    for placed in layout.scene.objects:
        if placed.supported_by:
            found[placed.supported_by].append(placed.name)
    return found


def _all_on(name: str, carried: dict[str, list[str]]) -> list[str]:
    found: list[str] = []
    waiting = list(carried.get(name, ()))
    while waiting:
        current = waiting.pop()
        if current not in found:
            found.append(current)
            waiting += carried.get(current, ())
    return found


def _count(layout: CheckedLayout, where: str, names: list[str], target: Target, path: tuple[str | int, ...]) -> None:
    count, kinds = len(names), len({kind_of(layout, layout.placed[n]) for n in names})
    if target.min_objects is not None and count < target.min_objects:
        _report_missed(layout, f"{where} has {count} objects, fewer than {target.min_objects}", "add more", path)
    if target.max_objects is not None and count > target.max_objects:
        _report_missed(layout, f"{where} has {count} objects, more than {target.max_objects}", "take some away", path)
    if target.min_kinds is not None and kinds < target.min_kinds:
        _report_missed(
            layout, f"{where} has {kinds} kinds of objects, fewer than {target.min_kinds}", "add other kinds", path
        )


def _fill(
    layout: CheckedLayout, where: str, names: list[str], free_m2: float, target: Target, path: tuple[str | int, ...]
) -> None:
    if target.min_fill is None and target.max_fill is None:
        return
    covered = 0.0
    for name in names:
        placed = layout.placed[name]
        row = layout.rows.get(name)
        covered += area(shadow(placed, row if isinstance(row, SceneObject) else None))
    fill = covered / free_m2 if free_m2 > 0 else 0.0
    if target.min_fill is not None and fill < target.min_fill:
        _report_missed(
            layout,
            f"{where} is filled by {fill:.1%}, less than {target.min_fill:.1%}",
            "add more or larger things",
            path,
        )
    if target.max_fill is not None and fill > target.max_fill:
        _report_missed(
            layout, f"{where} is filled by {fill:.1%}, more than {target.max_fill:.1%}", "take some away", path
        )


def _scene(layout: CheckedLayout, target: Target) -> None:
    path = ("layout_density", SCENE)
    names = [o.name for o in layout.scene.objects]
    _count(layout, "the scene", names, target, path)
    if not names:
        return
    bounds = [o.bounds() for o in layout.scene.objects]
    low = [min(b[0][i] for b in bounds) for i in range(3)]
    high = [max(b[1][i] for b in bounds) for i in range(3)]
    extents = target.area or (high[0] - low[0], high[1] - low[1])
    ground = [o.name for o in layout.scene.objects if o.position[2] - o.size[2] / 2 <= CONTACT_M]
    _fill(layout, "the ground", ground, extents[0] * extents[1], target, path)
    if target.envelope is None:
        return
    limits = (target.envelope[0] / 2, target.envelope[1] / 2, target.envelope[2])
    for placed, (corner, other) in zip(layout.scene.objects, bounds, strict=True):
        out = max(
            -corner[0] - limits[0],
            other[0] - limits[0],
            -corner[1] - limits[1],
            other[1] - limits[1],
            other[2] - limits[2],
        )
        if out > TOLERANCE_M:
            _report_missed(
                layout,
                f"`{placed.name}` reaches {shown(out)} m out of the envelope {list(target.envelope)}",
                "move it inwards, or enlarge the envelope",
                layout.path(placed.name),
            )


def _surface(layout: CheckedLayout, name: str, target: Target, carried: dict[str, list[str]]) -> None:
    path = ("layout_density", name)
    box = layout.resolution.boxes[name]
    try:
        surface = box.surface(target.surface)
    except KeyError as error:
        layout.problems.add("WP320", "unreadable_density", str(error.args[0]), "name one of its surfaces", path)
        return
    level = box.low("z") + surface.height_m
    direct = carried.get(name, [])
    if target.surface is not None:
        direct = [n for n in direct if abs(layout.resolution.boxes[n].low("z") - level) <= CONTACT_M]
    names = list(direct) + [m for n in direct for m in _all_on(n, carried)]
    _count(layout, f"`{name}`", list(dict.fromkeys(names)), target, path)
    _fill(layout, f"`{name}`", direct, area(area_of(surface)), target, path)


def _report_missed(layout: CheckedLayout, cause: str, fix: str, path: tuple[str | int, ...]) -> None:
    layout.problems.add("WP315", "density_missed", cause, f"{fix}, or change the target in layout_density", path)
