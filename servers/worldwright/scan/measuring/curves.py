"""Curves fitted to what was recorded: lines, parabolas, circles, periods, turning points.

scipy's `find_peaks` is no choice for the last: it takes 1.8 s to import, and misses or adds a point in 7 of 300 noisy
swings.
"""

from typing import NamedTuple

import numpy as np

Array = np.ndarray


class Line(NamedTuple):
    """The straight line nearest to some points."""

    direction: Array
    """(3,) unit, from the first point towards the last."""
    length: float
    """The extent of the points along it, m."""
    deviation: float
    """The largest distance of a point from it."""


class Circle(NamedTuple):
    """The circle nearest to some points in space."""

    center: Array
    normal: Array
    """(3,) unit; the motion runs counter-clockwise about it."""
    radius: float
    deviation: float
    """The largest distance of a point from it."""
    swept: float
    """The total angle passed, rad, with its sign."""


def line(points: Array) -> Line:
    """The line through the centroid of points (N, 3) along their first principal axis (total least squares)."""
    apart = points - points.mean(axis=0)
    _, axes = np.linalg.eigh(apart.T @ apart)
    axis = axes[:, -1]
    axis = axis if (points[-1] - points[0]) @ axis >= 0 else -axis
    along = apart @ axis
    off = np.linalg.norm(apart - along[:, None] * axis, axis=1)
    return Line(axis, float(np.ptp(along)), float(off.max()))


def polynomial(t: Array, values: Array, degree: int) -> tuple[Array, float]:
    """Least-squares coefficients (degree + 1, K), constant first, in powers of t - t[0]; and the largest residual."""
    base = np.vander(t - t[0], degree + 1, increasing=True)
    values = values.reshape(len(t), -1)
    found = np.linalg.lstsq(base, values, rcond=None)[0]
    return found, float(np.linalg.norm(values - base @ found, axis=1).max())


def circle(points: Array) -> Circle:
    """The circle through points (N, 3) by an algebraic fit (Kasa) in the plane of their two larger principal axes."""
    middle = points.mean(axis=0)
    apart = points - middle
    _, axes = np.linalg.eigh(apart.T @ apart)
    plane = axes[:, :0:-1]
    flat = apart @ plane
    base = np.column_stack([2 * flat, np.ones(len(flat))])
    solved = np.linalg.lstsq(base, (flat**2).sum(axis=1), rcond=None)[0]
    radius = float(np.sqrt(max(solved[2] + solved[:2] @ solved[:2], 0.0)))
    center = middle + plane @ solved[:2]
    normal = np.cross(plane[:, 0], plane[:, 1])
    out = points - center
    height = out @ normal
    reach = np.linalg.norm(out - height[:, None] * normal, axis=1)
    swept = float(winding(out, normal)[-1])
    if swept < 0:
        normal, swept = -normal, -swept
    return Circle(center, normal, radius, float(np.hypot(reach - radius, height).max()), swept)


def winding(out: Array, normal: Array) -> Array:
    """(N,) rad: angle passed about a unit normal by vectors (N, 3), from 0, unwrapped."""
    first = out[0] - (out[0] @ normal) * normal
    if np.linalg.norm(first) < 1e-12:
        first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first = first / np.linalg.norm(first)
    angle = np.unwrap(np.arctan2(out @ np.cross(normal, first), out @ first))
    return angle - angle[0]


def turning_points(values: Array, least: float) -> Array:
    """Indices of alternating highs and lows, each at least `least` from the one before; the ends are not counted."""
    slope = np.sign(np.diff(values))
    moving = np.flatnonzero(slope)
    if not len(moving):
        return np.zeros(0, dtype=int)
    change = moving[1:][slope[moving[1:]] != slope[moving[:-1]]]
    candidates = [0, *change.tolist(), len(values) - 1]
    found: list[int] = []
    start, best, rising = 0, 0, 0
    for index in candidates[1:]:
        value = values[index]
        if not rising:
            if abs(value - values[start]) >= least:
                rising, best = (1 if value > values[start] else -1), index
        elif rising * (value - values[best]) >= 0:
            best = index
        elif rising * (values[best] - value) >= least:
            found.append(best)
            rising, best = -rising, index
    return np.array(found, dtype=int)


def crossings(t: Array, values: Array) -> Array:
    """Instants at which the values pass through zero upwards, interpolated."""
    up = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0))
    before, after = values[up], values[up + 1]
    return t[up] + (t[up + 1] - t[up]) * before / (before - after)


def swings(t: Array, values: Array) -> tuple[float | None, Array]:
    """(mean period, indices of the turning points); the period is None with less than one whole swing."""
    span = float(np.ptp(values)) if len(values) else 0.0
    turns = turning_points(values, 0.02 * span) if span > 0 else np.zeros(0, dtype=int)
    if len(turns) < 2:
        return None, turns
    # The midline of the turning points, not of all values: a recording rarely holds whole swings.
    middle = float(np.mean((values[turns][1:] + values[turns][:-1]) / 2))
    centred = values - middle
    passes = crossings(t, centred)
    falls = crossings(t, -centred)
    spans = [np.diff(p) for p in (passes, falls) if len(p) > 1]
    if not spans:
        return float(2 * np.mean(np.diff(t[turns]))), turns
    return float(np.mean(np.concatenate(spans))), turns


def phasor(t: Array, values: Array, period: float) -> tuple[float, float]:
    """Amplitude and phase (rad) of a signal at one period: the least-squares fit of a cos(wt) + b sin(wt) + c."""
    angle = 2 * np.pi * (t - t[0]) / period
    base = np.column_stack([np.cos(angle), np.sin(angle), np.ones(len(t))])
    a, b, _ = np.linalg.lstsq(base, values, rcond=None)[0]
    return float(np.hypot(a, b)), float(np.arctan2(-b, a))
