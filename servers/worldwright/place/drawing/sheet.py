"""Draw the whole sheet: title, views from above and from the side on one scale, and what is wrong."""

import numpy as np

from ...model.finding import Finding
from ...model.plan.committed import Plan
from ...model.plan.layout import PlacedObject, Scene
from ...model.plan.plan_references import WITH_PARTS
from ..anchors import cos_sin
from ..checks import flagged
from ..extents import fixed_objects
from ..resolution import Resolution
from ..start import motions, way
from ..vocabulary import BASE
from . import palette
from .canvas import Canvas, Colour, text_width
from .families import stem
from .labels import Note, Rect
from .lenses import cameras
from .movement import joints, start_pose, tendons, velocities
from .panel import View, metres
from .silhouettes import Silhouette, silhouette

WIDTH = 1600
_LEFT, _RIGHT, _HEAD, _BETWEEN = 76, 40, 138, 84
_TALLEST = (900, 760)  # pixels: the two panels one above the other
WIDE = 1.3
"""Scenes wider (y) than deep (x) by this factor are seen from the front."""
_ROOM = 78  # pixels around the objects, for names


def sheet(plan: Plan, resolution: Resolution, findings: tuple[Finding, ...]) -> bytes:
    """Draw a layout as PNG.

    Args:
        plan: the plan (titles, shapes, initial motion).
        resolution: the layout.
        findings: they are marked, errors in red, warnings in amber.
    """
    scene = resolution.scene
    shapes = {o.name: silhouette(plan, o) for o in scene.objects}
    lines = _findings(findings, WIDTH - _LEFT - _RIGHT)
    low, high = _bounds(scene, plan)
    span = (high[0] - low[0], high[1] - low[1], high[2] - low[2])
    across = 1 if span[1] > WIDE * span[0] else 0  # the axis across the second view: x from -Y, y from +X
    panels, scale = _panels((max(span[0], span[across]), span[1], span[2]))
    bottom = max(panel[3] for panel in panels)
    canvas = Canvas(WIDTH, round(bottom) + 88 + 24 * len(lines), palette.PAPER)
    middle = tuple((a + b) / 2 for a, b in zip(low, high, strict=True))
    top = View(canvas, panels[0], scale, (middle[0], middle[1]))
    side = View(canvas, panels[1], scale, (middle[across], middle[2]), (across, 2))
    marks = flagged(findings, [o.name for o in scene.objects])
    _head(canvas, plan, scene)
    unnamed = _draw_top(top, plan, scene, shapes, marks)
    unnamed = max(unnamed, _draw_side(side, plan, scene, shapes, marks, resolution, across))
    if unnamed:
        note = f"{unnamed} names left out for want of room"
        canvas.text(note, (WIDTH - _RIGHT - text_width(note, 14), _HEAD - 38), 14, palette.QUIET)
    _foot(canvas, bottom + 62, lines, plan)
    return canvas.png()


def _panels(span: tuple[float, float, float]) -> tuple[tuple[Rect, Rect], float]:
    """The two panels and their common scale: one above the other, or side by side if that shows things larger."""
    inner = WIDTH - _LEFT - _RIGHT
    stacked = min(
        (inner - 2 * _ROOM) / span[0],
        (_TALLEST[0] - 2 * _ROOM) / span[1],
        (_TALLEST[1] - 2 * _ROOM) / span[2],
    )
    column = (inner - _BETWEEN) / 2
    beside = min((column - 2 * _ROOM) / span[0], (960 - 2 * _ROOM) / max(span[1], span[2]))
    if beside > 1.15 * stacked:
        bottom = _HEAD + max(360, round(max(span[1], span[2]) * beside) + 2 * _ROOM)
        middle = _LEFT + column
        return ((_LEFT, _HEAD, middle, bottom), (middle + _BETWEEN, _HEAD, WIDTH - _RIGHT, bottom)), beside
    tall = [max(260, round(extent * stacked) + 2 * _ROOM) for extent in span[1:]]
    first, second = _HEAD + tall[0], _HEAD + tall[0] + _BETWEEN
    return ((_LEFT, _HEAD, WIDTH - _RIGHT, first), (_LEFT, second, WIDTH - _RIGHT, second + tall[1])), stacked


