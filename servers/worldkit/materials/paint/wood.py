"""Wood: solid grain and floor boards."""

import numpy as np

from . import Painted
from .noise import mix, ramp, random, smooth, spectral, unit

Rgb = tuple[float, float, float]


def _grain(size: int, name: str, rings: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Growth rings, fine fibres and pores along x, each (size, size) in 0..1.

    A board is cut beside the pith of a trunk that is not quite straight: where the cut lies flat on the rings they open into arches,
    and at its sides they stand close together. `rings` is how many of them there are in the radius that is half as long as a tile.
    """
    v = (np.arange(size)[:, None] + 0.5) / size
    warp = spectral(size, 3.2, name + "warp", stretch=(6.0, 1.0))
    wave = spectral(size, 2.2, name + "wave", stretch=(9.0, 1.0), low=3.0)
    beside = 0.5 * np.sin(2 * np.pi * (v + 0.05 * warp))  # it swings, so that the tile repeats
    above = 0.0875 + 0.315 * unit(spectral(size, 3.4, name + "depth", stretch=(3.0, 1.0)))
    phase = rings * np.hypot(beside, above) + 0.22 * wave + 0.5 * warp
    year, grown = np.floor(phase), np.mod(phase, 1.0)
    fat = 0.55 + 0.45 * np.sin(12.9898 * year) ** 2  # no two years are alike
    ring = smooth(0.15, 0.85, grown) * (1.0 - smooth(0.9, 1.0, grown)) * fat
    fibre = unit(spectral(size, 0.7, name + "fibre", stretch=(26.0, 1.0), low=6.0))
    pores = smooth(1.35, 2.3, spectral(size, 0.35, name + "pores", stretch=(16.0, 1.0), low=24.0))
    return ring, fibre, pores


def solid(size: int, name: str, light: Rgb, middle: Rgb, dark: Rgb, rings: float = 24.0, pore: float = 0.5) -> Painted:
    """A slab of one piece, grain along x."""
    ring, fibre, pores = _grain(size, name, rings)
    cloud = unit(spectral(size, 1.6, name + "cloud", stretch=(3.0, 1.0)))
    tone = np.clip(0.42 * ring + 0.34 * fibre + 0.24 * cloud + 0.07, 0.0, 1.0)
    rgb = ramp([(0.12, light), (0.5, middle), (0.95, dark)], tone)
    rgb = mix(rgb, np.asarray(dark) * 0.62, pore * pores)
    return Painted(rgb, np.clip(0.9 - 0.35 * pores - 0.12 * fibre, 0.0, 1.0))


def planks(
    size: int,
    name: str,
    light: Rgb,
    middle: Rgb,
    dark: Rgb,
    rows: int = 10,
    contrast: float = 1.0,
    gap_width: float = 0.018,
) -> Painted:
    """Floor boards along x: `rows` boards per tile, staggered joints, every board of its own tone and figure."""
    generator = random(name)
    ring, fibre, pores = _grain(size, name, 70.0)
    ring2, fibre2, _ = _grain(size, name + "b", 90.0)
    v = (np.arange(size)[:, None] + 0.5) / size * rows
    u = (np.arange(size)[None, :] + 0.5) / size
    row = np.floor(v).astype(int)[:, 0]
    joints = generator.random(rows)[row][:, None]
    along = np.mod(u - joints, 1.0) * 2.0
    board = np.floor(along).astype(int)
    number = row[:, None] * 2 + board
    tones = generator.normal(0.0, 0.13, 2 * rows) * contrast
    hues = generator.normal(0.0, 0.018, 2 * rows) * contrast
    figure = generator.random(2 * rows)
    shift = generator.integers(0, size, 2 * rows)
    x = (np.arange(size)[None, :] + shift[number]) % size
    y = (np.arange(size)[:, None] + shift[number] // 3) % size
    first = figure[number] < 0.5
    g = np.where(first, ring[y, x], ring2[y, x])
    f = np.where(first, fibre[y, x], fibre2[y, x])
    tone = np.clip(0.34 * g + 0.36 * f + 0.22 + tones[number], 0.0, 1.0)
    rgb = ramp([(0.05, light), (0.5, middle), (1.0, dark)], tone)
    rgb = mix(rgb, np.asarray(dark) * 0.7, 0.35 * pores[y, x])
    rgb = rgb * (1.0 + np.stack([hues[number], 0.2 * hues[number], -0.9 * hues[number]], -1))
    across = np.minimum(np.mod(v, 1.0), 1.0 - np.mod(v, 1.0)) * np.ones_like(u)
    end = np.minimum(np.mod(along, 1.0), 1.0 - np.mod(along, 1.0)) * rows / 2.0
    edge = np.minimum(across, end)
    gap = 1.0 - smooth(0.25 * gap_width, gap_width, edge)
    worn = 1.0 - smooth(gap_width, 4.0 * gap_width, edge)
    rgb = mix(rgb * (1.0 - 0.10 * worn[..., None]), np.asarray(dark) * 0.22, 0.92 * gap)
    height = np.clip(0.92 - 0.85 * gap - 0.10 * worn - 0.05 * f - 0.07 * pores[y, x], 0.0, 1.0)
    return Painted(rgb, height)
