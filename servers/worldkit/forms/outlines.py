"""Lines and outlines in a plane: smoothed, thickened, and cut into convex cells."""

import numpy as np

Array = np.ndarray
EPS = 1e-12


def line(what: str, points: object, columns: int, least: int = 2) -> Array:
    """(N, columns) the points of a line, m, without repeated ones.

    Raises:
        ValueError: too few points, or numbers that are not finite.
    """
    found = np.array(points, dtype=float)
    if found.ndim != 2 or found.shape[1] != columns or not np.isfinite(found).all():
        raise ValueError(f"{what}: it takes a list of points of {columns} finite numbers each, in metres")
    kept = np.concatenate([[True], np.linalg.norm(np.diff(found, axis=0), axis=1) > 1e-9])
    if kept.sum() < least:
        raise ValueError(f"{what}: it takes at least {least} points apart from each other, got {int(kept.sum())}")
    return found[kept]


def smoothed(points: Array, smooth: int) -> Array:
    """The line with `smooth` points between each two, on the centripetal Catmull-Rom spline through all of them.

    It does not overshoot into loops. Source: C. Yuksel et al., "Parameterization and applications of Catmull-Rom curves".
    """
    if smooth < 1 or len(points) < 3:
        return points
    ends = np.concatenate([[2 * points[0] - points[1]], points, [2 * points[-1] - points[-2]]])
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ends, axis=0), axis=1) ** 0.5)])
    found = []
    for k in range(1, len(ends) - 2):
        p, t = ends[k - 1 : k + 3], knots[k - 1 : k + 3]
        u = np.linspace(t[1], t[2], smooth + 2)[:-1, None]

        def between(a: Array, b: Array, low: float, high: float, u: Array = u) -> Array:
            return ((high - u) * a + (u - low) * b) / (high - low)

        a = [between(p[i], p[i + 1], t[i], t[i + 1]) for i in range(3)]
        b = [between(a[i], a[i + 1], t[i], t[i + 2]) for i in range(2)]
        found.append(between(b[0], b[1], t[1], t[2]))
    return np.concatenate([*found, points[-1:]])


def thickened(points: Array, wall: float) -> Array:
    """(2 N, 2) the outline between a line and its parallel on the left of it, `wall` away, with mitred corners."""
    way = np.diff(points, axis=0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    left = np.stack([-way[:, 1], way[:, 0]], axis=1)
    before, after = np.concatenate([left[:1], left]), np.concatenate([left, left[-1:]])
    middle = before + after
    # A corner that folds back on itself has no mitre; three walls are as far as one may reach.
    reach = np.maximum((middle * after).sum(axis=1, keepdims=True), 2 / 3)
    return np.concatenate([points, (points + wall * middle / reach)[::-1]])


def area(outline: Array) -> float:
    """Of a polygon, positive when counter-clockwise."""
    x, y = outline.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def crosses_itself(outline: Array) -> bool:
    """Whether two sides of a polygon that are not neighbours meet."""
    a, b = outline, np.roll(outline, -1, axis=0)
    count = len(a)
    for i in range(count):
        for j in range(i + 2, count):
            if i == 0 and j == count - 1:
                continue
            d1, d2 = _turn(a[i], b[i], a[j]), _turn(a[i], b[i], b[j])
            d3, d4 = _turn(a[j], b[j], a[i]), _turn(a[j], b[j], b[i])
            if d1 * d2 < -(EPS**2) and d3 * d4 < -(EPS**2):
                return True
    return False


def triangles(outline: Array) -> list[tuple[int, int, int]]:
    """A simple counter-clockwise polygon as triangles, by cutting off its ears (G. Meisters, 1975)."""
    left = list(range(len(outline)))
    found = []
    while len(left) > 3:
        best: tuple[float, int] | None = None
        for k in range(len(left)):
            a, b, c = (outline[left[(k + d) % len(left)]] for d in (-1, 0, 1))
            twice = _turn(a, b, c)
            if twice <= EPS or any(
                _inside(outline[i], a, b, c) for i in left if i not in (left[k - 1], left[k], left[(k + 1) % len(left)])
            ):
                continue
            # The fattest ear first: slivers make poor pieces.
            fat = twice / (float(np.linalg.norm(c - a)) ** 2 + EPS)
            if best is None or fat > best[0]:
                best = (fat, k)
        k = best[1] if best else _flattest(outline, left)
        if best:
            found.append((left[k - 1], left[k], left[(k + 1) % len(left)]))
        del left[k]
    if len(left) == 3 and _turn(*(outline[i] for i in left)) > EPS:
        found.append((left[0], left[1], left[2]))
    return found


def cells(outline: Array) -> list[list[int]]:
    """A simple counter-clockwise polygon as few convex ones, each by its corners (S. Hertel and K. Mehlhorn, 1983)."""
    found = [list(t) for t in triangles(outline)]
    merged = True
    while merged:
        merged = False
        for i in range(len(found)):
            for j in range(i + 1, len(found)):
                whole = _joined(outline, found[i], found[j])
                if whole is not None:
                    found[i] = whole
                    del found[j]
                    merged = True
                    break
            if merged:
                break
    return found


def _joined(outline: Array, one: list[int], other: list[int]) -> list[int] | None:
    """Two polygons that share a side as one, when that is convex."""
    for k in range(len(one)):
        a, b = one[k], one[(k + 1) % len(one)]
        if b in other and other[(other.index(b) + 1) % len(other)] == a:
            at = other.index(a)
            inner = [other[(at + d) % len(other)] for d in range(1, len(other) - 1)]
            whole = one[: k + 1] + inner + one[k + 1 :]
            corners = outline[whole]
            bends = [
                _turn(corners[i - 1], corners[i], corners[(i + 1) % len(whole)]) >= -EPS for i in range(len(whole))
            ]
            return whole if all(bends) else None
    return None


def _turn(a: Array, b: Array, c: Array) -> float:
    """Twice the area of a triangle, positive when counter-clockwise."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _inside(p: Array, a: Array, b: Array, c: Array) -> bool:
    if min(np.abs(p - corner).max() for corner in (a, b, c)) < EPS:
        return False
    return _turn(a, b, p) >= -EPS and _turn(b, c, p) >= -EPS and _turn(c, a, p) >= -EPS


def _flattest(outline: Array, left: list[int]) -> int:
    """The corner whose loss changes the outline least."""
    turns = [abs(_turn(*(outline[left[(k + d) % len(left)]] for d in (-1, 0, 1)))) for k in range(len(left))]
    return int(np.argmin(turns))
