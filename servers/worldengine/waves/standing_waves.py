"""The standing waves of a container, of which all others are sums: cosines in a rectangle, else the eigenvectors of its grid.

A standing wave of the wave number k moves by itself, as cos(omega t), so that one step of any length has no error of its own; walls
turn waves back because each standing wave is level across them. In a rectangle they are those of the cosine transform, exact in k.
Elsewhere (a glass, a pond) they are the eigenvectors of the cut cells' Laplacian; the shortest, of less than about `SHORTEST` cells,
are left out. One thread and one order of sums, as the engine's process is set, give the same bits in each process of one machine.
"""

from typing import Protocol

import numpy as np

from .wet_grid import WetGrid

SHORTEST = 3.5
"""Cells of the shortest wave that is kept where the grid makes the waves."""
MOST_WAVES = 900

Array = np.ndarray


class Standing(Protocol):
    """Standing waves e_m, M of them, with the integral of e_m e_n over the water 1 where m = n, else 0; the first one is level."""

    k: Array
    """(M,) 1/m, the first 0."""

    def shares(self, volumes: Array) -> Array:
        """(s, M): how much of each wave is in volumes (s, C), m^3, that lie on the cells."""

    def heights(self, shares: Array) -> Array:
        """(s, C): the heights in the middle of the cells that so much of each wave (s, M) makes."""


def of(grid: WetGrid) -> Standing:
    """The standing waves of a grid."""
    return Cosines(grid) if grid.whole else Eigenvectors(grid)


class Cosines:
    """Those of a rectangle (Lamb, Hydrodynamics, section 190), with as many as there are cells."""

    def __init__(self, grid: WetGrid) -> None:
        self._shape, self._side = grid.shape, float(np.sqrt(np.prod(grid.cell)))
        kx, ky = (np.pi * np.arange(n) / (n * cell) for n, cell in zip(grid.shape, grid.cell, strict=True))
        self.k = np.hypot(kx[:, None], ky).ravel()

    def shares(self, volumes: Array) -> Array:
        """By the cosine transform."""
        from scipy.fft import dctn

        fields = volumes.reshape(-1, *self._shape)
        return np.asarray(dctn(fields, axes=(1, 2), norm="ortho")).reshape(len(fields), -1) / self._side

    def heights(self, shares: Array) -> Array:
        """By the inverse cosine transform."""
        from scipy.fft import idctn

        fields = shares.reshape(-1, *self._shape)
        return np.asarray(idctn(fields, axes=(1, 2), norm="ortho")).reshape(len(fields), -1) / self._side


class Eigenvectors:
    """Those of a grid with any shore."""

    def __init__(self, grid: WetGrid) -> None:
        from scipy.linalg import eigh

        root = 1.0 / np.sqrt(grid.areas)
        matrix = grid.stiffness * root[:, None] * root
        cell = float(grid.cell[0])
        kept = min(grid.size, MOST_WAVES) - 1
        square, vectors = eigh(matrix, subset_by_index=(0, kept), driver="evr")
        good = np.sqrt(np.maximum(square, 0.0)) < 2.0 / cell * np.sin(np.pi / SHORTEST)
        good[0] = True
        self._waves = np.ascontiguousarray((vectors[:, good] * root[:, None]).T)
        self._waves[0] = 1.0 / np.sqrt(grid.area)  # level, without the rounding of the eigenvector
        found = np.sqrt(np.maximum(square[good], 0.0))
        found[0] = 0.0
        self.k = 2.0 / cell * np.arcsin(np.minimum(found * cell / 2.0, 1.0))
        """Of the wave itself: that of the grid is a little low, k dx = 2 sin(k' dx / 2)."""
        self._back = np.ascontiguousarray(self._waves.T)

    def shares(self, volumes: Array) -> Array:
        """By products with each."""
        return np.asarray(volumes @ self._back)

    def heights(self, shares: Array) -> Array:
        """By their sum."""
        return np.asarray(shares @ self._waves)
