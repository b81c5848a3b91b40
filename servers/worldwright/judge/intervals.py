"""How sure a share is, and how far repeated votes agree."""

import math
from collections.abc import Sequence

Z_95 = 1.959963984540054
"""The normal quantile of a two-sided interval of 95 %."""


def wilson(passed: int, of: int, z: float = Z_95) -> tuple[float, float]:
    """Wilson's score interval of a share, (low, high) in 0..1; (0, 1) where nothing was counted.

    Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209-212.
    """
    if not 0 <= passed <= of:
        raise ValueError(f"{passed} of {of} is no share")
    if of == 0:
        return 0.0, 1.0
    share, square = passed / of, z * z
    middle = share + square / (2 * of)
    half = z * math.sqrt(share * (1 - share) / of + square / (4 * of * of))
    low, high = (middle - half) / (1 + square / of), (middle + half) / (1 + square / of)
    return (0.0 if passed == 0 else low), (1.0 if passed == of else high)


def fleiss_kappa(yes: Sequence[int], votes: int) -> float | None:
    """Fleiss' kappa of questions that are answered Yes or No by as many votes each.

    Args:
        yes: of each question, how many of the votes said Yes.
        votes: so many there were of each.

    Returns:
        1: all votes on each question agree; 0: no more than by chance. None where it says nothing: fewer than two votes, or all
        votes on all questions the same, which chance alone would explain.

    Source: J. L. Fleiss, Psychol. Bull. 76 (1971), 378-382.
    """
    if votes < 2 or not yes:
        return None
    share = sum(yes) / (len(yes) * votes)
    by_chance = share**2 + (1 - share) ** 2
    if by_chance >= 1:
        return None
    pairs = votes * (votes - 1)
    seen = sum(y * (y - 1) + (votes - y) * (votes - y - 1) for y in yes) / (len(yes) * pairs)
    return (seen - by_chance) / (1 - by_chance)
