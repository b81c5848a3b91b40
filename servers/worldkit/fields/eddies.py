"""Eddy currents: what a moving magnet induces in a tube or a plate, and the drag that both feel.

A conductor is a net of straight pieces with closed loops. Along a piece dl that moves by u relative to a magnet, B drives u x B . dl;
the loops' currents follow from Kirchhoff's laws with the pieces' resistances, and a current i feels i dl x B, the magnet the opposite.
So what the motion loses is what the resistances warm, to the last digit. Currents follow at once: self-induction is left out, which
holds while mu0 sigma v d is well below 1 (copper, d = 2 mm of wall: below 7 m/s).
Source: Jackson, section 5.18; for a dipole in a long tube the sum is 15 mu0^2 m^2 sigma / 1024 (1 / a^3 - 1 / b^3) (Saslow, Am. J. Phys. 60, 693, 1992).
"""

from dataclasses import dataclass

import numpy as np

from .elimination import solved

Array = np.ndarray
AROUND = 14
"""Pieces of a ring."""
RINGS_A_RADIUS = 5.0
"""Rings of a tube for each of its inner radius."""
THIN = 1.3
"""A wall whose outer radius is less than this many times the inner is one layer of rings, any other two, by Gauss and Legendre."""
CELLS = 14
"""Loops along the longer side of a plate."""


@dataclass(frozen=True)
class Net:
    """A conductor, in its own frame."""

    at: Array
    """(e, 3) m: middles of its pieces."""
    along: Array
    """(e, 3) m: the pieces."""
    conducts: Array
    """(e, e) A/V: the currents of pieces by what drives each; of a tube, (r,) of its rings, each of `AROUND` pieces."""

    def currents(self, driven: Array) -> Array:
        """(e,) A by (e,) V."""
        if self.conducts.ndim == 1:
            return np.repeat(self.conducts * driven.reshape(-1, AROUND).sum(axis=1), AROUND)
        return np.einsum("ef,f->e", self.conducts, driven)

    def near(self, magnets: "list[tuple[Array, float]]", reach: float) -> "Net":
        """Of a tube the rings whose middles are nearer than `reach` to magnets, each a place (3,) and half its width, m; of a plate all."""
        if self.conducts.ndim > 1:
            return self
        heights = self.at[::AROUND, 2]
        kept = np.zeros(len(heights), bool)
        for place, half in magnets:
            kept |= (heights - place[2]) ** 2 + place[0] ** 2 + place[1] ** 2 < (reach + half) ** 2
        pieces = np.repeat(kept, AROUND)
        return Net(self.at[pieces], self.along[pieces], self.conducts[kept])


def tube(inner: float, outer: float, length: float, conductivity: float) -> Net:
    """A tube along z, its middle in the middle; m and S/m."""
    nodes, weights = np.polynomial.legendre.leggauss(2)
    layers: list[tuple[float, float]] = [
        (inner + (node + 1) / 2 * (outer - inner), weight / 2) for node, weight in zip(nodes, weights, strict=True)
    ]
    if outer < THIN * inner:  # where it brakes a dipole as the whole wall does
        layers = [((3 * (outer - inner) / (inner**-3 - outer**-3)) ** 0.25, 1.0)]
    count = max(3, round(length / inner * RINGS_A_RADIUS))
    turn = 2 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
    heights = (np.arange(count) + 0.5) / count * length - length / 2
    at, along, conducts = [], [], []
    chord = 2 * np.pi / AROUND
    for radius, share in layers:
        ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(AROUND)])
        for height in heights:
            at.append(radius * ring + (0, 0, height))
            along.append(radius * chord * np.column_stack([-np.sin(turn), np.cos(turn), np.zeros(AROUND)]))
        area = share * (outer - inner) * length / count
        conducts += [conductivity * area / (2 * np.pi * radius)] * count
    return Net(np.concatenate(at), np.concatenate(along), np.array(conducts))


def plate(width: float, depth: float, thickness: float, conductivity: float) -> Net:
    """A thin plate, width along x and depth along y, thickness along z; m and S/m."""
    side = max(width, depth) / CELLS
    nx, ny = max(2, round(width / side)), max(2, round(depth / side))
    dx, dy = width / nx, depth / ny
    at: list[tuple[float, float, float]] = []
    along: list[tuple[float, float, float]] = []
    resists: list[float] = []
    flat: dict[tuple[str, int, int], int] = {}
    for i in range(nx + 1):
        for j in range(ny + 1):
            x, y = i * dx - width / 2, j * dy - depth / 2
            if i < nx:
                flat["x", i, j] = len(at)
                at.append((x + dx / 2, y, 0.0))
                along.append((dx, 0.0, 0.0))
                resists.append(dx / (conductivity * thickness * dy * (1.0 if 0 < j < ny else 0.5)))
            if j < ny:
                flat["y", i, j] = len(at)
                at.append((x, y + dy / 2, 0.0))
                along.append((0.0, dy, 0.0))
                resists.append(dy / (conductivity * thickness * dx * (1.0 if 0 < i < nx else 0.5)))
    loops = np.zeros((nx * ny, len(at)))
    for i in range(nx):
        for j in range(ny):
            row = loops[i * ny + j]
            row[flat["x", i, j]], row[flat["x", i, j + 1]] = 1.0, -1.0
            row[flat["y", i + 1, j]], row[flat["y", i, j]] = 1.0, -1.0
    net = np.einsum("le,lf->ef", loops, solved(np.einsum("ae,be->ab", loops * np.array(resists), loops), loops))
    return Net(np.array(at), np.array(along), net)
