"""Place names so that all can be read: inside their object, or beside it on a thin leader, never on one another."""

import math
from dataclasses import dataclass
from itertools import pairwise

from .canvas import Colour

Rect = tuple[float, float, float, float]
"""x0, y0, x1, y1 in pixels, y down."""
_DISTANCES = (5.0, 14.0, 26.0, 42.0, 62.0, 88.0, 120.0, 160.0)
_DIRECTIONS = (
    (1, 0),
    (-1, 0),
    (0, -1),
    (0, 1),
    (1, -1),
    (-1, -1),
    (1, 1),
    (-1, 1),
    (0.5, -1),
    (-0.5, -1),
    (0.5, 1),
    (-0.5, 1),
)


@dataclass(frozen=True)
class Item:
    """One object to be named: the pixels it covers, and the size of its label."""

    name: str
    box: Rect
    width: float
    height: float


@dataclass(frozen=True)
class Note:
    """Words about a mark, and the pixels that it covers."""

    words: str
    box: Rect
    colour: Colour
    ink: tuple[Rect, ...] = ()
    """Rectangles that no label may cover."""


@dataclass(frozen=True)
class Label:
    """A placed label; `leader` is the line from the label to an object that it stands away from."""

    name: str
    box: Rect
    leader: tuple[tuple[float, float], tuple[float, float]] | None


def inked(*points: tuple[float, float], half: float = 4.0) -> tuple[Rect, ...]:
    """Small boxes along a line through points, for labels to keep clear of."""
    found: list[Rect] = []
    for (x0, y0), (x1, y1) in pairwise(points):
        count = max(1, round(math.hypot(x1 - x0, y1 - y0) / (2 * half)))
        for k in range(count + 1):
            x, y = x0 + (x1 - x0) * k / count, y0 + (y1 - y0) * k / count
            found.append((x - half, y - half, x + half, y + half))
    return tuple(found)


def arrange(items: list[Item], panel: Rect, taken: list[Rect]) -> tuple[list[Label], list[str]]:
    """Place labels greedily, small objects first.

    Args:
        items: the objects to name.
        panel: the rectangle in which labels stay.
        taken: rectangles that no label may cover.

    Returns:
        the labels, and the names for which there was no room.
    """
    placed: list[Label] = []
    left: list[str] = []
    boxes = [item.box for item in items]
    leaders: list[tuple[tuple[float, float], tuple[float, float]]] = []
    for item in sorted(items, key=lambda i: _area(i.box)):
        best: tuple[float, Rect] | None = None
        for cost, box in _candidates(item):
            if best is not None and cost >= best[0]:
                continue
            if not _inside(box, panel) or any(_overlap(box, other) for other in taken):
                continue
            if any(_overlap(box, label.box) for label in placed) or any(_crosses(line, box) for line in leaders):
                continue
            covered = sum(
                _overlap(box, other) / max(_area(box), 1)
                for other in boxes
                if other != item.box and not _inside(item.box, other)
            )
            # to stand on a larger thing (the table below the plate) costs little
            covered += 0.15 * sum(_overlap(box, other) > 0 for other in boxes if _inside(item.box, other))
            line = _leader(box, item.box)
            if line is not None and any(_crosses(line, label.box) for label in placed):
                continue
            total = cost + 60 * covered
            if best is None or total < best[0]:
                best = (total, box)
        if best is None:
            left.append(item.name)
            continue
        line = _leader(best[1], item.box)
        if line is not None:
            leaders.append(line)
        placed.append(Label(item.name, best[1], line))
    return placed, left


def _candidates(item: Item) -> list[tuple[float, Rect]]:
    """Places for a label with their cost: the middle, the corners inside, then around at growing distances."""
    x0, y0, x1, y1 = item.box
    w, h = item.width, item.height
    found: list[tuple[float, Rect]] = []
    if x1 - x0 >= w + 6 and y1 - y0 >= h + 6:
        spots = [((x0 + x1 - w) / 2, (y0 + y1 - h) / 2, 0.0)]
        spots += [(x, y, 3.0) for x in (x0 + 5, x1 - w - 5) for y in (y0 + 5, y1 - h - 5)]
        steps = 6
        spots += [
            (x0 + 5 + (x1 - x0 - w - 10) * i / steps, y0 + 5 + (y1 - y0 - h - 10) * j / steps, 6.0)
            for i in range(steps + 1)
            for j in range(steps + 1)
        ]
        found += [(cost, (x, y, x + w, y + h)) for x, y, cost in spots]
    cx, cy = (x0 + x1) / 2, (y0 + y1) / 2
    for distance in _DISTANCES:
        for dx, dy in _DIRECTIONS:
            x = cx + dx * ((x1 - x0) / 2 + distance) + (dx - 1) * w / 2
            y = cy + dy * ((y1 - y0) / 2 + distance) + (dy - 1) * h / 2
            found.append((distance + 2 * (dx != 0 and dy != 0), (x, y, x + w, y + h)))
    return found


def _leader(label: Rect, box: Rect) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """A line from the label's edge into the object, unless they already touch."""
    cx, cy = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    start = (min(max(cx, label[0]), label[2]), min(max(cy, label[1]), label[3]))
    edge = (min(max(start[0], box[0]), box[2]), min(max(start[1], box[1]), box[3]))
    if (edge[0] - start[0]) ** 2 + (edge[1] - start[1]) ** 2 < 64:
        return None
    reach = 0.55  # to a point surely on the object, not only in its box
    return start, (edge[0] + (cx - edge[0]) * reach, edge[1] + (cy - edge[1]) * reach)


def _area(box: Rect) -> float:
    return max(box[2] - box[0], 0) * max(box[3] - box[1], 0)


def _overlap(a: Rect, b: Rect) -> float:
    width, height = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return width * height if width > 0 and height > 0 else 0.0


def _inside(inner: Rect, outer: Rect) -> bool:
    return inner[0] >= outer[0] and inner[1] >= outer[1] and inner[2] <= outer[2] and inner[3] <= outer[3]


def _crosses(line: tuple[tuple[float, float], tuple[float, float]], box: Rect) -> bool:
    """Whether a segment meets a rectangle (Liang and Barsky's clipping)."""
    (x0, y0), (x1, y1) = line
    low, high = 0.0, 1.0
    for p, q in ((x0 - x1, x0 - box[0]), (x1 - x0, box[2] - x0), (y0 - y1, y0 - box[1]), (y1 - y0, box[3] - y0)):
        if p == 0:
            if q < 0:
                return False
        elif p < 0:
            low = max(low, q / p)
        else:
            high = min(high, q / p)
    return low < high
