"""What a thin wall stores, by triangles that stretch and hinges that bend, with their forces and stiffness.

Stretching is that of a sheet in plane stress, on flat triangles of uniform strain (Cauchy-Green C = F^T F):

    plastic (Saint-Venant): W = t E / (2 (1 - nu^2)) ((1 - nu) G:G + nu tr(G)^2), G = (C - I) / 2
    rubber (neo-Hookean, incompressible): W = t mu / 2 (tr C + 1 / det C - 3), mu = E / 3

Bending is that of hinges: W = D / 2 e^2 / (A1 + A2) (theta - theta0)^2, D = E t^3 / (12 (1 - nu^2)), which is exact for a cylinder
whose lines run along edges, and for equilateral triangles; a hinge whose surface strain, t / 2 e / (A1 + A2) (theta - theta0), is
beyond the yield strain flows. Sources: Holzapfel, Nonlinear Solid Mechanics, chapter 6; Seung and Nelson 1988; Grinspun 2003.

Of the stiffness only what cannot push a step uphill is kept (compressed triangles lose that by stress, hinges that by turning): steps
go down in energy, and where they end does not depend on it.
"""

import numpy as np

Array = np.ndarray
_TWIST = np.array([[0.0, 4.0, 0.0], [4.0, 0.0, 0.0], [0.0, 0.0, -2.0]])


class Sheet:
    """Triangles that stretch.

    Args:
        points: (n, 3) m, unstretched.
        triangles: (f, 3).
        young, poisson: Pa, 1.
        thickness: (f,) m.
        rubber: neo-Hookean; else Saint-Venant.
    """

    def __init__(
        self, points: Array, triangles: Array, young: float, poisson: float, thickness: Array, rubber: bool
    ) -> None:
        self.at, self.rubber, self.shear = triangles, rubber, young / 3
        a, b = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
        length = np.linalg.norm(a, axis=1)
        across = np.linalg.norm(np.cross(a, b), axis=1)
        self.area = across / 2
        self.matter = self.area * thickness  # m^3
        flat = np.zeros((len(a), 2, 2))  # columns: both sides in the triangle's own plane
        flat[:, 0, 0], flat[:, 0, 1], flat[:, 1, 1] = length, (a * b).sum(axis=1) / length, across / length
        back = np.linalg.inv(flat)
        self.slope = np.concatenate([-back.sum(axis=1, keepdims=True), back], axis=1)  # (f, 3 corners, 2)
        stiff = young / (1 - poisson**2)
        self.plain = stiff * np.array([[1, poisson, 0], [poisson, 1, 0], [0, 0, (1 - poisson) / 2]])

    def pulled(self, x: Array) -> Array:
        """(f, 2, 3): both columns of F."""
        return np.asarray(np.swapaxes(self.slope, 1, 2) @ x[self.at])

    def strain(self, x: Array) -> Array:
        """(f, 3): G11, G22, 2 G12."""
        u, v = self.pulled(x).transpose(1, 0, 2)
        return np.stack([((u * u).sum(1) - 1) / 2, ((v * v).sum(1) - 1) / 2, (u * v).sum(1)], axis=1)

    def dense(self, strain: Array) -> Array:
        """(f,) J/m^3."""
        if not self.rubber:
            return np.asarray(((strain @ self.plain) * strain).sum(axis=1) / 2)
        c1, c2, c12 = 2 * strain[:, 0] + 1, 2 * strain[:, 1] + 1, strain[:, 2]
        return np.asarray(self.shear / 2 * (c1 + c2 + 1 / (c1 * c2 - c12**2) - 3))

    def stress(self, strain: Array) -> Array:
        """(f, 3) Pa, second Piola-Kirchhoff."""
        if not self.rubber:
            return np.asarray(strain @ self.plain)
        turned, det = self._turned(strain)
        return np.asarray(self.shear * ((1.0, 1.0, 0.0) - turned / (2 * det[:, None] ** 2)))

    def stiff(self, strain: Array) -> Array:
        """(f, 3, 3) Pa, by which stress grows with strain."""
        if not self.rubber:
            return np.broadcast_to(self.plain, (len(strain), 3, 3))
        turned, det = self._turned(strain)
        det = det[:, None, None]
        return np.asarray(self.shear * (turned[:, :, None] * turned[:, None] / det**3 - _TWIST / (2 * det**2)))

    def _turned(self, strain: Array) -> tuple[Array, Array]:
        c1, c2, c12 = 2 * strain[:, 0] + 1, 2 * strain[:, 1] + 1, strain[:, 2]
        return np.stack([2 * c2, 2 * c1, -2 * c12], axis=1), c1 * c2 - c12**2

    def spread(self, x: Array, stress: Array, stiff: Array | None, low: float = 0.0) -> tuple[Array, Array | None]:
        """What a stress (f, 3), Pa, gives at the corners: the energy's slope (f, 3, 3), N, and, with `stiff`, its stiffness (f, 9, 9), N/m."""
        u, v = self.pulled(x).transpose(1, 0, 2)[:, :, None]
        one, two = self.slope[:, :, :1], self.slope[:, :, 1:]
        by = np.stack([one * u, two * v, one * v + two * u], axis=1).reshape(-1, 3, 9)
        matter = self.matter[:, None]
        slope = ((matter * stress)[:, None] @ by).reshape(-1, 3, 3)
        if stiff is None:
            return slope, None
        full = np.swapaxes(by, 1, 2) @ (matter[:, :, None] * stiff @ by)
        mean, half, s12 = (stress[:, 0] + stress[:, 1]) / 2, (stress[:, 0] - stress[:, 1]) / 2, stress[:, 2]
        radius = np.hypot(half, s12) + 1e-12
        least, most = np.maximum(mean - radius, low), np.maximum(mean + radius, low)  # compression pushes uphill
        middle, apart = (most + least) / 2, (most - least) / (2 * radius)
        kept = np.empty((len(x[self.at]), 2, 2))
        kept[:, 0, 0], kept[:, 1, 1] = middle + apart * half, middle - apart * half
        kept[:, 0, 1] = kept[:, 1, 0] = apart * s12
        tense = self.slope @ (matter[:, :, None] * kept) @ np.swapaxes(self.slope, 1, 2)
        for axis in range(3):
            full[:, axis::3, axis::3] += tense
        return slope, full


