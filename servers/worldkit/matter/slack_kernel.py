"""The steps of a slack skin with gas inside, compiled: see `membranes`."""

from typing import Any

import numpy as np

from .kernels import kernel

Array = np.ndarray
PAIRS_EVERY, MOST_PAIRS = 40, 60
"""Steps after which it is looked anew which layers are near each other; pairs for each point at most."""
FLAT = 0.15
"""Square of the area, unstretched 1, below which a triangle pushes no more: squeezed to a line, it would without end."""
CREEP = 2e-3
"""m/s, below which friction is a drag."""


@kernel
def layers(x: Array, rest: Array, far: float, reach: float, most: int) -> Any:
    """(k, 2) points that are nearer than `reach` and were farther than `far` unstretched."""
    n, found, count = len(x), np.empty((most, 2), np.int64), 0
    order = np.argsort(x[:, 0])
    for a in range(n):
        i = order[a]
        for b in range(a + 1, n):
            j = order[b]
            if x[j, 0] - x[i, 0] > reach:
                break
            d = r = 0.0
            for z in range(3):
                d += (x[i, z] - x[j, z]) ** 2
                r += (rest[i, z] - rest[j, z]) ** 2
            if d < reach * reach and r > far * far and count < most:
                found[count, 0], found[count, 1] = i, j
                count += 1
    return found[:count]


