"""The surface of still water as cells of a grid, cut where its shore cuts them.

A cell at the shore has a share of water and sides that are open in part, so that waves are turned back by a wall that lies aslant or
is round, and not by stairs (the finite volumes of Ng, Min and Gibou, "An efficient fluid-solid coupling algorithm", J. Comput.
Phys. 2009). The Laplacian lets nothing through the shore and is symmetric in the inner product by areas: what is made of it keeps
volume, and energy.
"""

from functools import cached_property

import numpy as np
from scipy.fft import next_fast_len

from worldkit.polygons import area, inside

LEAST_SHARE = 0.3
"""A cell with less water belongs to its neighbours, or the quickest waves would be those of a sliver."""
FINER = 8
"""Points across a cell by which its share is counted."""

Array = np.ndarray


class WetGrid:
    """The wet cells, C of them.

    Args:
        outline: (P, 2) m, the shore, one closed polygon, without its first point again.
        cell_m: how wide a cell is, about; a rectangle along the axes is filled by whole ones.

    Raises:
        ValueError: not one cell is wet.
    """

    def __init__(self, outline: Array, cell_m: float) -> None:
        low, high = outline.min(axis=0), outline.max(axis=0)
        self.whole = rectangle(outline)
        """Whether it is a rectangle along the axes."""
        count = np.maximum(np.ceil((high - low) / cell_m - 1e-9).astype(int), 1)
        count = np.array([next_fast_len(max(4, int(n)), True) for n in count]) if self.whole else count + 2
        self.cell = (high - low) / count if self.whole else np.full(2, cell_m)
        """(2,) m."""
        self.low = (low + high - count * self.cell) / 2
        self.shape = int(count[0]), int(count[1])
        share = np.ones(self.shape) if self.whole else self._points_within(outline).mean(axis=(1, 3))
        wet = share >= LEAST_SHARE
        if not wet.any():
            raise ValueError(f"no cell of {cell_m:g} m is wet")
        self.number = np.full(self.shape, -1)
        """Number of each cell, -1 where it is dry."""
        self.number[wet] = np.arange(int(wet.sum()))
        self.size = int(wet.sum())
        self.area = area(outline)
        """m^2, of the polygon."""
        self.areas = share[wet] * (self.area / share[wet].sum())
        """(C,) m^2 of water in each cell; where slivers are left out, the others take theirs."""
        at = np.argwhere(wet)
        self.middle = self.low + (at + 0.5) * self.cell
        """(C, 2) m."""
        self._outline, self._wet = outline, wet

    @cached_property
    def stiffness(self) -> Array:
        """(C, C): the Laplacian's, with a minus, times the areas, symmetric; nothing passes the shore."""
        first, second, width = self._sides(self._outline, self._wet)
        out = np.zeros((self.size, self.size))
        np.add.at(out, (first, second), -width)
        np.add.at(out, (second, first), -width)
        np.add.at(out, (first, first), width)
        np.add.at(out, (second, second), width)
        return out

    def around(self, points: Array) -> "tuple[Array, Array, Array]":
        """The four cells around points (n, 2): their numbers (n, 4), their weights (n, 4), which sum to 1 or, on land, to 0, and
        the slope of these (n, 4, 2), 1/m. Dry cells have the number 0 and the weight 0.
        """
        place = (points - self.low) / self.cell - 0.5
        corner = np.floor(place).astype(int)
        f = place - corner
        cells = corner[:, None] + np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
        inside = ((cells >= 0) & (cells < np.array(self.shape))).all(axis=2)
        cells = np.where(inside[..., None], cells, 0)
        number = np.where(inside, self.number[cells[..., 0], cells[..., 1]], -1)
        x, y = f[:, 0], f[:, 1]
        weights = np.stack([(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y], axis=1)
        slope = np.stack(
            [np.stack([y - 1, 1 - y, -y, y], axis=1), np.stack([x - 1, -x, 1 - x, x], axis=1)], axis=2
        ) / self.cell  # fmt: skip
        wet = number >= 0
        weights, slope = weights * wet, slope * wet[..., None]
        total = weights.sum(axis=1, keepdims=True)
        safe = np.maximum(total, 1e-12)
        # Near the shore those that are wet stand for all; the slope is that of their quotient.
        slope = slope / safe[..., None] - weights[..., None] * slope.sum(axis=1, keepdims=True) / safe[..., None] ** 2
        good = total > 1e-3
        return np.where(wet, number, 0), np.where(good, weights / safe, 0.0), np.where(good[..., None], slope, 0.0)

    def _points_within(self, outline: Array) -> Array:
        """(nx, `FINER`, ny, `FINER`) whether points of a finer grid are within the shore."""
        axes = [self.low[i] + (np.arange(self.shape[i] * FINER) + 0.5) * self.cell[i] / FINER for i in range(2)]
        found = np.stack([crossed(outline, x, axes[1]) for x in axes[0]])
        return found.reshape(self.shape[0], FINER, self.shape[1], FINER)

    def _sides(self, outline: Array, wet: Array) -> "tuple[Array, Array, Array]":
        """Pairs of wet neighbours of square cells, and the open share of the side between them."""
        pairs = []
        along = (np.arange(FINER) + 0.5) / FINER
        for axis in range(2):
            here = wet[:-1] & wet[1:] if axis == 0 else wet[:, :-1] & wet[:, 1:]
            i, j = np.nonzero(here)
            other = (i + 1, j) if axis == 0 else (i, j + 1)
            # Points on the side, in the cells' own units.
            u = np.stack([np.full((len(i), FINER), 1.0), np.broadcast_to(along, (len(i), FINER))], axis=2)
            u = (u if axis == 0 else u[..., ::-1]) + np.stack([i, j], axis=1)[:, None]
            within = inside(outline, (self.low + u * self.cell).reshape(-1, 2)).reshape(len(i), FINER)
            pairs.append((self.number[i, j], self.number[other], np.maximum(within.mean(axis=1), 0.05)))
        return tuple(np.concatenate(part) for part in zip(*pairs, strict=True))  # type: ignore[return-value]


def crossed(outline: Array, x: float, ys: Array) -> Array:
    """(n,) whether the points (x, y) for ascending y are within a polygon: where its edges cross that line changes it."""
    a, b = outline, np.roll(outline, -1, axis=0)
    cut = (a[:, 0] <= x) != (b[:, 0] <= x)
    a, b = a[cut], b[cut]
    at = np.sort(a[:, 1] + (x - a[:, 0]) / (b[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1]))
    return np.asarray(np.searchsorted(at, ys) % 2 == 1)


def rectangle(outline: Array) -> bool:
    """Whether a polygon is a rectangle along the axes, however many points its sides have."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    near = 1e-6 * float((high - low).max())
    return bool(np.minimum(np.abs(outline - low), np.abs(outline - high)).min(axis=1).max() <= near) and all(
        np.linalg.norm(outline - corner, axis=1).min() <= near
        for corner in (low, high, np.array([low[0], high[1]]), np.array([high[0], low[1]]))
    )
