"""How well a frame can be reckoned from others, told by what they show."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .carrying import LEAST_GONE, SLACK, Surfaces, carry, gone, grid
from .treatment import bent

if TYPE_CHECKING:
    from .described import Described


class Fit(NamedTuple):
    """How well a picture can be reckoned from others."""

    unseen: float
    """The share of it that none of them shows."""
    way: float
    """How far, pixels, half of what is seen goes at least from the first of them to the last, by the camera's motion too."""
    melts: float
    """The share of it that shows what bends."""
    lost: bool
    """A thing would be missed: none of them shows it."""


def fit(now: Surfaces, sides: "list[Surfaces]") -> Fit:
    """How well the picture of a moment can be reckoned from those of others."""
    hidden, way = np.ones(now.depth.shape, bool), 0.0
    column, row = grid(*now.depth.shape[::-1])
    bends = np.zeros(now.depth.shape, bool)
    for then in sides:
        found = carry(now, then)
        hidden &= ~found.seen
        way += float(np.median(np.hypot(found.x - column, found.y - row)))
        soft = (now.things < 0) | (then.things < 0)
        bends |= soft & (np.abs(now.depth - then.depth) > SLACK * now.depth)
    return Fit(float(hidden.mean()), way, float(bends.mean()), gone(now, sides, hidden))


def parts(now: Surfaces, then: Surfaces, apart_px: float) -> bool:
    """Whether something see-through and what is seen through it go apart by more than so many pixels between two moments.

    A picture is carried over as one layer, by what is seen first, so the other would be seen at two places.
    """
    if now.behind is None or then.behind is None:
        return False
    through = (now.things != now.behind.things) | (now.depth < now.behind.depth * (1 - SLACK))
    if not through.any():
        return False
    first, second = carry(now, then), carry(now.behind, then.behind)
    way = np.hypot(first.x - second.x, first.y - second.y)
    return float((through & (way > apart_px)).mean()) > LEAST_GONE


def uneven(film: "Described", before: int, after: int, fps: float) -> bool:
    """Whether light, developing or focus change between two frames otherwise than evenly: a mix of these shows none of it."""
    if any(bent(film.arrays[name][before : after + 1]) for name in ("focus_m", "aperture")):
        return True
    return film.treatments.bends(before / fps, after / fps, after - before)
