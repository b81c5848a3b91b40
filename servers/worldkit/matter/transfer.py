"""From points to a grid and back: moving least squares material points (MLS-MPM), with walls that cut the grid.

Quadratic B-splines, affine velocities (APIC), stress by moving least squares: Hu et al. 2018, "A Moving Least Squares Material Point
Method with Displacement Discontinuity and Two-Way Rigid Body Coupling". A node that lies behind a wall as seen from a point that
gives to it may not move into that wall, so that a wall may be thinner than a cell; and no point passes one. What walls take from
nodes and points, at their places, is what bodies feel: momentum and angular momentum of all together are kept to rounding.
"""

import numpy as np

from .kernels import kernel

MOST_PLANES = 6
"""Walls that one point can be near."""
LIFT = 0.25
"""Cells by which a node may be before a wall and still be of it."""
SLOTS = 3
"""Walls that hold one node."""


@kernel
def scatter(
    x, v, c, tau, count, masses, density, dt, origin, shape, dx, grid, touched, planes, walls, near, held, holds,
):  # fmt: skip
    """Sum mass and momentum of the points onto the grid.

    Args: x, v (n, 3), c (n, 3, 3) 1/s, tau (n, 6) Pa, masses (n,) kg; grid (nodes, 4) zero, touched (nodes,) room; planes (n, 6, 4):
    normal and offset, walls (n, 6): whose, near (n,): how many; held (nodes,) -1; holds (h, 3, 4) room: sums of normals, whose.

    Returns how many nodes were touched, and held; -1 where a point left the grid.
    """
    inv, used, kept = 1.0 / dx, 0, 0
    wx, wy, wz = np.empty(3), np.empty(3), np.empty(3)
    a, holding = np.empty((3, 3)), np.empty(MOST_PLANES, np.int64)
    for p in range(count):
        gx, gy, gz = (x[p, 0] - origin[0]) * inv, (x[p, 1] - origin[1]) * inv, (x[p, 2] - origin[2]) * inv
        if not (1.0 < gx < shape[0] - 2 and 1.0 < gy < shape[1] - 2 and 1.0 < gz < shape[2] - 2):
            return -1, 0
        bx, by, bz = int(gx - 0.5), int(gy - 0.5), int(gz - 0.5)
        fx, fy, fz = gx - bx, gy - by, gz - bz
        wx[0], wx[1], wx[2] = 0.5 * (1.5 - fx) ** 2, 0.75 - (fx - 1.0) ** 2, 0.5 * (fx - 0.5) ** 2
        wy[0], wy[1], wy[2] = 0.5 * (1.5 - fy) ** 2, 0.75 - (fy - 1.0) ** 2, 0.5 * (fy - 0.5) ** 2
        wz[0], wz[1], wz[2] = 0.5 * (1.5 - fz) ** 2, 0.75 - (fz - 1.0) ** 2, 0.5 * (fz - 0.5) ** 2
        mass = masses[p]
        s = -dt * mass / density * 4.0 * inv * inv
        a[0, 0], a[1, 1], a[2, 2] = s * tau[p, 0], s * tau[p, 1], s * tau[p, 2]
        a[0, 1] = a[1, 0] = s * tau[p, 3]
        a[0, 2] = a[2, 0] = s * tau[p, 4]
        a[1, 2] = a[2, 1] = s * tau[p, 5]
        for i in range(3):
            for j in range(3):
                a[i, j] += mass * c[p, i, j]
        mx, my, mz = mass * v[p, 0], mass * v[p, 1], mass * v[p, 2]
        walled = 0
        for h in range(near[p]):  # those that hold any of its nodes
            n = planes[p, h]
            nodes = n[0] * x[p, 0] + n[1] * x[p, 1] + n[2] * x[p, 2] - n[3]
            nodes += dx * (min(-n[0] * fx, n[0] * (2 - fx)) + min(-n[1] * fy, n[1] * (2 - fy)))
            nodes += dx * min(-n[2] * fz, n[2] * (2 - fz))
            if nodes < (LIFT + 1e-9) * dx:
                holding[walled] = h
                walled += 1
        for i in range(3):
            ox = (i - fx) * dx
            for j in range(3):
                oy, wij = (j - fy) * dx, wx[i] * wy[j]
                row = ((bx + i) * shape[1] + by + j) * shape[2] + bz
                for k in range(3):
                    oz, w = (k - fz) * dx, wij * wz[k]
                    node = row + k
                    if grid[node, 3] == 0.0:
                        touched[used] = node
                        used += 1
                    grid[node, 0] += w * (mx + a[0, 0] * ox + a[0, 1] * oy + a[0, 2] * oz)
                    grid[node, 1] += w * (my + a[1, 0] * ox + a[1, 1] * oy + a[1, 2] * oz)
                    grid[node, 2] += w * (mz + a[2, 0] * ox + a[2, 1] * oy + a[2, 2] * oz)
                    grid[node, 3] += w * mass + 1e-300
                    for which in range(walled):
                        h = holding[which]
                        n = planes[p, h]
                        if n[0] * (x[p, 0] + ox) + n[1] * (x[p, 1] + oy) + n[2] * (x[p, 2] + oz) >= n[3] + LIFT * dx:
                            continue
                        if held[node] < 0:
                            held[node] = kept
                            for slot in range(SLOTS):
                                holds[kept, slot, 3] = -1.0
                            kept += 1
                        mine = holds[held[node]]
                        for slot in range(SLOTS):
                            r = mine[slot]
                            if r[3] < 0.0:
                                r[0], r[1], r[2], r[3] = w * n[0], w * n[1], w * n[2], walls[p, h]
                                break
                            along = r[0] * n[0] + r[1] * n[1] + r[2] * n[2]
                            if r[3] == walls[p, h] and along > 0.8 * np.sqrt(r[0] ** 2 + r[1] ** 2 + r[2] ** 2):
                                r[0] += w * n[0]
                                r[1] += w * n[1]
                                r[2] += w * n[2]
                                break
    return used, kept


