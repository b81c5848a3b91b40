"""Full text: BM25 over three fields of a window (Robertson, Zaragoza and Taylor 2004, "Simple BM25 extension to multiple
weighted fields"), with every term's share of the score worked out when the index is built.

A question then costs one look-up and one addition for each term, whatever its weights.
"""

import math
from collections import Counter, defaultdict
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

    counts = [[Counter(field) for field in window] for window in said]
    sizes = [[sum(field.values()) for field in window] for window in counts]
    means = [max(1.0, sum(row[n] for row in sizes) / max(1, len(sizes))) for n in range(len(FIELDS))]
    found: dict[str, tuple[list[int], list[float]]] = defaultdict(lambda: ([], []))
    for number, (window, size) in enumerate(zip(counts, sizes, strict=True), 1):
        weighed: dict[str, float] = defaultdict(float)
        for field, count, length, mean in zip(FIELDS, window, size, means, strict=True):
            scale = field.weight / (1.0 - field.length + field.length * length / mean)
            for term, times in count.items():
                weighed[term] += scale * times
        for term, weight in weighed.items():
            numbers, weights = found[term]
            numbers.append(number)
            weights.append(weight)
    for term, (numbers, weights) in found.items():
        tf = np.array(weights, dtype=np.float32)
        score = (rarity(len(numbers), len(counts)) * (SATURATION + 1.0)) * tf / (tf + SATURATION)
        yield term, np.array(numbers, dtype=np.int32).tobytes(), score.astype(np.float32).tobytes()


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
