"""Triangles between points that lie in rows and columns."""

import numpy as np


def lattice(rows: int, columns: int) -> np.ndarray:
    """(M, 3) triangles of `rows` x `columns` points, row by row: all first halves of its squares, then all second ones.

    Each square is cut from its first corner to the opposite one, as the engine cuts a height field; with columns along x and
    rows along y, all face up.
    """
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    beside, across, after = first + 1, first + columns + 1, first + columns
    return np.concatenate([np.stack([first, beside, across], axis=1), np.stack([first, across, after], axis=1)])
