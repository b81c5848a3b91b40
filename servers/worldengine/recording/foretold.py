"""Store the numbers of wide answers as the errors of a forecast: every bit comes back, and what follows a law takes little room.

A force that a law gives anew at every step has 53 bits that no packer can do anything with, and yet most of it is known from
its past. Of every entry of an answer the last value and its differences up to the seventh order are kept, step by step of
those in which anything is sent. A block of rows has up to eight weights; the sum of the differences times these is the
forecast, and the row holds how far the number's bits are from the forecast's (as whole numbers that wrap around; the sign
folded into the lowest bit). Weights of ones continue a polynomial; others are fitted to the block, as what swings, decays or
is thrown continues in one way whatever its place. Without weights a row holds the number itself, and the past begins anew.

The errors lie byte by byte, all lowest ones in one column: the upper bytes of good forecasts are zero and pack to nothing.
Reader and writer make the same forecast to the last bit on every machine, since it is made of single additions and
multiplications of float64 in one order. Where it is not finite, it is 0. The weights are chosen by what packs best of a sample,
and no reader needs to know how.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from .columns import FORETOLD_COLUMNS

if TYPE_CHECKING:
    import numpy as np

WEIGHTS = b"weights"
"""The key of a block's weights in its metadata: numbers as Python writes them, with blanks between; empty without any."""
BYTES = tuple(column.name for column in FORETOLD_COLUMNS[2:])
"""The columns of the errors' bytes, the lowest first."""
ORDERS = 8
MOST_WORDS = 32 * ORDERS
"""Weights take no more bytes than this."""
FEWEST, EMPTIEST = 64, 4
"""Rows are foretold where a step has so many of them, and where at least one entry in so many is sent."""
WIDEST = 1 << 20
"""Beyond so many entries nothing is foretold: a forged entry must not make a reader take memory."""
SAMPLED_STEPS, SAMPLED_ENTRIES = 16, 256


