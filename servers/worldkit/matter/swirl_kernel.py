"""Steps of a stirred liquid: depth-averaged flow with a free surface on a staggered grid (`stirred_vessels.Grid`); compiled.

The momentum equations stand in their vector-invariant form, with potential vorticity, which keeps energy where nothing rubs (Sadourny 1975),
written with lengths and areas so that rings and spokes are as good as rows and columns:

    d(u d)/dt = q V - D(g (h + b) + K),   d(v w)/dt = -q U - D(g (h + b) + K),   dh/dt = -div(U, V) / area

A rigid rotation has one vorticity, and neither friction within nor the grid brakes it. Depth flows out of no cell faster than it is there.
"""

import numpy as np

from .kernels import kernel

GRAVITY = 9.81
THIN = 2e-5
"""m: less deep is dry."""
EXPLICIT = 0.08
"""Of a cell squared over the step, at most so much viscosity: more would overshoot."""


@kernel
def advanced(
    h, u, v, bed, old_u, old_v, rounded, deep, wide, edge, area, dt, parts, gravity, eddies, still, floor_rub, slow_rub, wall_rub,
    cover, goes_u, goes_v, held, drain, lost,
):  # fmt: skip
    """Advance depth h (I, J) m and velocities u (I + 1, J), v (I, J) m/s by `parts` steps of dt.

    old_u, old_v are the last tendencies (Adams and Bashforth). eddies: m^2/s, viscosity within, and `still`, of what waves press together, both less near the middle of spokes, where they would
    take longer steps than dt; floor_rub: coefficient of quadratic friction
    there, slow_rub m/s of a linear one, wall_rub: coefficient at walls. cover (I, J): 1/s by which a tool takes the water along towards
    goes_u (I + 1, J) and goes_v (I, J) m/s; held (I, J, 2) is added what it gave, N s over density, across rows and columns. drain (I, J): m/s of depth that the
    floor lets out for each root of a metre of depth; returns m^3 that it let out.
    """
    rows, columns = h.shape
    q, kinetic = np.zeros((rows + 1, columns)), np.zeros((rows, columns))
    out_u, out_v = np.zeros((rows + 1, columns)), np.zeros((rows, columns))
    limit, squeezed = np.ones((rows, columns)), np.zeros((rows, columns))
    shear = np.zeros((rows + 1, columns))
    gone = 0.0
    for _part in range(parts):
        for i in range(1, rows):
            for j in range(columns):
                out_u[i, j] = u[i, j] * edge[i] * 0.5 * (h[i - 1, j] + h[i, j])
        for i in range(rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                out_v[i, j] = v[i, j] * deep * 0.5 * (h[i, k] + h[i, j])
        for i in range(1, rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                turning = v[i, j] * wide[i] - v[i - 1, j] * wide[i - 1] - deep * (u[i, j] - u[i, k])
                thick = 0.25 * (h[i, j] + h[i - 1, j] + h[i, k] + h[i - 1, k])
                q[i, j] = turning / (edge[i] * deep * max(thick, 1e-3))
                sheared = (v[i, j] / wide[i] - v[i - 1, j] / wide[i - 1]) * edge[i] / deep + (u[i, j] - u[i, k]) / edge[
                    i
                ]
                shear[i, j] = min(eddies, EXPLICIT * min(edge[i], deep) ** 2 / dt) * thick * sheared
        if rounded:
            round_it, thick = 0.0, 0.0
            for j in range(columns):
                round_it += v[0, j] * wide[0]
                thick += h[0, j] / columns
            round_it /= np.pi * 0.25 * deep * deep
            for j in range(columns):
                q[0, j] = round_it / max(thick, 1e-3)
        for i in range(rows):
            for j in range(columns):
                n = j + 1 if j + 1 < columns else 0
                across = (u[i, j] * u[i, j] * edge[i] + u[i + 1, j] * u[i + 1, j] * edge[i + 1]) * deep
                along = (v[i, j] * v[i, j] + v[i, n] * v[i, n]) * wide[i] * deep
                kinetic[i, j] = 0.25 * (across + along) / area[i]
                parts_from = u[i + 1, j] * edge[i + 1] - u[i, j] * edge[i] + (v[i, n] - v[i, j]) * deep
                squeezed[i, j] = min(still, EXPLICIT * min(wide[i], deep) ** 2 / dt) * parts_from / area[i] * h[i, j]
        for i in range(1, rows):
            for j in range(columns):
                n = j + 1 if j + 1 < columns else 0
                turns = 0.25 * (q[i, j] * (out_v[i, j] + out_v[i - 1, j]) + q[i, n] * (out_v[i, n] + out_v[i - 1, n]))
                thick = max(0.5 * (h[i, j] + h[i - 1, j]), 1e-3)
                rubs = ((shear[i, n] - shear[i, j]) / edge[i] + (squeezed[i, j] - squeezed[i - 1, j]) / deep) / thick
                now = (turns - kinetic[i, j] + kinetic[i - 1, j]) / deep + rubs
                falls = gravity * (h[i, j] + bed[i, j] - h[i - 1, j] - bed[i - 1, j]) / deep
                u[i, j] += dt * (1.5 * now - 0.5 * old_u[i, j] - falls)
                old_u[i, j] = now
        for i in range(rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                turns = 0.25 * (
                    q[i, j] * (out_u[i, j] + out_u[i, k]) + q[i + 1, j] * (out_u[i + 1, j] + out_u[i + 1, k])
                )
                thick = max(0.5 * (h[i, j] + h[i, k]), 1e-3)
                rubs = (edge[i + 1] ** 2 * shear[i + 1, j] - edge[i] ** 2 * shear[i, j]) / (wide[i] ** 2 * deep)
                rubs = (rubs + (squeezed[i, j] - squeezed[i, k]) / wide[i]) / thick
                now = (-turns - kinetic[i, j] + kinetic[i, k]) / wide[i] + rubs
                falls = gravity * (h[i, j] + bed[i, j] - h[i, k] - bed[i, k]) / wide[i]
                v[i, j] += dt * (1.5 * now - 0.5 * old_v[i, j] - falls)
                old_v[i, j] = now
        # What rubs, and what a tool takes along: each is implicit, so that none turns a flow round.
        for i in range(1, rows):
            for j in range(columns):
                thick = 0.5 * (h[i, j] + h[i - 1, j])
                if (h[i - 1, j] if u[i, j] > 0 else h[i, j]) <= THIN:
                    u[i, j] = 0.0
                    continue
                rate = (floor_rub * abs(u[i, j]) + slow_rub) / max(thick, 1e-4)
                if not rounded and (j == 0 or j == columns - 1):
                    rate += wall_rub * abs(u[i, j]) / wide[i]
                u[i, j] /= 1.0 + dt * rate
                takes = dt * 0.5 * (cover[i, j] + cover[i - 1, j])
                if takes > 0.0:
                    before = u[i, j]
                    u[i, j] = (before + takes * goes_u[i, j]) / (1.0 + takes)
                    given = (u[i, j] - before) * thick * edge[i] * deep
                    share = cover[i, j] / (cover[i, j] + cover[i - 1, j])
                    held[i, j, 0] += share * given
                    held[i - 1, j, 0] += (1.0 - share) * given
        for i in range(rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                if not rounded and j == 0:
                    v[i, j] = 0.0
                    continue
                thick = 0.5 * (h[i, j] + h[i, k])
                if (h[i, k] if v[i, j] > 0 else h[i, j]) <= THIN:
                    v[i, j] = 0.0
                    continue
                rate = (floor_rub * abs(v[i, j]) + slow_rub) / max(thick, 1e-4)
                if i == rows - 1:
                    rate += wall_rub * abs(v[i, j]) * edge[rows] / area[i]
                if i == 0 and not rounded:
                    rate += wall_rub * abs(v[i, j]) / deep
                v[i, j] /= 1.0 + dt * rate
                takes = dt * 0.5 * (cover[i, j] + cover[i, k])
                if takes > 0.0:
                    before = v[i, j]
                    v[i, j] = (before + takes * goes_v[i, j]) / (1.0 + takes)
                    given = (v[i, j] - before) * thick * area[i]
                    share = cover[i, j] / (cover[i, j] + cover[i, k])
                    held[i, j, 1] += share * given
                    held[i, k, 1] += (1.0 - share) * given
        # Depth: of what lies about level the mean flows, else what comes from upstream; from no cell more than it has.
        for i in range(1, rows):
            for j in range(columns):
                out_u[i, j] = u[i, j] * edge[i] * flowing(h[i - 1, j], h[i, j], u[i, j])
        for i in range(rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                out_v[i, j] = v[i, j] * deep * flowing(h[i, k], h[i, j], v[i, j])
        for i in range(rows):
            for j in range(columns):
                n = j + 1 if j + 1 < columns else 0
                leaves = (
                    max(-out_u[i, j], 0.0) + max(out_u[i + 1, j], 0.0) + max(-out_v[i, j], 0.0) + max(out_v[i, n], 0.0)
                )
                has = 0.5 * h[i, j] * area[i]
                limit[i, j] = 1.0 if dt * leaves <= has else has / (dt * leaves)
        for i in range(1, rows):
            for j in range(columns):
                out_u[i, j] *= limit[i - 1, j] if out_u[i, j] > 0 else limit[i, j]
        for i in range(rows):
            for j in range(columns):
                k = j - 1 if j > 0 else columns - 1
                out_v[i, j] *= limit[i, k] if out_v[i, j] > 0 else limit[i, j]
        for i in range(rows):
            for j in range(columns):
                n = j + 1 if j + 1 < columns else 0
                h[i, j] -= dt * (out_u[i + 1, j] - out_u[i, j] + out_v[i, n] - out_v[i, j]) / area[i]
                if drain[i, j] > 0.0 and h[i, j] > THIN:
                    leaves = min(dt * drain[i, j] * np.sqrt(h[i, j]), 0.5 * h[i, j])
                    h[i, j] -= leaves
                    gone += leaves * area[i]
                    lost[i, j] += leaves * area[i]
    return gone


@kernel
def flowing(before, after, speed):
    """m: the depth that flows between two cells."""
    mean = 0.5 * (before + after)
    if abs(before - after) < 0.4 * mean:
        return mean
    return before if speed > 0.0 else after


@kernel
def centred(u, v, rounded, turn, ways):
    """ways (I, J, 2) becomes the velocity in the middle of the cells, m/s along x and y."""
    rows, columns = v.shape
    for i in range(rows):
        for j in range(columns):
            n = j + 1 if j + 1 < columns else 0
            across, along = 0.5 * (u[i, j] + u[i + 1, j]), 0.5 * (v[i, j] + v[i, n])
            if i == 0 and rounded:
                across = u[1, j] * 0.5
            if rounded:
                a = (j + 0.5) * turn
                ways[i, j, 0] = across * np.cos(a) - along * np.sin(a)
                ways[i, j, 1] = across * np.sin(a) + along * np.cos(a)
            else:
                ways[i, j, 0], ways[i, j, 1] = across, along


@kernel
def covered(x, y, h, bed, spread, rounded, middle, deep, reach, samples, ways, sizes, owners, cover, goes, whose):
    """What lies in the liquid of tools: samples (s, 3) m that go at ways (s, 3) m/s, each of `sizes` (s,) m^3 of body owners (s,).

    Adds to cover (I, J) the share of each column's room that they take, of which each is spread over a disc of the radius `spread` m; goes (I, J, 2) becomes
    their mean velocity, whose (I, J) the body that has most there, -1 where there is none.
    """
    rows, columns = h.shape
    most = np.zeros((rows, columns))
    cover[:], goes[:], whose[:] = 0.0, 0.0, -1
    norm = 3.0 / (np.pi * spread * spread)
    for s in range(len(samples)):
        dx, dy = samples[s, 0] - middle[0], samples[s, 1] - middle[1]
        far = np.sqrt(dx * dx + dy * dy) if rounded else dx + reach[0]
        for i in range(max(int((far - spread) / deep - 1.0), 0), min(int((far + spread) / deep + 1.0), rows)):
            for j in range(columns):
                away = ((x[i, j] - samples[s, 0]) ** 2 + (y[i, j] - samples[s, 1]) ** 2) / (spread * spread)
                if away >= 1.0 or samples[s, 2] > bed[i, j] + h[i, j] or samples[s, 2] < bed[i, j] or h[i, j] <= THIN:
                    continue
                share = sizes[s] * norm * (1.0 - away) ** 2 / h[i, j]
                cover[i, j] += share
                goes[i, j, 0] += share * ways[s, 0]
                goes[i, j, 1] += share * ways[s, 1]
                if share > most[i, j]:
                    most[i, j], whose[i, j] = share, owners[s]
    for i in range(rows):
        for j in range(columns):
            if cover[i, j] > 0.0:
                goes[i, j, 0] /= cover[i, j]
                goes[i, j, 1] /= cover[i, j]
                cover[i, j] = min(cover[i, j], 1.0)


@kernel
def within(row, column, rows, columns, rounded):
    """The cell of a field that stands for one beyond its rim, or beyond the middle of a round one."""
    if rounded:
        if row < 0:
            row, column = -1 - row, column + columns // 2
        column %= columns
    else:
        row, column = max(row, 0), min(max(column, 0), columns - 1)
    return min(row, rows - 1), column


@kernel
def sampled(field, rounded, i, j):
    """A field (I, J) of the cells at a place counted in rows and columns, between the middles of cells."""
    rows, columns = field.shape
    i, j = i - 0.5, j - 0.5
    a, b = int(np.floor(i)), int(np.floor(j))
    fi, fj = i - a, j - b
    total = 0.0
    for di in range(2):
        for dj in range(2):
            row, column = within(a + di, b + dj, rows, columns, rounded)
            total += (fi if di else 1.0 - fi) * (fj if dj else 1.0 - fj) * field[row, column]
    return total


@kernel
def counted(x, y, rounded, middle, deep, turn, wide, reach):
    """Rows and columns of a place, m."""
    if rounded:
        dx, dy = x - middle[0], y - middle[1]
        return np.sqrt(dx * dx + dy * dy) / deep, (np.arctan2(dy, dx) % (2 * np.pi)) / turn
    return (x - middle[0] + reach[0]) / deep, (y - middle[1] + reach[1]) / wide


@kernel
def carried(places, ways, rounded, middle, deep, turn, wide, reach, room, seconds):
    """Carry places (n, 2) m with the velocities ways (2, I, J) for some seconds, by the midpoint; they stay `room` m from walls."""
    for p in range(len(places)):
        x, y = places[p, 0], places[p, 1]
        for half in range(2):
            i, j = counted(x, y, rounded, middle, deep, turn, wide, reach)
            goes_x, goes_y = sampled(ways[0], rounded, i, j), sampled(ways[1], rounded, i, j)
            share = 0.5 if half == 0 else 1.0
            x, y = places[p, 0] + share * seconds * goes_x, places[p, 1] + share * seconds * goes_y
        if rounded:
            far = np.sqrt((x - middle[0]) ** 2 + (y - middle[1]) ** 2)
            if far > reach[0] - room:
                x = middle[0] + (x - middle[0]) * (reach[0] - room) / far
                y = middle[1] + (y - middle[1]) * (reach[0] - room) / far
        else:
            x = min(max(x, middle[0] - reach[0] + room), middle[0] + reach[0] - room)
            y = min(max(y, middle[1] - reach[1] + room), middle[1] + reach[1] - room)
        places[p, 0], places[p, 1] = x, y


@kernel
def read(places, field, rounded, middle, deep, turn, wide, reach, found):
    """found (n,) becomes a field (I, J) at places (n, 2) m."""
    for p in range(len(places)):
        i, j = counted(places[p, 0], places[p, 1], rounded, middle, deep, turn, wide, reach)
        found[p] = sampled(field, rounded, i, j)


@kernel
def cubic(t, w):
    """w (4,) become Catmull and Rom's weights."""
    w[0] = -0.5 * t + t * t - 0.5 * t * t * t
    w[1] = 1.0 - 2.5 * t * t + 1.5 * t * t * t
    w[2] = 0.5 * t + 2.0 * t * t - 1.5 * t * t * t
    w[3] = -0.5 * t * t + 0.5 * t * t * t


@kernel
def dyed(dye, fresh, x, y, ways, rounded, middle, deep, turn, wide, reach, own_deep, own_turn, own_wide, seconds):
    """fresh (R, C, 3) becomes a colour field dye (R, C, 3) on the grid x, y (R, C) m carried for some seconds: each place gets what was upstream of
    it, by cubic weights kept within its neighbours.
    """
    rows, columns = x.shape
    wi, wj, at = np.zeros(4), np.zeros(4), np.zeros((1, 2))
    for a in range(rows):
        for b in range(columns):
            at[0, 0], at[0, 1] = x[a, b], y[a, b]
            carried(at, ways, rounded, middle, deep, turn, wide, reach, 0.0, -seconds)
            i, j = counted(at[0, 0], at[0, 1], rounded, middle, own_deep, own_turn, own_wide, reach)
            i, j = i - 0.5, j - 0.5
            p, s = int(np.floor(i)), int(np.floor(j))
            cubic(i - p, wi)
            cubic(j - s, wj)
            for k in range(3):
                total, low, high = 0.0, 1.0, 0.0
                for di in range(4):
                    for dj in range(4):
                        row, column = within(p + di - 1, s + dj - 1, rows, columns, rounded)
                        value = dye[row, column, k]
                        total += wi[di] * wj[dj] * value
                        if 0 < di < 3 and 0 < dj < 3:
                            low, high = min(low, value), max(high, value)
                fresh[a, b, k] = min(max(total, low), high)
