"""Painters of what grows and flows: water, leaves, river rock. Each returns a seamless tile (see `stone`)."""

import numpy as np

from . import Painted
from .noise import cells, mix, ramp, smooth, spectral

Rgb = tuple[float, float, float]


def water(size: int, name: str, deep: Rgb, shallow: Rgb) -> Painted:
    """Ripples of several lengths that cross each other, over a depth that changes slowly."""
    long = spectral(size, 1.6, name + "long", stretch=(1.0, 2.2), low=2.0)
    cross = spectral(size, 1.3, name + "cross", stretch=(1.8, 1.0), low=5.0)
    short = spectral(size, 1.0, name + "short", low=14.0)
    height = 0.55 * long + 0.35 * cross + 0.16 * short
    depth = smooth(-1.5, 1.5, spectral(size, 2.2, name + "depth"))
    return Painted(
        mix(deep, shallow, 0.7 * depth + 0.1 * smooth(0.2, 1.6, height)), np.clip(0.5 + 0.2 * height, 0.0, 1.0)
    )


def leaves(size: int, name: str, light: Rgb, middle: Rgb, dark: Rgb) -> Painted:
    """Clumps of small leaves with dark gaps between them."""
    near, far, number = cells(size, 34, name)
    _, _, clump = cells(size, 9, name + "clump")
    leaf = smooth(0.02, 0.16, far - near)
    tone = np.clip(
        0.12 + 0.42 * leaf * (0.5 + 0.5 * number) + 0.34 * clump + 0.05 * spectral(size, 1.2, name), 0.0, 1.0
    )
    return Painted(
        ramp([(0.0, dark), (0.55, middle), (1.0, light)], tone), np.clip(0.2 + 0.5 * leaf * number + 0.3 * clump, 0, 1)
    )


def rock(size: int, name: str, light: Rgb, dark: Rgb, lichen: Rgb) -> Painted:
    """Weathered river rock: uneven, matt, with a little lichen."""
    broad, fine = spectral(size, 1.9, name + "broad"), spectral(size, 0.9, name + "fine", low=6.0)
    tone = np.clip(0.5 + 0.20 * broad + 0.11 * fine, 0.0, 1.0)
    rgb = mix(
        ramp([(0.0, dark), (1.0, light)], tone), lichen, 0.5 * smooth(1.1, 2.2, spectral(size, 1.4, name + "lichen"))
    )
    return Painted(rgb, np.clip(0.5 + 0.22 * broad + 0.10 * fine, 0.0, 1.0))
