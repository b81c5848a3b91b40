"""Full text: BM25 over three fields of a window (Robertson, Zaragoza and Taylor 2004, "Simple BM25 extension to multiple
weighted fields"), with every term's share of the score worked out when the index is built.

A question then costs one look-up and one addition for each term, whatever its weights.
"""

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

from . import words
from .chunk import Chunk, windows

if TYPE_CHECKING:
    import numpy as np


Fields = tuple[list[str], list[str], list[str]]
"""The terms of one window, field by field of `FIELDS`."""


class Field(NamedTuple):
    """How one field of a window counts."""

    weight: float
    """How much one occurrence counts."""
    length: float
    """0 to 1: how far a long field is discounted (BM25's b)."""


FIELDS = (Field(1.5, 0.3), Field(0.4, 0.3), Field(1.0, 0.5))
"""Its piece's heading with anchor and labels; the headings above; its words."""
SATURATION = 1.2
"""BM25's k1: the second occurrence of a term counts less than the first."""


def fields(chunk: Chunk) -> list[Fields]:
    """The terms of a chunk's windows, field by field."""
    *above, own = chunk.title.split(" > ")
    named = {*chunk.labels, chunk.anchor}
    spoken = " ".join(f"{name} {name.replace('-', ' ')}" if "-" in name else name for name in sorted(named))
    heading, over = words.counted(f"{own} {spoken}"), words.counted(" ".join(above))
    return [(heading, over, words.counted(text)) for text in windows(chunk.text)]


def shares(said: Iterable[Fields]) -> Iterator[tuple[str, bytes, bytes]]:
    """(term, window numbers as int32, their shares of the score as float32); windows are numbered from 1."""
    import numpy as np

    every = list(said)
    sizes = np.array([[len(field) for field in window] for window in every], dtype=float).reshape(-1, len(FIELDS))
    means = np.maximum(sizes.sum(axis=0) / max(1, len(every)), 1.0)
    weights, lengths = np.array([(field.weight, field.length) for field in FIELDS]).T
    scales = weights / (1.0 - lengths + lengths * sizes / means)
    ranks: dict[str, int] = {}
    terms = np.array(
        [ranks.setdefault(term, len(ranks)) for window in every for field in window for term in field], dtype=np.int64
    )
    stands = np.repeat(np.arange(1, len(every) + 1), sizes.sum(axis=1).astype(int))
    # One row for each term in each window, by term and then by window, with the sum over its fields as its weight.
    rows, place = np.unique(terms * (len(every) + 1) + stands, return_inverse=True)
    tf = np.bincount(place, np.repeat(scales.ravel(), sizes.ravel().astype(int)), len(rows)).astype(np.float32)
    term, number = np.divmod(rows, len(every) + 1)
    ends = np.cumsum(np.bincount(term, minlength=len(ranks)))
    start = 0
    for name, end in zip(ranks, ends.tolist(), strict=True):
        part = tf[start:end]
        score = (rarity(end - start, len(every)) * (SATURATION + 1.0)) * part / (part + SATURATION)
        yield name, number[start:end].astype(np.int32).tobytes(), score.astype(np.float32).tobytes()
        start = end


def rarity(times: int, count: int) -> float:
    """BM25's weight of a term that stands in `times` of `count` windows."""
    return math.log(1.0 + (count - times + 0.5) / (times + 0.5))


def score(stored: dict[str, tuple[bytes, bytes]], weights: dict[str, float], count: int) -> "np.ndarray":
    """BM25 of every window for weighed terms.

    Args:
        stored: (numbers, shares) of the terms the index has.
        weights: the question's terms.
        count: windows in the index.

    Returns:
        (count + 1,) float32; entry n is window n's.
    """
    import numpy as np

    total = np.zeros(count + 1, dtype=np.float32)
    for term, (numbers, part) in stored.items():
        total[np.frombuffer(numbers, dtype=np.int32)] += weights[term] * np.frombuffer(part, dtype=np.float32)
    return total
