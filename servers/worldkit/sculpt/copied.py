"""Rows, rings and blocks of copies."""

import math
from collections.abc import Sequence

import numpy as np

from .signatures import signature
from .signed import AXES, Array, Shape, Vec3, boxed, rotation_about, smallest, union


def linear(shape: Shape, count: int, step: Vec3, radius: float = 0.0) -> Shape:
    """An array: `count` copies, each `step` (m) from the one before; the first stays where the shape is."""
    if count < 1:
        raise ValueError(f"linear: there must be copies, not {count}")
    return union(*(shape.translate(*(k * np.asarray(step, dtype=float))) for k in range(count)), radius=radius)


def radial(shape: Shape, count: int, axis: str = "z", about: Vec3 = (0.0, 0.0, 0.0), radius: float = 0.0) -> Shape:
    """An array round an axis through `about`: `count` copies at equal angles; each may reach into its neighbours' sectors."""
    if count < 1:
        raise ValueError(f"radial: there must be copies, not {count}")
    k, pivot = AXES[axis], np.array(about, dtype=float)
    i, j = (k + 1) % 3, (k + 2) % 3
    turns = [rotation_about(360.0 * n / count, axis) for n in range(count)]
    low, high = boxed(np.concatenate([pivot + (shape.corners() - pivot) @ turn.T for turn in turns]))
    middle = shape.centre - pivot
    phase = math.atan2(middle[j], middle[i])

    def measure(p: Array) -> Array:
        q = p - pivot
        sector = (np.arctan2(q[:, j], q[:, i]) - phase) * count / (2 * np.pi)
        nearest = np.round(sector)
        second = nearest + np.where(sector >= nearest, 1.0, -1.0)
        both = []
        for copy in (nearest, second)[: min(count, 2)]:
            angle = -copy * 2 * np.pi / count
            cos, sin, turned = np.cos(angle), np.sin(angle), q.copy()
            turned[:, i], turned[:, j] = cos * q[:, i] - sin * q[:, j], sin * q[:, i] + cos * q[:, j]
            both.append(shape.measure(turned + pivot))
        return both[0] if len(both) == 1 else smallest(both[0], both[1], radius)

    return Shape(measure, low - radius / 4, high + radius / 4, signature("radial", shape, count, axis, pivot, radius))


def repeat(shape: Shape, period: Vec3, counts: Sequence[int]) -> Shape:
    """A block of copies, `counts` (3,) along x, y, z, `period` (m) apart, centred on the shape; a copy must fit its cell."""
    apart, half = np.asarray(period, dtype=float), (np.asarray(counts, dtype=float) - 1) / 2
    if not ((apart > 0) & (half >= 0)).all():
        raise ValueError("repeat: periods must be positive, and counts at least 1")
    if (shape.size > apart * np.where(half > 0, 1.0, np.inf)).any():
        raise ValueError("repeat: a copy is larger than its cell; use linear(), or a longer period")

    def measure(p: Array) -> Array:
        cell = np.clip(np.round((p - shape.centre) / apart + half), 0, 2 * half) - half
        return shape.measure(p - cell * apart)

    return Shape(measure, shape.low - half * apart, shape.high + half * apart, signature("repeat", shape, apart, half))
