"""One step of a lattice's nodes: strain at each point of a cell, the stress that the law makes of it, and what walls push back.

What yields has the mean swelling of its cell at all eight points: de Souza Neto et al. 1996, "Design of simple low order finite elements
for large strain analysis of nearly incompressible solids" (F-bar).
"""

import numpy as np

from .kernels import kernel
from .principal import principal

FLATTEST = 0.02
"""No point counts as pressed to less of its volume than this."""
RESTS = 0.15
"""What creeps bears so much of its yield stress for ever."""
DAMPED = 0.6
"""Of what would just keep a node from bouncing off a wall, twice the share that acts."""


@kernel
def slope(values, cell, slopes, out):
    """Write how values (n, 3) of a cell's nodes change with place, by slopes (8, 3), into out (3, 3)."""
    for i in range(3):
        for j in range(3):
            out[i, j] = 0.0
    for k in range(8):
        n = cell[k]
        for j in range(3):
            s = slopes[k, j]
            for i in range(3):
                out[i, j] += values[n, i] * s


@kernel
def pulled(x, v, cells, slopes, room, kept, lam, mu, most, left, eta, force):
    """Add to force (n, 3), N, what strain makes of it; returns J stored. kept (c, 8, 6): inverse right Cauchy-Green of what yielded.

    Of the shear above `RESTS` times what `most`, Pa, allows, the share `left` is left after this step.
    """
    g, inv, a, q = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    tau, t, e = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    stored, limit = 0.0, most / (2.0 * mu) * np.sqrt(2.0 / 3.0)
    all_f, swells = np.empty((8, 3, 3)), np.empty(8)
    for c in range(len(cells)):
        mean_swell, whole = 0.0, 0.0
        for p in range(8):
            f = all_f[p]
            slope(x, cells[c], slopes[c, p], f)
            swells[p] = max(
                f[0, 0] * (f[1, 1] * f[2, 2] - f[1, 2] * f[2, 1])
                - f[0, 1] * (f[1, 0] * f[2, 2] - f[1, 2] * f[2, 0])
                + f[0, 2] * (f[1, 0] * f[2, 1] - f[1, 1] * f[2, 0]),
                FLATTEST,
            )
            mean_swell += room[c, p] * swells[p]
            whole += room[c, p]
        mean_swell /= whole
        for p in range(8):
            f = all_f[p]
            if eta > 0.0:
                slope(v, cells[c], slopes[c, p], g)
            for i in range(3):
                for j in range(3):
                    i1, i2, j1, j2 = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
                    inv[j, i] = f[i1, j1] * f[i2, j2] - f[i1, j2] * f[i2, j1]
            swollen = swells[p]
            for i in range(3):
                for j in range(3):
                    inv[i, j] /= swollen
            m = kept[c, p]
            for i in range(3):
                t[i, 0] = f[i, 0] * m[0] + f[i, 1] * m[3] + f[i, 2] * m[4]
                t[i, 1] = f[i, 0] * m[3] + f[i, 1] * m[1] + f[i, 2] * m[5]
                t[i, 2] = f[i, 0] * m[4] + f[i, 1] * m[5] + f[i, 2] * m[2]
            for i in range(3):
                for j in range(3):
                    a[i, j] = t[i, 0] * f[j, 0] + t[i, 1] * f[j, 1] + t[i, 2] * f[j, 2]
            if most <= 0.0:
                swell = np.log(swollen)
                for i in range(3):
                    for j in range(3):
                        tau[i, j] = mu * a[i, j]
                    tau[i, i] += lam * swell - mu
                stored += room[c, p] * (
                    0.5 * mu * (a[0, 0] + a[1, 1] + a[2, 2] - 3.0 - 2.0 * swell) + 0.5 * lam * swell * swell
                )
            else:
                # F-bar: what flows without a change of volume would lock a cell.
                even = (mean_swell / swollen) ** (2.0 / 3.0)
                for i in range(3):
                    for j in range(3):
                        a[i, j] *= even
                principal(a, q)
                for i in range(3):
                    e[i] = 0.5 * np.log(max(a[i, i], 1e-9))
                mean = (e[0] + e[1] + e[2]) / 3.0
                shear = np.sqrt((e[0] - mean) ** 2 + (e[1] - mean) ** 2 + (e[2] - mean) ** 2)
                bears = min(shear, limit)
                if bears > RESTS * limit:
                    bears = RESTS * limit + left * (bears - RESTS * limit)
                if bears < shear:
                    for i in range(3):
                        e[i] = mean + bears / shear * (e[i] - mean)
                    for i in range(3):  # what is left of the elastic part tells what has yielded: F^-1 b F^-T
                        for j in range(3):
                            a[i, j] = 0.0
                            for r in range(3):
                                a[i, j] += np.exp(2.0 * e[r]) / even * q[i, r] * q[j, r]
                    for i in range(3):
                        for j in range(3):
                            t[i, j] = inv[i, 0] * a[0, j] + inv[i, 1] * a[1, j] + inv[i, 2] * a[2, j]
                    m[0] = t[0, 0] * inv[0, 0] + t[0, 1] * inv[0, 1] + t[0, 2] * inv[0, 2]
                    m[1] = t[1, 0] * inv[1, 0] + t[1, 1] * inv[1, 1] + t[1, 2] * inv[1, 2]
                    m[2] = t[2, 0] * inv[2, 0] + t[2, 1] * inv[2, 1] + t[2, 2] * inv[2, 2]
                    m[3] = t[0, 0] * inv[1, 0] + t[0, 1] * inv[1, 1] + t[0, 2] * inv[1, 2]
                    m[4] = t[0, 0] * inv[2, 0] + t[0, 1] * inv[2, 1] + t[0, 2] * inv[2, 2]
                    m[5] = t[1, 0] * inv[2, 0] + t[1, 1] * inv[2, 1] + t[1, 2] * inv[2, 2]
                for i in range(3):
                    for j in range(3):
                        tau[i, j] = 0.0
                        for r in range(3):
                            tau[i, j] += (2.0 * mu * e[r] + 3.0 * lam * mean) * q[i, r] * q[j, r]
                stored += room[c, p] * (mu * (e[0] ** 2 + e[1] ** 2 + e[2] ** 2) + 4.5 * lam * mean * mean)
            if eta > 0.0:  # twice the rate of strain
                for i in range(3):
                    for j in range(3):
                        t[i, j] = g[i, 0] * inv[0, j] + g[i, 1] * inv[1, j] + g[i, 2] * inv[2, j]
                for i in range(3):
                    for j in range(3):
                        tau[i, j] += eta * (t[i, j] + t[j, i])
            for i in range(3):
                for j in range(3):
                    t[i, j] = room[c, p] * (tau[i, 0] * inv[j, 0] + tau[i, 1] * inv[j, 1] + tau[i, 2] * inv[j, 2])
            for k in range(8):
                n = cells[c, k]
                for i in range(3):
                    force[n, i] -= (
                        t[i, 0] * slopes[c, p, k, 0] + t[i, 1] * slopes[c, p, k, 1] + t[i, 2] * slopes[c, p, k, 2]
                    )
    return stored


