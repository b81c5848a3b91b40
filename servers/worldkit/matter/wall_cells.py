"""Which cells of a room come near which geom: a compiled sort, so that a point looks at what is near and at nothing else.

The lists are of more than is needed by `SLACK`: they stand as long as no geom has moved by that and the room has not grown out of
them, which for a bench or a bowl that stands is for the whole run.
"""

import numpy as np

from .kernels import kernel
from .wall_distance import ELLIPSOID, HFIELD, PLANE, distance

Array = np.ndarray
SLACK = 0.5
"""Cells of the grid that a geom may move before it is sorted again."""
ON_ITS_WAY = 0.4
"""Cells that it may move within one question, besides."""


@kernel
def sorted_in(
    kinds, sizes, poses, boxes, firsts, counts, faces, heights, rows, columns, low, cell, cells, margins, starts, cursor,
):  # fmt: skip
    """(m,) geoms that come within their margins (g,) of each cell of the side `cell` from `low`, in their order; starts (c + 1,) of each cell.

    boxes (g, 6): middle and half sides of each geom in its frame; cursor (c,) room. Other arguments as `wall_distance.look`.
    """
    n, middle, half = np.empty(3), np.empty(3), np.empty(3)
    first, last = np.empty(3, np.int64), np.empty(3, np.int64)
    room, used = 1024, 0
    hits = np.empty((room, 2), np.int64)
    starts[:] = 0
    for g in range(len(kinds)):
        m = poses[g]
        far = margins[g] + 0.8661 * cell  # of a cell's middle
        for r in range(3):
            first[r], last[r] = 0, cells[r] - 1
            if kinds[g] != PLANE:
                middle[r], half[r] = m[r], margins[g]
                for s in range(3):
                    middle[r] += m[3 + 3 * r + s] * boxes[g, s]
                    half[r] += abs(m[3 + 3 * r + s]) * boxes[g, 3 + s]
                first[r] = min(max(int(np.floor((middle[r] - half[r] - low[r]) / cell)), 0), cells[r] - 1)
                last[r] = min(max(int(np.floor((middle[r] + half[r] - low[r]) / cell)), 0), cells[r] - 1)
        for i in range(first[0], last[0] + 1):
            for j in range(first[1], last[1] + 1):
                for k in range(first[2], last[2] + 1):
                    if kinds[g] != ELLIPSOID and kinds[g] != HFIELD:  # whose distances grow faster than one goes away
                        rx = low[0] + (i + 0.5) * cell - m[0]
                        ry = low[1] + (j + 0.5) * cell - m[1]
                        rz = low[2] + (k + 0.5) * cell - m[2]
                        lx = m[3] * rx + m[6] * ry + m[9] * rz
                        ly = m[4] * rx + m[7] * ry + m[10] * rz
                        lz = m[5] * rx + m[8] * ry + m[11] * rz
                        d = distance(
                            kinds[g], sizes[g], lx, ly, lz, faces, firsts[g], counts[g], heights, rows[g], columns[g], n, far
                        )  # fmt: skip
                        if d > far:
                            continue
                    if used == room:
                        more = np.empty((2 * room, 2), np.int64)
                        more[:room] = hits
                        hits, room = more, 2 * room
                    at = (i * cells[1] + j) * cells[2] + k
                    hits[used, 0], hits[used, 1] = at, g
                    starts[at + 1] += 1
                    used += 1
    for at in range(len(cursor)):
        starts[at + 1] += starts[at]
        cursor[at] = starts[at]
    listed = np.empty(used, np.int64)
    for entry in range(used):
        at = hits[entry, 0]
        listed[cursor[at]] = hits[entry, 1]
        cursor[at] += 1
    return listed


def moved(before: Array, now: Array, boxes: Array) -> float:
    """m: the most that any place of any geom has moved from poses (g, 12) to others; boxes as `sorted_in`."""
    turned = np.linalg.norm(now[:, 3:] - before[:, 3:], axis=1)
    reach = np.where(turned > 0, np.linalg.norm(boxes[:, :3], axis=1) + np.linalg.norm(boxes[:, 3:], axis=1), 0.0)
    return float((np.linalg.norm(now[:, :3] - before[:, :3], axis=1) + turned * reach).max(initial=0.0))
