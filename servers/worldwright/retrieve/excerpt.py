"""The part of a hit that is shown: the lines that say most of what was asked."""

from collections import Counter

from . import words
from .lexical import SATURATION

LONGEST = 700
"""Characters of a hit that are shown; `read` opens the whole."""


def excerpt(text: str, telling: dict[str, float]) -> str:
    """Whole lines of a text that together say most, each term as BM25 counts it.

    Args:
        text: what was found.
        telling: the question's terms, and how much each says.
    """
    if len(text) <= LONGEST:
        return text
    lines = text.splitlines()
    said = [[term for term in words.counted(line) if term in telling] for line in lines]
    best, most = range(1), -1.0
    for first in range(len(lines)):
        last, size = first, len(lines[first])
        while last + 1 < len(lines) and size + len(lines[last + 1]) < LONGEST:
            last += 1
            size += len(lines[last]) + 1
        times = Counter(term for line in said[first : last + 1] for term in line)
        worth = sum(telling[term] * n / (n + SATURATION) for term, n in times.items())
        if worth > most:
            best, most = range(first, last + 1), worth
    shown = "\n".join(lines[best.start : best.stop])[:LONGEST]
    return ("… " if best.start else "") + shown + (" …" if best.stop < len(lines) else "")
