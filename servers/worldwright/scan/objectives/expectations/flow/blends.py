"""The colours of a medium blend: two paints make a third, ink clouds water, milk goes into tea.

Measures of the points that went at least `moved_m` from where they lay at the start of the window the share whose colour, the mean of
a point and its five nearest, is farther than `apart` from every colour that any point had then, at the end less at the start.
A medium is named by what shows it; its law tells `colours`: that they blend is by its word, as nothing else holds them. Source: intensity of segregation, Danckwerts 1952.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.own_laws import two_paints
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, at_least, window

CODE = "WE274"
EVENT = True
NEAREST, DRAWN, FINEST, MOST_COLOURS = 6, 4000, 0.02, 64
"""Points of a mean; so many are looked at; colours so near are one; so many it may begin with."""
Array = np.ndarray


class Given(Windowed):
    """Which medium, and how much of it blends."""

    medium: Name = Field(description="what shows the points of the law: its `shown_by`")
    min_share: float = Field(gt=0, le=1, description="least share of what moved that blends")
    apart: float = Field(0.15, gt=0, lt=1, description="how far a blend is from each colour poured, in sRGB of 0 to 1")
    moved_m: float = Field(5e-4, gt=0, description="what went less far counts for nothing, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The shares at both ends of the window."""
    rows, lay = window(trajectory, given.window_s), trajectory.media.of(given.medium)
    (first, colours), (last, after) = (
        (lay.at(float(trajectory.t[row])), lay.coloured(float(trajectory.t[row])))
        for row in (rows.start, rows.stop - 1)
    )
    if colours is None or after is None:
        raise UnknowableError(
            f"the law of {given.medium} tells no colours", next_move="give its class `colours`, (n, 3) sRGB"
        )
    known = np.unique(np.round(colours / FINEST), axis=0) * FINEST
    if len(known) > MOST_COLOURS:
        raise UnknowableError(
            f"{given.medium} has {len(known)} colours at the start of the window, too many to tell a blend from",
            next_move="begin the window before they mix",
        )
    moved = np.flatnonzero(np.linalg.norm(last - first, axis=1) >= given.moved_m)
    if len(moved) < NEAREST:
        raise UnknowableError(f"no point of {given.medium} goes {given.moved_m:g} m", next_move="pour it, or stir it")
    before, ends = (_blended(p[moved], c[moved], known, given.apart) for p, c in ((first, colours), (last, after)))
    told = f"{ends:.1%} of what moved of {given.medium} has a colour that none of it began with, {before:.1%} at first, by its law's word"
    return at_least(ends - before, given.min_share, "1", told)


def _blended(points: Array, colours: Array, known: Array, apart: float) -> float:
    """The share of points (n, 3) m of colours (n, 3) round which the mean is none of those known (k, 3)."""
    from scipy.spatial import cKDTree

    some = points[:: -(-len(points) // DRAWN)]
    mean = colours[cKDTree(points).query(some, k=NEAREST)[1]].mean(axis=1)
    return float((np.linalg.norm(mean[:, None] - known, axis=2).min(axis=1) > apart).mean())


GOOD = (
    (two_paints, {"medium": "paint", "min_share": 0.9}),
    (lambda: two_paints(share=0.5), {"medium": "paint", "min_share": 0.4}),
)
BAD = (
    (lambda: two_paints(share=0.0), {"medium": "paint", "min_share": 0.1}),
    (lambda: two_paints(share=0.3), {"medium": "paint", "min_share": 0.5}),
    (two_paints, {"medium": "paint", "min_share": 0.1, "window_s": [1.9, 2.0]}),
)