class Forecast:
    """The past of one stream; `encode` and `decode` must be given its blocks in their order.

    A block's rows are (step, entry, value), sorted by step and within it by entry, each entry once.
    """

    def __init__(self) -> None:
        import numpy as np

        self._past = np.zeros((ORDERS, 0))

    def encode(
        self, step: "np.ndarray", entry: "np.ndarray", value: "np.ndarray"
    ) -> tuple[list[float], list["np.ndarray"]]:
        """The weights of a block of (N,) rows and its errors, as eight columns (N,) of bytes."""
        import numpy as np

        places = list(_places(step, entry))
        weights = self._weights(places, value) if self._pays(places, entry) else []
        told = np.zeros(len(value))
        if not weights:
            self._past = np.zeros((ORDERS, 0))
        for rows, at in places if weights else ():
            told[rows] = foretold(self._past, weights)[at]
            now = self._past[0].copy()
            now[at] = value[rows]
            learn(self._past, now)
        return weights, _bytes(value, told)

    def decode(
        self, step: "np.ndarray", entry: "np.ndarray", columns: list["np.ndarray"], weights: list[float]
    ) -> "np.ndarray":
        """(N,) values of a block.

        Raises:
            ValueError: nobody writes such a block.
        """
        import numpy as np

        folded = np.stack(columns, axis=1).view("<u8").reshape(-1)
        error = ((folded >> np.uint64(1)) ^ (np.uint64(0) - (folded & np.uint64(1)))).view(np.int64)
        if not weights:
            self._past = np.zeros((ORDERS, 0))
            return error.view(float)
        places = list(_places(step, entry))
        if len(weights) > ORDERS or not np.isfinite(weights).all() or not self._pays(places, entry):
            raise ValueError("a block is foretold that nobody foretells")
        value = np.empty(len(error))
        for rows, at in places:
            now = self._past[0].copy()
            now[at] = value[rows] = (foretold(self._past, weights)[at].view(np.int64) + error[rows]).view(float)
            learn(self._past, now)
        return value

    def _pays(self, places: list[Any], entry: "np.ndarray") -> bool:
        """Whether these rows are foretold, with room made for their past: they are many, and most entries are among them."""
        import numpy as np

        if not len(entry) or entry.min() < 0 or len(entry) < FEWEST * len(places):
            return False
        width = max(int(entry.max()) + 1, self._past.shape[1])
        if width > WIDEST or width * len(places) > EMPTIEST * len(entry):
            return False
        self._past = np.concatenate([self._past, np.zeros((ORDERS, width - self._past.shape[1]))], axis=1)
        return True

    def _weights(self, places: list[Any], value: "np.ndarray") -> list[float]:
        """The weights by which a sample of the block takes least room; empty where no forecast helps."""
        import numpy as np
        import pyarrow as pa

        past, samples = self._past.copy(), []
        every = -(-len(places) // SAMPLED_STEPS)
        for n, (rows, at) in enumerate(places):
            now = past[0].copy()
            now[at] = value[rows]
            if n % every == every // 2:
                mine = np.arange(past.shape[1])[at]
                mine = mine[:: -(-len(mine) // SAMPLED_ENTRIES)]
                samples.append(np.concatenate([past[:, mine], now[None, mine]]))
            learn(past, now)
        *orders, values = np.concatenate(samples, axis=1)
        known = np.array(orders)
        tried = [[1.0] * order for order in range(ORDERS + 1)] + _fitted(known, values)
        room = [
            sum(pa.compress(column, codec="zstd").size for column in _bytes(values, foretold(known, w))) for w in tried
        ]
        return tried[int(np.argmin(room))]


def weights_of(text: bytes) -> list[float]:
    """Read a block's weights.

    Raises:
        ValueError: they are none, or too many.
    """
    if len(text) > MOST_WORDS:
        raise ValueError("a block has more weights than any")
    return [float(word) for word in text.split()]


def foretold(past: "np.ndarray", weights: list[float]) -> "np.ndarray":
    """(W,) forecast from (8, W) differences: their weighted sum, lowest order first; 0 where that is not finite."""
    import numpy as np

    told, term = np.zeros(past.shape[1]), np.empty(past.shape[1])
    with np.errstate(all="ignore"):
        for weight, differences in zip(weights, past, strict=False):
            np.add(told, np.multiply(differences, weight, out=term), out=told)
        if not np.isfinite(told.sum()):
            told[~np.isfinite(told)] = 0.0
    return told


def learn(past: "np.ndarray", now: "np.ndarray") -> None:
    """Make the (W,) numbers of a step the latest of the past (8, W)."""
    import numpy as np

    with np.errstate(all="ignore"):
        difference = now
        for order in past:
            further = difference - order
            order[:] = difference
            difference = further


def _fitted(known: "np.ndarray", values: "np.ndarray") -> list[list[float]]:
    """At most one list of weights: the least squares of what is left of a straight line's forecast."""
    import numpy as np

    with np.errstate(all="ignore"):
        left = values - (known[0] + known[1])
        scale = np.sqrt((known**2).mean(axis=1))
        scale[~(scale > 0)] = 1.0
        shares = (known / scale[:, None]).T
    if not (np.isfinite(left).all() and np.isfinite(shares).all()):
        return []
    weights = np.linalg.lstsq(shares, left, rcond=1e-14)[0] / scale
    weights[:2] += 1.0
    return [weights.tolist()] if np.isfinite(weights).all() else []


def _places(step: "np.ndarray", entry: "np.ndarray") -> Iterator[tuple[slice, Any]]:
    """(rows, entries) of each step; the entries are a slice where there is none between them that is not sent."""
    import numpy as np

    bounds = [0, *(np.flatnonzero(np.diff(step)) + 1).tolist(), len(step)]
    for begin, end in pairwise(bounds):
        if begin < end:
            first, last = int(entry[begin]), int(entry[end - 1])
            rows = slice(begin, end)
            yield rows, slice(first, last + 1) if last - first + 1 == end - begin else entry[rows]


def _bytes(value: "np.ndarray", told: "np.ndarray") -> "list[np.ndarray]":
    """The folded differences of the bits of (N,) numbers from those of their forecasts, as eight (N,) columns of bytes."""
    import numpy as np

    error = np.ascontiguousarray(value, float).view(np.int64) - told.view(np.int64)
    folded = (error << 1) ^ (error >> 63)
    return list(np.ascontiguousarray(folded.astype("<i8", copy=False).view(np.uint8).reshape(-1, 8).T))
