"""Tileable noise, the raw material of the painters."""

import zlib

import numpy as np


def random(name: str) -> np.random.Generator:
    """A generator that depends on `name` alone."""
    return np.random.default_rng(zlib.crc32(name.encode()))


def spectral(
    size: int, slope: float, name: str, stretch: tuple[float, float] = (1.0, 1.0), low: float = 0.0
) -> np.ndarray:
    """Tileable noise whose amplitude falls as frequency**-slope: (size, size), mean 0, deviation 1.

    `stretch` (x, y) elongates the features along an axis; frequencies below `low` cycles per tile are left out.
    """
    # The lowest 64 x 64 random numbers do not depend on the size, so that a small and a large picture agree.
    half = size // 2
    fy = np.fft.fftfreq(size, 1.0 / size).astype(np.float32)[:, None]
    fx = np.arange(half + 1, dtype=np.float32)[None, :]
    radius = np.hypot(fx * stretch[0], fy * stretch[1])
    generator = random(name)
    coefficients = np.zeros((size, half + 1), dtype=np.complex64)
    block = 32
    while True:
        reach = min(block, half - 1)
        ring = generator.standard_normal((2 * reach + 1, reach + 1)) + 1j * generator.standard_normal(
            (2 * reach + 1, reach + 1)
        )
        rows = np.arange(-reach, reach + 1)
        target = coefficients[rows % size, : reach + 1]
        coefficients[rows % size, : reach + 1] = np.where(target == 0, ring, target)
        if reach == half - 1:
            break
        block *= 2
    with np.errstate(divide="ignore"):
        amplitude = np.where(radius > max(low, 0.5), radius ** np.float32(-slope), np.float32(0.0))
    field = np.fft.irfft2(coefficients * amplitude, s=(size, size))
    return field / (field.std() + 1e-12)


def cells(size: int, count: int, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Jittered tileable cells, `count` per side: distances to the nearest and second nearest seed, and the cell's number.

    Distances are in units of a cell's side; the numbers are uniform in 0..1 per cell.
    """
    generator = random(name)
    seeds = generator.random((count, count, 2), dtype=np.float32)
    numbers = generator.random((count, count), dtype=np.float32)
    axis = ((np.arange(size) + 0.5) / size * count).astype(np.float32)
    x, y = np.meshgrid(axis, axis)
    column, row = x.astype(int), y.astype(int)
    first = np.full((size, size), 9.0, dtype=np.float32)
    second = first.copy()
    number = np.zeros((size, size), dtype=np.float32)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            c, r = column + dx, row + dy
            seed = seeds[r % count, c % count]
            distance = np.hypot(c + seed[..., 0] - x, r + seed[..., 1] - y)
            nearer = distance < first
            second = np.where(nearer, first, np.minimum(second, distance))
            number = np.where(nearer, numbers[r % count, c % count], number)
            first = np.where(nearer, distance, first)
    return first, second, number


def smooth(edge0: float, edge1: float, value: np.ndarray) -> np.ndarray:
    """Hermite step from 0 at `edge0` to 1 at `edge1`."""
    t = np.clip((value - edge0) / (edge1 - edge0), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def unit(field: np.ndarray, spread: float = 2.2) -> np.ndarray:
    """Squeeze a field of deviation 1 into 0..1."""
    return np.clip(0.5 + field / (2.0 * spread), 0.0, 1.0)


def mix(a, b, t: np.ndarray) -> np.ndarray:
    """Blend colours `a` and `b` ((3,) or (..., 3)) by `t` (...)."""
    t = t[..., None]
    return np.asarray(a) * (1.0 - t) + np.asarray(b) * t


def ramp(stops: list[tuple[float, tuple[float, float, float]]], value: np.ndarray) -> np.ndarray:
    """Colour of `value` on a piecewise linear scale of (position, sRGB) stops."""
    positions = [position for position, _ in stops]
    return np.stack([np.interp(value, positions, [colour[i] for _, colour in stops]) for i in range(3)], axis=-1)
