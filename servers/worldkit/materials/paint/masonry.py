"""Brick and tiles laid in courses."""

import numpy as np

from . import Painted
from .noise import mix, ramp, random, smooth, spectral

Rgb = tuple[float, float, float]


def _courses(size: int, rows: int, columns: int, offset: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distance to the nearest joint across and along (fractions of a row), and the piece's number."""
    v = (np.arange(size)[:, None] + 0.5) / size * rows
    row = np.floor(v).astype(int)
    u = (np.arange(size)[None, :] + 0.5) / size * columns + offset * (row % 2)
    column = np.floor(u).astype(int) % columns
    across = np.minimum(np.mod(v, 1.0), 1.0 - np.mod(v, 1.0)) + 0.0 * u
    along = np.minimum(np.mod(u, 1.0), 1.0 - np.mod(u, 1.0)) * rows / columns
    return across, along, row * columns + column


def bricks(size: int, name: str, light: Rgb, dark: Rgb, joint: Rgb, rows: int = 8, columns: int = 3) -> Painted:
    """Running bond of fired bricks with sandy joints."""
    across, along, number = _courses(size, rows, columns, 0.5)
    generator = random(name)
    tones = generator.random(rows * columns)
    rough = spectral(size, 1.1, name + "rough", low=4.0)
    fine = spectral(size, 0.4, name + "fine", low=16.0)
    inside = smooth(0.055, 0.095, np.minimum(across, along) + 0.010 * rough)
    tone = np.clip(0.15 + 0.7 * tones[number] + 0.09 * rough + 0.06 * fine, 0.0, 1.0)
    brick = ramp([(0.0, dark), (1.0, light)], tone)
    mortar = np.asarray(joint) * (1.0 + 0.07 * fine)[..., None]
    return Painted(mix(mortar, brick, inside), np.clip(inside * (0.8 + 0.05 * rough) + 0.12 + 0.03 * fine, 0.0, 1.0))


def tiles(size: int, name: str, tone: Rgb, joint: Rgb, count: int = 4, second: Rgb | None = None) -> Painted:
    """Square glazed tiles; with `second`, a chequerboard."""
    across, along, number = _courses(size, count, count, 0.0)
    generator = random(name)
    value = 1.0 + 0.022 * generator.normal(size=count * count)[number] + 0.008 * spectral(size, 1.6, name)
    inside = smooth(0.012, 0.02, np.minimum(across, along))
    base = np.asarray(tone) * np.ones((size, size, 1))
    if second is not None:
        odd = (number // count + number % count) % 2 == 1
        base = np.where(odd[..., None], np.asarray(second), base)
    return Painted(mix(joint, base * value[..., None], inside), np.clip(0.1 + 0.85 * inside, 0.0, 1.0))