def _bounds(scene: Scene, plan: Plan | None = None) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The space to show, m: every object (with a plan, also at its start), the ground, and at least a few centimetres."""
    boxes = [o.bounds() for o in scene.objects] or [((-0.5, -0.5, 0.0), (0.5, 0.5, 0.5))]
    if plan is not None:
        for name, motion in motions(plan, scene).items():
            outlines = silhouette(plan, scene[name], motion)
            flat, upright = np.concatenate(outlines.top), np.concatenate(outlines.side)
            x, y, z = flat[:, 0], flat[:, 1], upright[:, 1]
            boxes.append(((x.min(), y.min(), z.min()), (x.max(), y.max(), z.max())))
        for tendon in plan.topology.tendons:
            boxes += [(point, point) for point in way(plan, scene, tendon) or ()]
    low = [min(b[0][i] for b in boxes) for i in range(3)]
    high = [max(b[1][i] for b in boxes) for i in range(3)]
    low[2] = min(low[2], 0.0)
    for i in range(3):
        short = max(0.05 - (high[i] - low[i]), 0.0)
        low[i], high[i] = low[i] - short / 2, high[i] + short / 2
    return tuple(low), tuple(high)


def _colours(plan: Plan, scene: Scene) -> dict[str, tuple[Colour, Colour]]:
    """Fill and outline by object: scenery is sand, things have the colour of their family."""
    fixed = set(fixed_objects(plan))
    colours: dict[str, tuple[Colour, Colour]] = {}
    families: dict[str, int] = {}
    for placed in scene.objects:
        if placed.name in fixed:
            colours[placed.name] = (palette.SCENERY, palette.SCENERY_EDGE)
        else:
            number = families.setdefault(stem(placed.name), len(families))
            colour = palette.THINGS[number % len(palette.THINGS)]
            colours[placed.name] = (colour, palette.edge(colour))
    return colours


def _head(canvas: Canvas, plan: Plan, scene: Scene) -> None:
    title = plan.title or "Layout"
    while text_width(title, 28, 700) > WIDTH - _LEFT - _RIGHT:
        title = title[:-2].rstrip() + "…"
    canvas.text(title, (_LEFT, 52), 28, palette.TEXT, 700)
    (x0, y0, _), (x1, y1, z1) = _bounds(scene)
    count = len(scene.objects)
    words = f"{count} object{'s' * (count != 1)} in {x1 - x0:.2f} × {y1 - y0:.2f} × {z1:.2f} m"
    canvas.text(words, (_LEFT, 78), 15, palette.QUIET)


def _draw(
    view: View,
    items: list[PlacedObject],
    polygons: dict[str, list[np.ndarray]],
    plan: Plan,
    scene: Scene,
    marks: dict[str, str],
    *,
    fronts: bool = False,
) -> None:
    """Draw objects, the later ones over the earlier."""
    colours = _colours(plan, scene)
    for placed in items:
        fill, outline = colours[placed.name]
        mark = marks.get(placed.name)
        if mark:
            outline = palette.ERROR if mark == "error" else palette.WARNING
        view.shape(polygons[placed.name], fill, outline, 0.88, 2.6 if mark else 1.4)
        if fronts and not placed.round:
            _front(view, placed)


def _draw_top(view: View, plan: Plan, scene: Scene, shapes: dict[str, Silhouette], marks: dict[str, str]) -> int:
    """Draw the view from above, with fronts and initial motion."""
    view.paper("From above", ("x", "y"), ("front", "left"))
    order = sorted(scene.objects, key=lambda o: (o.bounds()[1][2], o.name))
    polygons = {name: s.top for name, s in shapes.items()}
    _draw(view, order, polygons, plan, scene, marks, fronts=True)
    taken = [view.scale_bar()]
    notes = [*_mechanics(view, plan, scene), *cameras(view, plan, scene)]
    boxes = {o.name: view.extent(polygons[o.name]) for o in order}
    for name, mark in marks.items():
        _badge(view, boxes[name], mark)
    return view.names(boxes, taken, marks, notes, _models(plan))


def _models(plan: Plan) -> dict[str, str]:
    """Words for model files, sculptures and vehicles, which are drawn as boxes, by instance: the type, and the row if its name differs."""
    return {
        name: row.type if name == row.name else f"{row.type} {row.name}"
        for row in plan.assets
        if row.type in WITH_PARTS
        for name in row.instances
    }


def _mechanics(view: View, plan: Plan, scene: Scene) -> list[Note]:
    """Draw what moves and what holds over the objects."""
    start_pose(view, plan, scene)
    return [*tendons(view, plan, scene), *joints(view, plan, scene), *velocities(view, plan, scene)]


def _front(view: View, placed: PlacedObject) -> None:
    """Draw an arrow to the middle of the object's front face."""
    c, s = cos_sin(placed.deg_z)
    reach = placed.size[0] / 2
    length = min(max(0.5 * reach, 13 / view.scale), 30 / view.scale)
    x, y, _ = placed.position
    start = view.pixel(x + (reach - length) * c, y + (reach - length) * s)
    end = view.pixel(x + reach * c, y + reach * s)
    if placed.fixed:
        view.canvas.arrow(start, end, palette.SCENERY_EDGE, 1.6, 9)
        return
    view.canvas.arrow(start, end, palette.PANEL, 3.4, 10)
    view.canvas.arrow(start, end, palette.TEXT, 1.6, 8)


