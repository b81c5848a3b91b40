"""Signed distances from geoms, in their own frames, and the walls that each point is near; compiled.

Plane, sphere, capsule, cylinder and box are exact; an ellipsoid is exact on its surface; a mesh is its convex hull, as contacts see
it, by its farthest face; a height field is its bilinear surface, by slope.
"""

import numpy as np

from .kernels import kernel

PLANE, HFIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)
"""mjtGeom."""
SEEN = 16
"""Nearest walls of a point that are looked at."""
EVEN = 0.05
"""Of the reach: a wall that stands out no farther from the plane of a nearer one is of it."""


@kernel
def distance(kind, size, x, y, z, faces, first, count, heights, rows, columns, n, limit):
    """m, negative within, of a point in the geom's frame; n (3,) becomes the way out. Beyond `limit`, m, some number above it will do.

    faces (f, 4): normals and offsets of hulls, of which this geom has `count` from `first`; heights (r, c) m of a height field.
    """
    n[0], n[1], n[2] = 0.0, 0.0, 1.0
    if kind == PLANE:
        return z
    if kind in (SPHERE, CAPSULE):
        axis = min(max(z, -size[1]), size[1]) if kind == CAPSULE else 0.0
        far = np.sqrt(x * x + y * y + (z - axis) ** 2)
        if far > 1e-12:
            n[0], n[1], n[2] = x / far, y / far, (z - axis) / far
        return far - size[0]
    if kind == BOX:
        return corner(abs(x) - size[0], abs(y) - size[1], abs(z) - size[2], signed(x), signed(y), signed(z), n)
    if kind == CYLINDER:
        wide = np.sqrt(x * x + y * y)
        far = corner(wide - size[0], -1e9, abs(z) - size[1], 1.0, 1.0, signed(z), n)
        outwards = n[0]
        n[0], n[1] = (outwards * x / wide, outwards * y / wide) if wide > 1e-12 else (outwards, 0.0)
        return far
    if kind == ELLIPSOID:
        a, b, c = x / size[0], y / size[1], z / size[2]
        level = np.sqrt(a * a + b * b + c * c)
        gx, gy, gz = a / size[0], b / size[1], c / size[2]
        steep = np.sqrt(gx * gx + gy * gy + gz * gz)
        if steep < 1e-9:
            return -min(size[0], size[1], size[2])
        n[0], n[1], n[2] = gx / steep, gy / steep, gz / steep
        return level * (level - 1.0) / steep
    if kind == MESH:
        best = -1e30
        for f in range(first, first + count):
            d = faces[f, 0] * x + faces[f, 1] * y + faces[f, 2] * z - faces[f, 3]
            if d > best:
                best = d
                n[0], n[1], n[2] = faces[f, 0], faces[f, 1], faces[f, 2]
                if best > limit:  # it only grows: most of a lathe's thousand pieces are told far by their first faces
                    break
        return best
    gx = (x / size[0] + 1.0) * 0.5 * (columns - 1)
    gy = (y / size[1] + 1.0) * 0.5 * (rows - 1)
    if gx < 0.0 or gy < 0.0 or gx > columns - 1 or gy > rows - 1:
        return 1e9
    i, j = min(int(gx), columns - 2), min(int(gy), rows - 2)
    fx, fy = gx - i, gy - j
    at = first + j * columns + i
    h00, h10, h01, h11 = heights[at], heights[at + 1], heights[at + columns], heights[at + columns + 1]
    sx = ((h10 - h00) * (1 - fy) + (h11 - h01) * fy) * (columns - 1) / (2.0 * size[0])
    sy = ((h01 - h00) * (1 - fx) + (h11 - h10) * fx) * (rows - 1) / (2.0 * size[1])
    high = (h00 * (1 - fx) + h10 * fx) * (1 - fy) + (h01 * (1 - fx) + h11 * fx) * fy
    one = 1.0 / np.sqrt(1.0 + sx * sx + sy * sy)
    n[0], n[1], n[2] = -sx * one, -sy * one, one
    return (z - high) * one


@kernel
def signed(value):
    """1 or -1."""
    return -1.0 if value < 0.0 else 1.0


@kernel
def corner(ox, oy, oz, sx, sy, sz, n):
    """Of what is bounded by faces at right angles, beyond each of which a point is so far."""
    px, py, pz = max(ox, 0.0), max(oy, 0.0), max(oz, 0.0)
    far = np.sqrt(px * px + py * py + pz * pz)
    if far > 0.0:
        n[0], n[1], n[2] = sx * px / far, sy * py / far, sz * pz / far
        return far
    if ox >= oy and ox >= oz:
        n[0], n[1], n[2] = sx, 0.0, 0.0
        return ox
    if oy >= oz:
        n[0], n[1], n[2] = 0.0, sy, 0.0
        return oy
    n[0], n[1], n[2] = 0.0, 0.0, sz
    return oz


