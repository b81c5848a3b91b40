"""The points of a sweep, one after the other: the last field of the grid turns fastest, draws fastest of all.

Point `n` is a function of the sweep and `n` alone, and what is drawn for a field depends on seed, field and number of the draw
alone: a longer sweep keeps the worlds of a shorter one, and no list of them is ever made.
"""

import hashlib
import math
import random

from .campaign_file import Axis, Sweep

DRAWN_DIGITS, LAID_DIGITS = 6, 12
"""Significant digits of what is drawn, and of what is laid along a range: a plan is read by people."""
AGAIN = 10_000
TINY = 1e-280
"""Numbers below it have fewer digits, or their steps do."""


def at(sweep: Sweep, number: int) -> dict[str, float]:
    """The values of point `number` (0 to `sweep.size` - 1) by field, in the order of the file."""
    number, draw = divmod(number, sweep.draws)
    places: dict[str, int] = {}
    for name, axis in reversed(sweep.fields.items()):
        number, places[name] = divmod(number, axis.length)
    return {
        name: _drawn(axis, sweep.seed, name, draw) if axis.drawn else along(axis, places[name])
        for name, axis in sweep.fields.items()
    }


def along(axis: Axis, place: int) -> float:
    """Value `place` of an axis of the grid."""
    if axis.values is not None:
        return axis.values[place]
    assert axis.start is not None and axis.to is not None and axis.steps is not None
    share = place / (axis.steps - 1) if axis.steps > 1 else 0.0
    if place == axis.steps - 1 and place:
        return axis.to
    if axis.spacing == "log":
        return _rounded(axis.start * (axis.to / axis.start) ** share, LAID_DIGITS)
    return _rounded(axis.start + (axis.to - axis.start) * share, LAID_DIGITS)


def equal_neighbours(axis: Axis) -> tuple[int, int] | None:
    """Two places next to each other of an axis whose values, as they are written into a plan, are equal; None: all differ.

    Looked for only where steps come near the digits that are written, or near the smallest numbers: along any other range they differ.
    """
    if axis.values is not None or axis.drawn or axis.steps is None or axis.steps == 1:
        return None
    assert axis.start is not None and axis.to is not None
    if axis.spacing == "log":
        apart = abs(math.log(axis.to / axis.start)) / (axis.steps - 1)
    else:
        apart = abs(axis.to - axis.start) / (axis.steps - 1) / max(abs(axis.start), abs(axis.to))
    if apart > 100 * 10.0**-LAID_DIGITS and max(abs(axis.start), abs(axis.to)) > TINY:
        return None
    places = range(axis.steps - 1)
    return next(((n, n + 1) for n in places if along(axis, n) == along(axis, n + 1)), None)


def _drawn(axis: Axis, seed: int, name: str, draw: int) -> float:
    chance = random.Random(hashlib.sha256(f"{seed}\n{name}\n{draw}".encode()).digest())
    if axis.integers:
        return chance.randint(*axis.integers)
    if axis.uniform:
        return _rounded(chance.uniform(*axis.uniform))
    if axis.log_uniform:
        low, high = axis.log_uniform
        return _rounded(math.exp(chance.uniform(math.log(low), math.log(high))))
    assert axis.normal is not None
    low, high = axis.within or (-math.inf, math.inf)
    draws = (chance.gauss(*axis.normal) for _ in range(AGAIN))
    return _rounded(next((value for value in draws if low <= value <= high), min(max(axis.normal[0], low), high)))


def _rounded(value: float, digits: int = DRAWN_DIGITS) -> float:
    return float(f"{value:.{digits}g}")
