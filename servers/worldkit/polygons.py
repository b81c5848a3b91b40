"""Closed polygons in a plane, by their corners (P, 2) one after another, without the first one again."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np


def area(outline: "np.ndarray") -> float:
    """m^2, of a polygon."""
    import numpy as np

    x, y = outline.T
    return float(abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2)


def inside(outline: "np.ndarray", points: "np.ndarray") -> "np.ndarray":
    """(n,) whether points (n, 2) are within a polygon, some at a time."""
    import numpy as np

    a, b = outline, np.roll(outline, -1, axis=0)
    found = np.zeros(len(points), bool)
    for part in np.array_split(np.arange(len(points)), max(1, len(points) * len(outline) // 2_000_000 + 1)):
        x, y = points[part, 0, None], points[part, 1, None]
        cut = (a[:, 0] <= x) != (b[:, 0] <= x)
        with np.errstate(divide="ignore", invalid="ignore"):
            at = a[:, 1] + (x - a[:, 0]) / (b[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
        found[part] = (cut & (at < y)).sum(axis=1) % 2 == 1
    return found