def _draw_side(view: View, plan: Plan, scene: Scene, shapes: dict[str, Silhouette], marks: dict[str, str],
            resolution: Resolution, across: int) -> int:  # fmt: skip
    """Draw the view from the right side (-Y) or the front (+X), with the ground and what will drop."""
    if across:
        view.paper("From the front (from +X)", ("y", "z"), ("left", "up"))
    else:
        view.paper("From the side (from −Y)", ("x", "z"), ("front", "up"))
    x0, _, x1, y1 = view.panel
    ground = view.pixel(0, 0)[1]
    view.canvas.rectangle((x0, ground), (x1, y1), palette.GROUND)
    view.canvas.line((x0, ground), (x1, ground), palette.SCENERY_EDGE, 1.6)
    order = sorted(scene.objects, key=lambda o: (o.bounds()[1][0] if across else -o.bounds()[0][1], o.name))
    polygons = {name: s.front if across else s.side for name, s in shapes.items()}
    _draw(view, order, polygons, plan, scene, marks)
    taken = [view.scale_bar()]
    notes = _mechanics(view, plan, scene)
    for row in resolution.statements:
        drop = row.params.get(row.entry.DROP, 0.0)
        loose = row.subject in shapes and not scene[row.subject].fixed
        if drop and loose and (row.entry.SUPPORTS or row.reference == BASE):
            taken += _drop(view, scene[row.subject], float(drop), across)
    boxes = {o.name: view.extent(polygons[o.name]) for o in order}
    for name, mark in marks.items():
        _badge(view, boxes[name], mark)
    return view.names(boxes, taken, marks, notes, _models(plan))


def _drop(view: View, placed: PlacedObject, drop: float, across: int) -> list[Rect]:
    """Draw a dashed arrow from the lowest point to where the fall ends; returns the space of its number."""
    low = placed.bounds()[0][2]
    start, end = view.pixel(placed.position[across], low), view.pixel(placed.position[across], low - drop)
    if end[1] - start[1] < 14:
        return []
    view.canvas.dashes(start, end, palette.MOTION, 1.6)
    view.canvas.arrow((end[0], end[1] - 9), end, palette.MOTION, 1.6, 8)
    if end[1] - start[1] < 40:  # no room for a number beside it
        return []
    words = f"{metres(drop, 0.01)} m"
    x, y = start[0] + 8, (start[1] + end[1]) / 2 + 5
    view.canvas.text(words, (x, y), 14, palette.MOTION, 500)
    return [(x - 3, y - 14, x + text_width(words, 14, 500) + 3, y + 4)]


def _badge(view: View, box: Rect, mark: str) -> None:
    """Draw an exclamation mark at the corner of an object with a finding."""
    colour = palette.ERROR if mark == "error" else palette.WARNING
    view.canvas.dot((box[2], box[1]), 8.5, colour)
    view.canvas.text("!", (box[2] - 2, box[1] + 5), 15, palette.PANEL, 800)


def _findings(findings: tuple[Finding, ...], width: int) -> list[tuple[str, Colour, int]]:
    """Lines of text about what is marked: at most eight findings, wrapped."""
    told = sorted((f for f in findings if f.severity != "info"), key=lambda f: f.severity != "error")
    lines: list[tuple[str, Colour, int]] = []
    for finding in told[:8]:
        colour = palette.ERROR if finding.severity == "error" else palette.WARNING
        where = f"line {finding.line}: " if finding.line else ""
        words = f"{finding.code} {where}{finding.message}".split()
        line = ""
        for word in words:
            if line and text_width(f"{line} {word}", 15) > width:
                lines.append((line, colour, 400))
                line = "     " + word
            else:
                line = f"{line} {word}".lstrip() if not line.startswith("     ") else f"{line} {word}"
        lines.append((line, colour, 400))
    if len(told) > 8:
        lines.append((f"… and {len(told) - 8} more: worldwright place check", palette.QUIET, 400))
    return lines


def _foot(canvas: Canvas, y: float, lines: list[tuple[str, Colour, int]], plan: Plan) -> None:
    if not lines:
        rows = len(plan.topology.scene_predicates) + len(plan.geometry_relations)
        canvas.text(f"No problems: all {rows} rows hold", (_LEFT, y), 15, palette.GOOD, 500)
    for index, (words, colour, weight) in enumerate(lines):
        canvas.text(words, (_LEFT, y + 24 * index), 15, colour, weight)
