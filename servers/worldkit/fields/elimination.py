"""Linear equations solved in one order of sums, whose last digits depend on no number of threads, as those of a library's may."""

import numpy as np

Array = np.ndarray


def solved(matrix: Array, right: Array) -> Array:
    """x of A x = b by Gauss without pivots, for a matrix (n, n) that is positive definite or whose diagonal outweighs its rows.

    `right` is (n,) or (n, k). Source: Golub and Van Loan, Matrix Computations, sections 3.2 and 4.1 (no pivot is needed for these).
    """
    left, found = np.array(matrix, float), np.array(right, float)
    count = len(left)
    for row in range(count - 1):
        below = np.flatnonzero(left[row + 1 :, row]) + row + 1
        share = left[below, row] / left[row, row]
        left[below, row:] -= share[:, None] * left[row, row:]
        found[below] -= np.multiply.outer(share, found[row])
    for row in range(count - 1, -1, -1):
        found[row] /= left[row, row]
        above = np.flatnonzero(left[:row, row])
        found[above] -= np.multiply.outer(left[above, row], found[row])
    return found
