"""Draw where cameras stand, seen from above: a wedge as wide as the picture, at its place or at the edge of the paper.

A view's camera is framed when the world runs; until then only its direction is known, and the wedge is at the edge.
"""

import math

import numpy as np

from ...model.plan.committed import Plan
from ...model.plan.implementation_steps import CameraRow
from ...model.plan.layout import Scene
from . import palette
from .canvas import Point
from .labels import Note
from .panel import View

INSET = 14.0
STRAIGHT_DOWN_DEG = 80.0


def cameras(view: View, plan: Plan, scene: Scene) -> list[Note]:
    """Draw a wedge for each camera that does not look straight down."""
    x0, y0, x1, y1 = view.panel
    width, height = plan.recording_mode.size
    notes: list[Note] = []
    taken: list[Point] = []
    for row in plan.cameras():
        pose = _pose(row, scene)
        if pose is None:
            continue
        eye, back = pose
        at = view.pixel(*eye) if eye is not None else None
        if at is None or not (x0 + INSET < at[0] < x1 - INSET and y0 + INSET < at[1] < y1 - INSET):
            at = _edge(view, back)
        while any(math.dist(at, other) < 24 for other in taken):  # cameras with one direction
            at = (at[0] - 26 * back[1], at[1] - 26 * back[0])
        taken.append(at)
        half = math.atan(width / height * math.tan(math.radians(row.fovy) / 2))
        tips = [_towards(at, back, turn, 34.0) for turn in (half, -half)]
        view.canvas.fill([np.array([at, *tips])], palette.LENS, 0.18)
        for tip in tips:
            view.canvas.line(at, tip, palette.LENS, 1.3)
        view.canvas.dot(at, 4.0, palette.LENS)
        xs, ys = zip(at, *tips, strict=True)
        box = (min(xs), min(ys), max(xs), max(ys))
        notes.append(Note(f"{row.name} {row.fovy:g}°", box, palette.LENS, (box,)))
    return notes


def _pose(row: CameraRow, scene: Scene) -> tuple[tuple[float, float] | None, tuple[float, float]] | None:
    """(its place from above, None if not yet known; the unit vector from its target to it)."""
    from worldkit.cameras.views import VIEWS

    placed = next((camera for camera in scene.cameras if camera.name == row.name), None)
    eye = placed.position if placed else row.position
    target = placed.target if placed else row.target
    if eye is not None:
        x, y = (eye[i] - (target[i] if target else _middle(scene)[i]) for i in range(2))
        flat = math.hypot(x, y)
        high = abs(eye[2] - (target[2] if target else 0.0))
        if flat < 1e-9 or math.degrees(math.atan2(high, flat)) > STRAIGHT_DOWN_DEG:
            return None
        return (eye[0], eye[1]), (x / flat, y / flat)
    view = VIEWS.get(row.view or "perspective")
    if view is None or view.elevation_deg > STRAIGHT_DOWN_DEG:
        return None
    azimuth = math.radians(view.azimuth_deg)
    return None, (math.cos(azimuth), math.sin(azimuth))


def _middle(scene: Scene) -> tuple[float, float]:
    boxes = [o.bounds() for o in scene.objects] or [((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))]
    low, high = ([pick(b[side][i] for b in boxes) for i in range(2)] for side, pick in ((0, min), (1, max)))
    return (low[0] + high[0]) / 2, (low[1] + high[1]) / 2


def _edge(view: View, back: tuple[float, float]) -> Point:
    """The point where a ray from the middle of the panel meets its inner edge."""
    x0, y0, x1, y1 = view.panel
    cx, cy = (x0 + x1) / 2, (y0 + y1) / 2
    reach = min(
        ((x1 - x0) / 2 - INSET) / max(abs(back[0]), 1e-9),
        ((y1 - y0) / 2 - INSET) / max(abs(back[1]), 1e-9),
    )
    return cx + back[0] * reach, cy - back[1] * reach


def _towards(at: Point, back: tuple[float, float], turn: float, length: float) -> Point:
    angle = math.atan2(-back[1], -back[0]) + turn
    return at[0] + length * math.cos(angle), at[1] - length * math.sin(angle)