@kernel
def advance(
    x: Array, v: Array, mass: Array, tris: Array, inverse: Array, matter: Array, mu: float, creased: float, edges: Array,
    bends: Array, gain: float, rest: Array, far: float, apart: float, hard: float, grip: float, air: float, table: float,
    gravity: Array, warmth: float, outside: float, density: float, hole_at: int, hole: float, h: float, parts: int, sums: Array,
) -> None:  # fmt: skip
    """`parts` steps of `h` s, in place. `sums`: impulse to the world (3), J that the gas gave, J in walls, J in contacts, mol of gas."""
    n = len(x)
    f = np.zeros_like(x)
    near = layers(x, rest, far, 2.0 * apart, MOST_PAIRS * n)
    before = last = 0.0
    for part in range(parts + 1):
        room = 0.0
        for t in range(len(tris)):
            i, j, k = tris[t, 0], tris[t, 1], tris[t, 2]
            room += x[i, 0] * (x[j, 1] * x[k, 2] - x[j, 2] * x[k, 1])
            room += x[i, 1] * (x[j, 2] * x[k, 0] - x[j, 0] * x[k, 2])
            room += x[i, 2] * (x[j, 0] * x[k, 1] - x[j, 1] * x[k, 0])
        room = max(room / 6, 1e-9)
        over = sums[6] * warmth / room - outside
        if part:  # the work of the gas over the step before, at the mean of both pressures
            sums[3] += 0.5 * (over + last) * (room - before)
            if part == parts and h > 0.0:
                break
        last, before = over, room
        if part and part % PAIRS_EVERY == 0:
            near = layers(x, rest, far, 2.0 * apart, MOST_PAIRS * n)
        f[:] = 0.0
        walls = pressed = ox = oy = oz = 0.0
        for t in range(len(tris)):
            i, j, k = tris[t, 0], tris[t, 1], tris[t, 2]
            px, py, pz = x[j, 0] - x[i, 0], x[j, 1] - x[i, 1], x[j, 2] - x[i, 2]
            qx, qy, qz = x[k, 0] - x[i, 0], x[k, 1] - x[i, 1], x[k, 2] - x[i, 2]
            a, b, c, d = inverse[t, 0], inverse[t, 1], inverse[t, 2], inverse[t, 3]
            gx, gy, gz = px * a + qx * c, py * a + qy * c, pz * a + qz * c
            ex, ey, ez = px * b + qx * d, py * b + qy * d, pz * b + qz * d
            aa, ab, bb = gx * gx + gy * gy + gz * gz, gx * ex + gy * ey + gz * ez, ex * ex + ey * ey + ez * ez
            mean, turn = 0.5 * (aa + bb), np.sqrt(0.25 * (aa - bb) ** 2 + ab * ab)
            one, two = np.sqrt(mean + turn), np.sqrt(max(mean - turn, 1e-8))
            share, line = 1.0, 0.0
            if one <= 1.0:
                share = creased
            elif two * two * one < 1.0:
                share = creased
                line = (1.0 - creased) * (1.0 - one**-3)
                walls += (1.0 - creased) * 0.5 * mu * matter[t] * (one * one + 2.0 / one - 3.0)
            det = max(aa * bb - ab * ab, FLAT)
            walls += share * 0.5 * mu * matter[t] * (aa + bb + 1.0 / det - 3.0)
            w = share / (det * det) if aa * bb - ab * ab > FLAT else 0.0
            vx, vy = ab, one * one - aa
            if vx * vx + vy * vy < 1e-18:
                vx, vy = (1.0, 0.0) if aa >= bb else (0.0, 1.0)
            size = np.sqrt(vx * vx + vy * vy)
            vx, vy = vx / size, vy / size
            nx, ny, nz = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
            if i == hole_at or j == hole_at or k == hole_at:
                ox, oy, oz = ox + nx, oy + ny, oz + nz
            m = mu * matter[t]
            for z in range(3):
                g, e, normal = (gx, ex, nx) if z == 0 else (gy, ey, ny) if z == 1 else (gz, ez, nz)
                along = line * (g * vx + e * vy)
                s0 = m * (share * g - w * (bb * g - ab * e) + along * vx)
                s1 = m * (share * e - w * (aa * e - ab * g) + along * vy)
                fj, fk, push = s0 * a + s1 * b, s0 * c + s1 * d, normal * over / 6.0
                f[j, z] += push - fj
                f[k, z] += push - fk
                f[i, z] += push + fj + fk
        for r in range(len(edges)):
            i, j, k, o = edges[r, 0], edges[r, 1], edges[r, 2], edges[r, 3]
            far2 = along = 0.0
            for z in range(3):
                bent = bends[r, 0] * x[i, z] + bends[r, 1] * x[j, z] + bends[r, 2] * x[k, z] + bends[r, 3] * x[o, z]
                walls += 0.5 * bent * bent
                f[i, z] -= bends[r, 0] * bent
                f[j, z] -= bends[r, 1] * bent
                f[k, z] -= bends[r, 2] * bent
                f[o, z] -= bends[r, 3] * bent
                far2 += (x[j, z] - x[i, z]) ** 2
                along += (v[j, z] - v[i, z]) * (x[j, z] - x[i, z])
            by = gain * along / far2
            for z in range(3):
                f[i, z] += by * (x[j, z] - x[i, z])
                f[j, z] -= by * (x[j, z] - x[i, z])
        for r in range(len(near)):
            i, j = near[r, 0], near[r, 1]
            dx, dy, dz = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1], x[i, 2] - x[j, 2]
            away = np.sqrt(dx * dx + dy * dy + dz * dz)
            if 1e-9 < away < apart:
                deep = apart - away
                going = ((v[i, 0] - v[j, 0]) * dx + (v[i, 1] - v[j, 1]) * dy + (v[i, 2] - v[j, 2]) * dz) / away
                by = max(hard * deep - 0.2 * np.sqrt(hard * mass[i]) * going, 0.0) / away
                pressed += 0.5 * hard * deep * deep
                f[i, 0], f[i, 1], f[i, 2] = f[i, 0] + by * dx, f[i, 1] + by * dy, f[i, 2] + by * dz
                f[j, 0], f[j, 1], f[j, 2] = f[j, 0] - by * dx, f[j, 1] - by * dy, f[j, 2] - by * dz
        if hole > 0.0 and over > 0.0:
            by = -2.0 * hole * over / max(np.sqrt(ox * ox + oy * oy + oz * oz), 1e-12)
            for z in range(3):
                push = by * (ox if z == 0 else oy if z == 1 else oz)
                f[hole_at, z] += push
                sums[z] -= h * push
                sums[3] += h * push * v[hole_at, z]  # the jet's push is the gas's work, too
            # No more than lets the gas down to the outside's pressure: a wide hole draws no vacuum.
            sums[6] -= min(h * hole * np.sqrt(2.0 * over / density) * outside, over * room) / warmth
        sums[4], sums[5] = walls, pressed
        if h == 0.0:
            break
        for i in range(n):
            for z in range(3):
                lost = air * mass[i] * v[i, z]
                sums[z] += h * lost
                f[i, z] -= lost
            deep = table - x[i, 2]
            if deep > 0.0:
                up = max(hard * deep - 0.5 * np.sqrt(hard * mass[i]) * v[i, 2], 0.0)
                sums[5] += 0.5 * hard * deep * deep
                by = min(grip * up / max(np.sqrt(v[i, 0] ** 2 + v[i, 1] ** 2), CREEP), 0.5 * mass[i] / h)
                for z in range(2):
                    sums[z] += h * by * v[i, z]
                    f[i, z] -= by * v[i, z]
                sums[2] -= h * up
                f[i, 2] += up
            for z in range(3):
                v[i, z] += h * (f[i, z] / mass[i] + gravity[z])
                x[i, z] += h * v[i, z]