@kernel
def touched(x, v, mass, outer, area, planes, walls, near, held, bodies, stiff, rub, h, force, push):
    """Add to force what walls push back on outer nodes in them; push (k, 6) N s, N m s on the bodies is added to; returns J stored.

    Args: planes (m, 6, 4): normal and offset, walls (m, 6): whose, near (m,): how many; held (m, 4): where on its body, in the world's
    axes, a node sticks, and whose that is, -1 for nobody's; bodies (k, 9): middle, velocity, spin; stiff Pa/m.
    """
    stored = 0.0
    for m in range(len(outer)):
        n, deepest, wall = outer[m], 0.0, -1
        for w in range(near[m]):
            plane = planes[m, w]
            b = bodies[walls[m, w]]
            rx, ry, rz = x[n, 0] - b[0], x[n, 1] - b[1], x[n, 2] - b[2]
            comes = (
                plane[0] * (b[3] + b[7] * rz - b[8] * ry)
                + plane[1] * (b[4] + b[8] * rx - b[6] * rz)
                + plane[2] * (b[5] + b[6] * ry - b[7] * rx)
            )
            plane[3] += h * comes
            deep = plane[3] - plane[0] * x[n, 0] - plane[1] * x[n, 1] - plane[2] * x[n, 2]
            if deep > 0.0:
                spring = stiff * area[m]
                stored += 0.5 * spring * deep * deep
                leaves = plane[0] * v[n, 0] + plane[1] * v[n, 1] + plane[2] * v[n, 2] - comes
                size = max(spring * deep - DAMPED * np.sqrt(spring * mass[n]) * leaves, 0.0)  # it pulls at nothing
                given(n, rx, ry, rz, plane[0], plane[1], plane[2], size, h, force, push[walls[m, w]])
                if deep > deepest:
                    deepest, wall = deep, w
        if wall < 0:
            held[m, 3] = -1.0
            continue
        plane, body = planes[m, wall], walls[m, wall]
        b, spring = bodies[body], stiff * area[m]
        rx, ry, rz = x[n, 0] - b[0], x[n, 1] - b[1], x[n, 2] - b[2]
        if held[m, 3] != body:
            held[m, 0], held[m, 1], held[m, 2], held[m, 3] = rx, ry, rz, body
        else:  # the place turns with its body
            sx, sy, sz = held[m, 0], held[m, 1], held[m, 2]
            held[m, 0] += h * (b[7] * sz - b[8] * sy)
            held[m, 1] += h * (b[8] * sx - b[6] * sz)
            held[m, 2] += h * (b[6] * sy - b[7] * sx)
        tx, ty, tz = rx - held[m, 0], ry - held[m, 1], rz - held[m, 2]
        along = tx * plane[0] + ty * plane[1] + tz * plane[2]
        tx, ty, tz = tx - along * plane[0], ty - along * plane[1], tz - along * plane[2]
        off, most = np.sqrt(tx * tx + ty * ty + tz * tz), rub * deepest
        if off > most:  # beyond friction it slides
            share = most / off
            tx, ty, tz = share * tx, share * ty, share * tz
            held[m, 0], held[m, 1], held[m, 2] = rx - tx, ry - ty, rz - tz
        stored += 0.5 * spring * (tx * tx + ty * ty + tz * tz)
        given(n, rx, ry, rz, tx, ty, tz, -spring, h, force, push[body])
    return stored


@kernel
def given(n, rx, ry, rz, wx, wy, wz, size, h, force, push):
    """Push node n along a way by so much, N, and its wall by the opposite."""
    fx, fy, fz = size * wx, size * wy, size * wz
    force[n, 0] += fx
    force[n, 1] += fy
    force[n, 2] += fz
    push[0] -= h * fx
    push[1] -= h * fy
    push[2] -= h * fz
    push[3] -= h * (ry * fz - rz * fy)
    push[4] -= h * (rz * fx - rx * fz)
    push[5] -= h * (rx * fy - ry * fx)


@kernel
def moved(x, v, mass, gravity, force, h):
    """Advance the nodes by h, symplectic."""
    for n in range(len(x)):
        for i in range(3):
            v[n, i] += h * (force[n, i] / mass[n] + gravity[i])
            x[n, i] += h * v[n, i]
            force[n, i] = 0.0