@kernel
def look(
    x, count, reach, kinds, sizes, poses, firsts, counts, owners, faces, heights, rows, columns,
    low, cell, cells, starts, listed, planes, walls, near, seen, still,
):  # fmt: skip
    """Find the walls that points x (n, 3) are near: nearest first, into planes (n, 6, 4), walls (n, 6), near (n,).

    A wall of the same body whose nearest place lies on or behind the plane of a nearer one is left out, for that one holds what it
    would: tiles of a floor are one floor, at one floor's cost.

    seen (n, 3): where each point was when it looked last; one that has moved less than `still`, m, since then keeps what it found.
    poses (g, 12): middle and turn of each geom; `listed` from `starts` on: geoms that a cell of the room (`cells` of the side
    `cell`, from `low`) may see.
    """
    n, gaps, ways, whose = np.empty(3), np.empty(SEEN), np.empty((SEEN, 3)), np.empty(SEEN, np.int64)
    most = planes.shape[1]
    for p in range(count):
        if (x[p, 0] - seen[p, 0]) ** 2 + (x[p, 1] - seen[p, 1]) ** 2 + (x[p, 2] - seen[p, 2]) ** 2 < still * still:
            continue
        seen[p, 0], seen[p, 1], seen[p, 2] = x[p, 0], x[p, 1], x[p, 2]
        found = 0
        i = min(max(int((x[p, 0] - low[0]) / cell), 0), cells[0] - 1)
        j = min(max(int((x[p, 1] - low[1]) / cell), 0), cells[1] - 1)
        k = min(max(int((x[p, 2] - low[2]) / cell), 0), cells[2] - 1)
        at = (i * cells[1] + j) * cells[2] + k
        for entry in range(starts[at], starts[at + 1]):
            g = listed[entry]
            m = poses[g]
            rx, ry, rz = x[p, 0] - m[0], x[p, 1] - m[1], x[p, 2] - m[2]
            lx = m[3] * rx + m[6] * ry + m[9] * rz
            ly = m[4] * rx + m[7] * ry + m[10] * rz
            lz = m[5] * rx + m[8] * ry + m[11] * rz
            limit = 1.74 * reach if found < SEEN else min(1.74 * reach, gaps[SEEN - 1])
            d = distance(
                kinds[g], sizes[g], lx, ly, lz, faces, firsts[g], counts[g], heights, rows[g], columns[g], n, limit
            )  # fmt: skip
            if d > limit:
                continue
            nx = m[3] * n[0] + m[4] * n[1] + m[5] * n[2]
            ny = m[6] * n[0] + m[7] * n[1] + m[8] * n[2]
            nz = m[9] * n[0] + m[10] * n[1] + m[11] * n[2]
            if d > reach * (abs(nx) + abs(ny) + abs(nz)):
                continue
            slot = min(found, SEEN - 1)
            if found == SEEN and gaps[SEEN - 1] <= d:
                continue
            while slot > 0 and gaps[slot - 1] > d:
                gaps[slot], ways[slot], whose[slot] = gaps[slot - 1], ways[slot - 1], whose[slot - 1]
                slot -= 1
            gaps[slot], whose[slot] = d, owners[g]
            ways[slot, 0], ways[slot, 1], ways[slot, 2] = nx, ny, nz
            found = min(found + 1, SEEN)
        kept = 0
        for s in range(found):
            d, w = gaps[s], ways[s]
            hidden = False
            for h in range(kept):
                before = planes[p, h]
                along = before[0] * w[0] + before[1] * w[1] + before[2] * w[2]
                from_before = before[0] * x[p, 0] + before[1] * x[p, 1] + before[2] * x[p, 2] - before[3]
                if d > 0.0 and walls[p, h] == whose[s] and from_before - d * along <= EVEN * reach:
                    hidden = True
                    break
            if hidden:
                continue
            planes[p, kept, 0], planes[p, kept, 1], planes[p, kept, 2] = w[0], w[1], w[2]
            planes[p, kept, 3] = w[0] * x[p, 0] + w[1] * x[p, 1] + w[2] * x[p, 2] - d
            walls[p, kept] = whose[s]
            kept += 1
            if kept == most:
                break
        near[p] = kept
