"""A canvas with smooth lines, translucent fills and real type, in pixels of the finished picture.

Shapes are drawn at twice the size and reduced at the end; text is drawn last, at full size, with the font that OpenCV
carries inside (so a bare machine draws the same picture).

matplotlib does not do it: it takes 0.8 s to import and 400 us to measure a label, of which thousands are measured (here
2.5 us each), and it cannot draw the contour of a union of shapes.
"""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import cv2
import numpy as np

Colour = tuple[int, int, int]
"""Red, green, blue, 0 to 255."""
Point = tuple[float, float]
SCALE = 2
_SHIFT = 4  # OpenCV takes sixteenths of a pixel


@dataclass
class Canvas:
    """A picture that is being drawn."""

    width: int
    height: int
    background: Colour
    pixels: np.ndarray = field(init=False, repr=False)
    texts: list[tuple[str, Point, float, Colour, int]] = field(default_factory=list, repr=False)

    def __post_init__(self) -> None:
        self.pixels = np.empty((self.height * SCALE, self.width * SCALE, 3), np.uint8)
        self.pixels[:] = self.background

    def rectangle(self, low: Point, high: Point, colour: Colour, alpha: float = 1.0) -> None:
        """Draw a filled rectangle."""
        corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
        self.fill([np.asarray(corners)], colour, alpha)

    def fill(self, polygons: list[np.ndarray], colour: Colour, alpha: float) -> None:
        """Fill the union of polygons, each (N, 2) pixels, evenly translucent."""
        mask, origin = self._mask(polygons)
        if mask is None:
            return
        x, y = origin
        part = self.pixels[y : y + mask.shape[0], x : x + mask.shape[1]]
        covers = np.arange(256, dtype=np.float32)[:, None]
        even = (covers * np.float32(1 - alpha) + np.asarray(colour, np.float32) * np.float32(alpha) + 0.5).astype(
            np.uint8
        )
        # Nearly all of it is covered whole, where a table answers; only the rim is weighed pixel by pixel.
        inside, rim = mask == 255, np.nonzero((mask > 0) & (mask < 255))
        weight = (mask[rim].astype(np.float32) * (alpha / 255))[:, None]
        mixed = (part[rim] * (1 - weight) + np.asarray(colour, np.float32) * weight + 0.5).astype(np.uint8)
        cv2.copyTo(cv2.LUT(np.ascontiguousarray(part), even[None]), inside.astype(np.uint8), part)
        part[rim] = mixed

    def outline(self, polygons: list[np.ndarray], colour: Colour, width: float = 1.5) -> None:
        """Draw the contour of the union of polygons, each (N, 2) pixels."""
        thickness = max(1, round(width * SCALE))
        if len(polygons) == 1:
            points = np.round(polygons[0] * SCALE * 2**_SHIFT).astype(np.int32)
            cv2.polylines(self.pixels, [points], True, colour, thickness, cv2.LINE_AA, _SHIFT)
            return
        mask, (x, y) = self._mask(polygons)
        if mask is None:
            return
        contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=(x, y))
        cv2.polylines(self.pixels, contours, True, colour, thickness, cv2.LINE_AA)

    def _mask(self, polygons: list[np.ndarray]) -> tuple[np.ndarray | None, tuple[int, int]]:
        points = np.concatenate(polygons) * SCALE
        low = np.floor(points.min(axis=0)).astype(int) - 2
        high = np.ceil(points.max(axis=0)).astype(int) + 3
        low = np.maximum(low, 0)
        high = np.minimum(high, (self.width * SCALE, self.height * SCALE))
        if (high <= low).any():
            return None, (0, 0)
        mask = np.zeros((high[1] - low[1], high[0] - low[0]), np.uint8)
        for polygon in polygons:
            shifted = np.round((polygon * SCALE - low) * 2**_SHIFT).astype(np.int32)
            cv2.fillPoly(mask, [shifted], 255, cv2.LINE_AA, _SHIFT)
        return mask, (int(low[0]), int(low[1]))

    def line(self, start: Point, end: Point, colour: Colour, width: float = 1.0) -> None:
        """Draw a straight line."""
        a, b = (tuple(round(v * SCALE * 2**_SHIFT) for v in p) for p in (start, end))
        cv2.line(self.pixels, a, b, colour, max(1, round(width * SCALE)), cv2.LINE_AA, _SHIFT)

    def dashes(self, start: Point, end: Point, colour: Colour, width: float = 1.0, dash: float = 5.0) -> None:
        """Draw a dashed line."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        length = float(np.hypot(*(b - a)))
        for at in np.arange(0.0, length, 2 * dash):
            p, q = a + (b - a) * at / length, a + (b - a) * min(at + dash, length) / length
            self.line(tuple(p), tuple(q), colour, width)

    def arrow(self, start: Point, end: Point, colour: Colour, width: float = 2.0, head: float = 8.0) -> None:
        """Draw a line that ends in a filled head."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        length = float(np.hypot(*(b - a)))
        if length < 1e-6:
            return
        along = (b - a) / length
        across = np.array([-along[1], along[0]])
        head = min(head, length)
        neck = b - along * head
        self.line(start, tuple(neck + along), colour, width)
        self.fill([np.stack([b, neck + across * head * 0.55, neck - across * head * 0.55])], colour, 1.0)

    def dot(self, centre: Point, radius: float, colour: Colour) -> None:
        """Draw a filled disc."""
        self.fill([circle(centre, radius)], colour, 1.0)

    def text(self, words: str, at: Point, size: float, colour: Colour, weight: int = 400) -> None:
        """Write text whose baseline starts at a point, above everything else."""
        self.texts.append((words, at, size, colour, weight))

    def png(self) -> bytes:
        """The finished picture."""
        image = cv2.resize(self.pixels, (self.width, self.height), interpolation=cv2.INTER_AREA)
        for words, (x, y), size, colour, weight in self.texts:
            cv2.putText(image, words, (round(x), round(y)), colour, font(), round(size), weight)
        done, data = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), [cv2.IMWRITE_PNG_COMPRESSION, 6])
        assert done
        return bytes(data)


@lru_cache(maxsize=1)
def font() -> Any:
    """OpenCV's built-in variable font."""
    return cv2.FontFace("sans")


@lru_cache(maxsize=4096)
def text_width(words: str, size: float, weight: int = 400) -> float:
    """Width of a line of text in pixels."""
    return float(cv2.getTextSize((0, 0), words, (0, 0), font(), round(size), weight)[2])


def circle(centre: Point, radius: float) -> np.ndarray:
    """A circle as a polygon (N, 2)."""
    angles = np.linspace(0, 2 * np.pi, 49)[:-1]
    return np.stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)], axis=1)
