"""How finely each of very many round things is drawn: thousands of flakes are not all made as round as the one before the lens."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .eye import View

ROUND = ("sphere", "capsule", "cylinder")
"""Shapes that are made of sectors."""
MANY = 200
"""Fewer things than these are all drawn as finely as the largest of them is seen, in one stretch."""
NEAREST = 64
"""Of many, so many at most are drawn each as finely as it is seen; all others as the largest of these others."""
LEAST_SECTORS, USUAL_SECTORS = 8, 16
"""Around what is one of many, and around what is not."""
UNSEEN_PX, UNSEEN_SWARM_PX = 40.0, 4.0
"""The radius assumed where no eye looks, as in the shadow map; of one of many, whose shadows are small, too."""
NEAR_M = 0.05


def seen_px(rows: np.ndarray, view: View, height: int) -> np.ndarray:
    """(N,) the radius with which things of these rows (N, 40) show in a picture of `height` pixels; 0 of many's behind the eye."""
    depth = (rows[:, [3, 7, 11]] - view.eye) @ view.forward
    wide = rows[:, 12:14].max(axis=1)
    pixels = wide / np.maximum(depth, NEAR_M) * height / (2.0 * view.tangents[1])
    if len(rows) >= MANY:
        pixels[depth < -(wide + np.abs(rows[:, 15]))] = 0.0
    return np.asarray(pixels)


def stretches(pixels: np.ndarray) -> Iterator[tuple[int, int, float]]:
    """First thing, number of them and radius, pixels, of stretches that are each drawn alike, of things of such radii (N,)."""
    if len(pixels) < MANY:
        if len(pixels):
            yield 0, len(pixels), float(pixels.max())
        return
    usual = float(np.partition(pixels, -NEAREST - 1)[-NEAREST - 1])
    near = pixels > usual
    ends = np.flatnonzero(near[1:] != near[:-1]) + 1
    for first, after in zip([0, *ends.tolist()], [*ends.tolist(), len(pixels)], strict=True):
        yield first, after - first, float(pixels[first:after].max()) if near[first] else usual


def least_sectors(count: int) -> int:
    """The fewest sectors of one of so many things."""
    return LEAST_SECTORS if count >= MANY else USUAL_SECTORS