@kernel
def turn(origin, shape, dx, dt, gravity, grid, touched, used, held, holds, bodies, push, friction, sticks):
    """Make velocities of momenta, (nodes, 4), let them fall, and stop them at walls; arguments as `scatter`.

    bodies (k, 9): middle, velocity, spin; push (k, 6) N s, N m s is added to.
    """
    u, n = np.empty(3), np.empty(3)
    for at in range(used):
        node = touched[at]
        mass = grid[node, 3]
        for r in range(3):
            u[r] = grid[node, r] / mass + dt * gravity[r]
        if held[node] >= 0:
            k = node % shape[2]
            j = (node // shape[2]) % shape[1]
            i = node // (shape[1] * shape[2])
            ax, ay, az = origin[0] + i * dx, origin[1] + j * dx, origin[2] + k * dx
            for slot in range(SLOTS):
                r = holds[held[node], slot]
                if r[3] < 0.0:
                    break
                size = np.sqrt(r[0] ** 2 + r[1] ** 2 + r[2] ** 2)
                if size > 0.0:
                    n[0], n[1], n[2] = r[0] / size, r[1] / size, r[2] / size
                    stop(u, n, ax, ay, az, bodies, int(r[3]), push, mass, friction, sticks)
            held[node] = -1
        for r in range(3):
            grid[node, r] = u[r]


@kernel
def stop(u, n, ax, ay, az, bodies, wall, push, mass, friction, sticks):
    """Change a velocity u (3,) at a place, so that it does not go into the wall; the wall feels what it loses."""
    b = bodies[wall]
    rx, ry, rz = ax - b[0], ay - b[1], az - b[2]
    lx = u[0] - b[3] - (b[7] * rz - b[8] * ry)
    ly = u[1] - b[4] - (b[8] * rx - b[6] * rz)
    lz = u[2] - b[5] - (b[6] * ry - b[7] * rx)
    into = lx * n[0] + ly * n[1] + lz * n[2]
    if into >= 0.0 and not sticks:
        return
    tx, ty, tz = lx - into * n[0], ly - into * n[1], lz - into * n[2]
    into = min(into, 0.0)
    slows = 1.0
    if not sticks:
        slides = np.sqrt(tx * tx + ty * ty + tz * tz)
        slows = min(1.0, -friction * into / slides) if slides > 1e-12 else 0.0
    jx, jy, jz = -into * n[0] - slows * tx, -into * n[1] - slows * ty, -into * n[2] - slows * tz
    u[0] += jx
    u[1] += jy
    u[2] += jz
    jx, jy, jz = mass * jx, mass * jy, mass * jz
    f = push[wall]
    f[0] -= jx
    f[1] -= jy
    f[2] -= jz
    f[3] -= ry * jz - rz * jy
    f[4] -= rz * jx - rx * jz
    f[5] -= rx * jy - ry * jx


@kernel
def gather(
    x, v, c, count, masses, dt, origin, shape, dx, grid, touched, used, planes, walls, near, bodies, push, friction,
    sticks, crowd,
):  # fmt: skip
    """Read the points' velocities and their slopes from the grid, move the points, and clear the grid; arguments as `scatter`.

    crowd (n,) kg/m^3: density as the grid has it, too low within three cells of a wall.
    """
    inv = 1.0 / dx
    scale = 4.0 * inv * inv
    wx, wy, wz = np.empty(3), np.empty(3), np.empty(3)
    u = np.empty(3)
    for p in range(count):
        gx, gy, gz = (x[p, 0] - origin[0]) * inv, (x[p, 1] - origin[1]) * inv, (x[p, 2] - origin[2]) * inv
        bx, by, bz = int(gx - 0.5), int(gy - 0.5), int(gz - 0.5)
        fx, fy, fz = gx - bx, gy - by, gz - bz
        wx[0], wx[1], wx[2] = 0.5 * (1.5 - fx) ** 2, 0.75 - (fx - 1.0) ** 2, 0.5 * (fx - 0.5) ** 2
        wy[0], wy[1], wy[2] = 0.5 * (1.5 - fy) ** 2, 0.75 - (fy - 1.0) ** 2, 0.5 * (fy - 0.5) ** 2
        wz[0], wz[1], wz[2] = 0.5 * (1.5 - fz) ** 2, 0.75 - (fz - 1.0) ** 2, 0.5 * (fz - 0.5) ** 2
        vx = vy = vz = 0.0
        c00 = c01 = c02 = c10 = c11 = c12 = c20 = c21 = c22 = 0.0
        dense = 0.0
        for i in range(3):
            ox = (i - fx) * dx
            for j in range(3):
                oy, wij = (j - fy) * dx, wx[i] * wy[j]
                row = ((bx + i) * shape[1] + by + j) * shape[2] + bz
                for k in range(3):
                    oz, w = (k - fz) * dx, wij * wz[k]
                    node = row + k
                    ux, uy, uz = w * grid[node, 0], w * grid[node, 1], w * grid[node, 2]
                    dense += w * grid[node, 3]
                    vx += ux
                    vy += uy
                    vz += uz
                    c00 += ux * ox
                    c01 += ux * oy
                    c02 += ux * oz
                    c10 += uy * ox
                    c11 += uy * oy
                    c12 += uy * oz
                    c20 += uz * ox
                    c21 += uz * oy
                    c22 += uz * oz
        crowd[p] = dense * inv * inv * inv
        u[0], u[1], u[2] = vx, vy, vz
        c[p, 0, 0], c[p, 0, 1], c[p, 0, 2] = scale * c00, scale * c01, scale * c02
        c[p, 1, 0], c[p, 1, 1], c[p, 1, 2] = scale * c10, scale * c11, scale * c12
        c[p, 2, 0], c[p, 2, 1], c[p, 2, 2] = scale * c20, scale * c21, scale * c22
        for h in range(near[p]):  # what the grid lets through, the point itself does not: no leaks
            n = planes[p, h]
            gap = n[0] * x[p, 0] + n[1] * x[p, 1] + n[2] * x[p, 2] - n[3]
            if gap < 0.1 * dx:
                stop(
                    u,
                    n,
                    x[p, 0],
                    x[p, 1],
                    x[p, 2],
                    bodies,
                    walls[p, h],
                    push,
                    masses[p],
                    friction,
                    sticks and gap < 0.0,
                )
            b = bodies[walls[p, h]]
            rx, ry, rz = x[p, 0] - b[0], x[p, 1] - b[1], x[p, 2] - b[2]
            n[3] += dt * (
                n[0] * (b[3] + b[7] * rz - b[8] * ry)
                + n[1] * (b[4] + b[8] * rx - b[6] * rz)
                + n[2] * (b[5] + b[6] * ry - b[7] * rx)
            )
        for r in range(3):
            v[p, r] = u[r]
            x[p, r] += dt * u[r]
        for h in range(near[p]):
            n = planes[p, h]
            gap = n[0] * x[p, 0] + n[1] * x[p, 1] + n[2] * x[p, 2] - n[3]
            if gap < 0.0:
                for r in range(3):
                    x[p, r] -= gap * n[r]
    for at in range(used):
        grid[touched[at], :] = 0.0