class Hinges:
    """Edges between two triangles, that bend.

    Args:
        points: (n, 3) m, unbent and unstretched.
        triangles: (f, 3) of a closed surface.
        young, poisson: Pa, 1.
        thickness: (f,) m.
        yields: strain at the surface beyond which a crease stays; None for never.

    Raises:
        ValueError: an edge has not two triangles.
    """

    def __init__(
        self, points: Array, triangles: Array, young: float, poisson: float, thickness: Array, yields: float | None
    ) -> None:
        sides = triangles[:, [[0, 1, 2], [1, 2, 0], [2, 0, 1]]].reshape(-1, 3)
        key = np.sort(sides[:, :2], axis=1)
        order = np.lexsort((sides[:, 0] > sides[:, 1], key[:, 1], key[:, 0]))
        first, second = sides[order[::2]], sides[order[1::2]]
        if len(sides) % 2 or (first[:, :2] != second[:, 1::-1]).any():
            raise ValueError("an edge has not two triangles, one from each side")
        self.at = np.column_stack([first, second[:, 2]])  # both ends, and the two corners beside
        p = points[self.at]
        e = p[:, 1] - p[:, 0]
        doubled = sum(np.linalg.norm(np.cross(e, p[:, n] - p[:, 0]), axis=1) for n in (2, 3)) / 2
        length = np.linalg.norm(e, axis=1)
        t = np.minimum(*(thickness[order[half::2] // 3] for half in (0, 1)))
        self.stiff = young * t**3 / (12 * (1 - poisson**2)) * length**2 / doubled
        self.most = np.inf if yields is None else yields * 2 * doubled / (t * length)
        self.rest = self.angle(points)

    def _normals(self, x: Array) -> tuple[Array, ...]:
        p = x[self.at]
        e, c, d = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]
        length = np.linalg.norm(e, axis=1, keepdims=True)
        return e / length, length, c, d, np.cross(e, c), np.cross(d, e)

    def angle(self, x: Array) -> Array:
        """(h,) rad, 0 where flat."""
        e, _, _, _, one, two = self._normals(x)
        return np.asarray(np.arctan2((np.cross(one, two) * e).sum(axis=1), (one * two).sum(axis=1)))

    def slope(self, x: Array) -> Array:
        """(h, 4, 3) rad/m: how the angle grows with each corner."""
        e, length, c, d, one, two = self._normals(x)
        a, b = (n / (n * n).sum(axis=1, keepdims=True) for n in (one, two))
        beside = [(w * e).sum(axis=1, keepdims=True) for w in (c, d)]
        ends = [((beside[0] - length) * a + (beside[1] - length) * b), -(beside[0] * a + beside[1] * b)]
        return -np.stack([*ends, length * a, length * b], axis=1)

    def bent(self, angle: Array) -> Array:
        """(h,) rad beyond the angle at rest."""
        return np.asarray((angle - self.rest + np.pi) % (2 * np.pi) - np.pi)

    def flow(self, x: Array) -> None:
        """Let what is bent beyond the yield strain stay so."""
        off = self.bent(self.angle(x))
        self.rest = self.rest + off - np.clip(off, -self.most, self.most)


def curved(corners: Array) -> Array:
    """(f, 9, 9) m: how the room's slope turns with corners (f, 3, 3), each pair by the third."""
    found = np.zeros((len(corners), 3, 3, 3, 3))
    for one in range(3):
        third = corners[:, (one + 2) % 3] / 6
        for axis in range(3):
            a, b = (axis + 1) % 3, (axis + 2) % 3
            found[:, one, a, (one + 1) % 3, b] = third[:, axis]
            found[:, one, b, (one + 1) % 3, a] = -third[:, axis]
        found[:, (one + 1) % 3, :, one] = np.swapaxes(found[:, one, :, (one + 1) % 3], 1, 2)
    return found.reshape(-1, 9, 9)
