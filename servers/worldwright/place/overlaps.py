"""Find objects that may overlap, by their world boxes on a grid of cells.

A sort along one axis alone keeps all boxes active that stand beside each other across it, so a square of n objects would
cost n^1.5. On a grid of cells about as large as the boxes, each is compared with its neighbours only. Boxes much larger than
the rest (floors, walls) are compared with every other at once, by array. Source: C. Ericson, Real-Time Collision Detection,
section 7.1 (uniform grids).
"""

from collections.abc import Iterator, Sequence

from ..model.plan.committed import Vec3

Bounds = tuple[str, Vec3, Vec3]
"""Name, lowest and highest corner, metres."""
LARGE_CELLS = 64
"""A box that would cover more cells is compared with all others."""


def overlapping(bounds: Sequence[Bounds], *, deeper_than_m: float = 1e-3) -> Iterator[tuple[str, str, float]]:
    """Pairs of boxes that overlap along all three axes, with the smallest of the three overlaps in metres.

    A negative `deeper_than_m` finds pairs with less than that distance between their boxes along every axis, too.
    """
    if len(bounds) < 2:
        return
    import numpy as np

    low, high = np.array([b[1] for b in bounds]), np.array([b[2] for b in bounds])
    reach = max(-deeper_than_m, 0.0)
    span = high[:, :2] - low[:, :2] + 2 * reach
    cell = max(float(np.median(span.max(axis=1))) * 1.5, 1e-3)
    first = np.floor((low[:, :2] - reach) / cell).astype(np.int64)
    last = np.floor((high[:, :2] + reach) / cell).astype(np.int64)
    large = (last - first + 1).prod(axis=1) > LARGE_CELLS
    cells: dict[tuple[int, int], list[int]] = {}
    spans = zip(first.tolist(), last.tolist(), large.tolist(), strict=True)
    for index, ((i0, j0), (i1, j1), is_large) in enumerate(spans):
        if is_large:
            continue
        for i in range(i0, i1 + 1):
            for j in range(j0, j1 + 1):
                cells.setdefault((i, j), []).append(index)
    shared = [members for members in cells.values() if len(members) > 1]
    candidates = [np.array([(a, b) for n, b in enumerate(m) for a in m[:n]], dtype=np.int64) for m in shared]
    for index in np.flatnonzero(large).tolist():
        others = np.flatnonzero(~large | (np.arange(len(bounds)) > index))
        others = others[others != index]
        candidates.append(np.stack([np.full(len(others), index), others], axis=1))
    if not candidates:
        return
    pairs = np.unique(np.sort(np.concatenate(candidates), axis=1), axis=0)
    a, b = pairs[:, 0], pairs[:, 1]
    depth = (np.minimum(high[a], high[b]) - np.maximum(low[a], low[b])).min(axis=1)
    for n in np.flatnonzero(depth > deeper_than_m):
        one, other = sorted((bounds[a[n]][0], bounds[b[n]][0]))
        yield one, other, float(depth[n])
