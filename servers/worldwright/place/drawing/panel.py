"""One view of the layout: a panel of paper with a grid in metres, on which objects are drawn in order."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...model.plan.scene_objects import Vec3
from . import palette
from .canvas import Canvas, Colour, Point, text_width
from .families import CROWD, captions
from .labels import Item, Note, Rect, arrange
from .silhouettes import Silhouette

_MARKED = {"error": palette.ERROR, "warning": palette.WARNING}


@dataclass(frozen=True)
class View:
    """A panel that turns metres into pixels: `(u, v)` are world (x, y) from above, (x, z) from the side."""

    canvas: Canvas
    panel: Rect
    scale: float
    """Pixels per metre."""
    middle: Point
    """The world point in the middle of the panel."""
    axes: tuple[int, int] = (0, 1)
    """The world coordinates that run to the right and up."""

    def at(self, point: Vec3) -> Point:
        """The pixel of a point of the world, m."""
        return self.pixel(point[self.axes[0]], point[self.axes[1]])

    def of(self, outlines: Silhouette) -> list[np.ndarray]:
        """The outlines that belong to this view."""
        return {(0, 1): outlines.top, (0, 2): outlines.side, (1, 2): outlines.front}[self.axes]

    def pixel(self, u: float, v: float) -> Point:
        """The pixel of the point (u, v) of this view, m."""
        x = (self.panel[0] + self.panel[2]) / 2 + (u - self.middle[0]) * self.scale
        return x, (self.panel[1] + self.panel[3]) / 2 - (v - self.middle[1]) * self.scale

    def pixels(self, polygons: list[np.ndarray]) -> list[np.ndarray]:
        """Polygons in metres as polygons in pixels."""
        return [np.stack(self.pixel(p[:, 0], p[:, 1]), axis=1) for p in polygons]  # type: ignore[arg-type]

    def extent(self, polygons: list[np.ndarray]) -> Rect:
        """The pixels that polygons (in metres) span."""
        points = np.concatenate(self.pixels(polygons))
        (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
        return (float(x0), float(y0), float(x1), float(y1))

    def paper(self, title: str, axes: tuple[str, str], notes: tuple[str, str]) -> None:
        """Draw the panel, its grid with numbers, its title and its axes."""
        x0, y0, x1, y1 = self.panel
        canvas = self.canvas
        canvas.rectangle((x0, y0), (x1, y1), palette.PANEL)
        step = nice(80 / self.scale)
        low = (self.middle[0] - (x1 - x0) / 2 / self.scale, self.middle[1] - (y1 - y0) / 2 / self.scale)
        high = (self.middle[0] + (x1 - x0) / 2 / self.scale, self.middle[1] + (y1 - y0) / 2 / self.scale)
        for n in range(math.ceil(low[0] / step), math.floor(high[0] / step) + 1):
            x, _ = self.pixel(n * step, 0)
            canvas.line((x, y0), (x, y1), palette.AXIS if n == 0 else palette.GRID)
            label = metres(n * step, step)
            if x0 + 30 < x < x1 - 30:
                canvas.text(label, (x - text_width(label, 13) / 2, y1 + 17), 13, palette.QUIET)
        for n in range(math.ceil(low[1] / step), math.floor(high[1] / step) + 1):
            _, y = self.pixel(0, n * step)
            canvas.line((x0, y), (x1, y), palette.AXIS if n == 0 else palette.GRID)
            label = metres(n * step, step)
            if y0 + 14 < y < y1 - 10:
                canvas.text(label, (x0 - 8 - text_width(label, 13), y + 5), 13, palette.QUIET)
        for a, b in (((x0, y0), (x1, y0)), ((x0, y1), (x1, y1)), ((x0, y0), (x0, y1)), ((x1, y0), (x1, y1))):
            canvas.line(a, b, palette.AXIS)
        canvas.text(title, (x0, y0 - 12), 17, palette.TEXT, 600)
        note = f"{axes[0]} → {notes[0]}    {axes[1]} ↑ {notes[1]}    metres"
        canvas.text(note, (x1 - text_width(note, 14), y0 - 12), 14, palette.QUIET)

    def shape(self, polygons: list[np.ndarray], colour: Colour, outline: Colour, alpha: float, width: float) -> None:
        """Draw a filled object with its outline, never smaller than a visible dot."""
        shapes = self.pixels(polygons)
        x0, y0, x1, y1 = self.extent(polygons)
        if max(x1 - x0, y1 - y0) < 5:
            self.canvas.dot(((x0 + x1) / 2, (y0 + y1) / 2), 3.5, outline)
            return
        self.canvas.fill(shapes, colour, alpha)
        self.canvas.outline(shapes, outline, width)

    def scale_bar(self) -> Rect:
        """Draw a bar of a round length in the lower right corner; returns the space that it takes."""
        length = nice(110 / self.scale)
        x1, y1 = self.panel[2] - 22, self.panel[3] - 20
        x0 = x1 - length * self.scale
        for a, b in (((x0, y1), (x1, y1)), ((x0, y1 - 5), (x0, y1 + 5)), ((x1, y1 - 5), (x1, y1 + 5))):
            self.canvas.line(a, b, palette.TEXT, 1.6)
        words = f"{metres(length, length)} m"
        self.canvas.text(words, ((x0 + x1 - text_width(words, 14)) / 2, y1 - 9), 14, palette.TEXT, 500)
        return (x0 - 6, y1 - 28, x1 + 6, y1 + 10)

    def names(
        self,
        boxes: dict[str, Rect],
        taken: list[Rect],
        marks: dict[str, str],
        notes: Sequence[Note] = (),
        kinds: Mapping[str, str] | None = None,
    ) -> int:
        """Write the names of objects, with words about some (`kinds`), and the notes of marks.

        Returns the number of those for which there was no room.
        """
        words = captions(boxes, marks)
        words = {name: f"{text} ({kinds[name]})" if kinds and name in kinds else text for name, text in words.items()}
        size = 15 if len(words) <= CROWD else 12
        items = [Item(name, boxes[name], text_width(text, size, 500) + 8, size + 6) for name, text in words.items()]
        colours = {name: _MARKED[mark] for name, mark in marks.items() if mark in _MARKED}
        for number, note in enumerate(notes):
            key = f"{number}\n"  # no object has such a name
            words[key], colours[key] = note.words, note.colour
            items.append(Item(key, note.box, text_width(note.words, size, 500) + 8, size + 6))
        x0, y0, x1, y1 = self.panel
        ink = [rect for note in notes for rect in note.ink]
        labels, left = arrange(items, (x0 + 4, y0 + 4, x1 - 4, y1 - 4), [*taken, *ink])
        for label in labels:
            if label.leader is not None:
                self.canvas.line(*label.leader, palette.QUIET, 1.0)
                self.canvas.dot(label.leader[1], 2.4, palette.QUIET)
        for label in labels:
            a, b, c, d = label.box
            self.canvas.rectangle((a, b), (c, d), palette.PANEL, 0.72)
            self.canvas.text(words[label.name], (a + 4, d - 6), size, colours.get(label.name, palette.TEXT), 500)
        return len(left)


def nice(least: float) -> float:
    """The smallest of 1, 2, 5, 10 … (times a power of ten) that is at least this."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(m * power for m in (1, 2, 5, 10) if m * power >= least * 0.999)


def metres(value: float, step: float) -> str:
    """A coordinate with as many digits as the grid needs."""
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:.{digits}f}"
    return text.replace("-", "−") if float(text) else "0"
