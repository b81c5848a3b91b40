"""Painters of what grows and flows: water, leaves, bark, river rock. Each returns a seamless tile (see `stone`)."""

import numpy as np

from . import Painted
from .noise import cells, mix, ramp, smooth, spectral, unit

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


def blade(size: int, name: str, light: Rgb, middle: Rgb, vein: Rgb, spots: Rgb, spotted: float) -> Painted:
    """One leaf from near: fields between fine veins, a soft change of colour, and `spotted` of it (0..1) gone to spots."""
    near, far, number = cells(size, 10, name)
    fine_near, fine_far, _ = cells(size, 40, name + "fine")
    net = 0.6 * (1.0 - smooth(0.01, 0.10, far - near)) + 0.35 * (1.0 - smooth(0.03, 0.22, fine_far - fine_near))
    cloud = unit(spectral(size, 2.0, name + "cloud"))
    rgb = mix(middle, light, np.clip(0.75 * cloud + 0.3 * (number - 0.5), 0.0, 1.0))
    worn = smooth(2.6 - 2.6 * spotted, 3.2 - 2.6 * spotted, spectral(size, 1.7, name + "spots") + 0.3 * number)
    rgb = mix(mix(rgb, spots, worn), vein, 0.55 * np.clip(net, 0.0, 1.0))
    return Painted(rgb, np.clip(0.75 - 0.4 * net + 0.1 * cloud, 0.0, 1.0))


def bark(size: int, name: str, ridge: Rgb, middle: Rgb, crack: Rgb, moss: Rgb) -> Painted:
    """Bark of a trunk or bough along x: long ridges, deep cracks that part and meet, cross cracks, a little moss."""
    wander = spectral(size, 2.4, name + "wander", stretch=(2.5, 1.0))
    plates = spectral(size, 2.6, name + "plates", stretch=(4.5, 1.0), low=9.0)
    cross = spectral(size, 2.4, name + "cross", stretch=(1.0, 1.6), low=9.0)
    fine = spectral(size, 0.8, name + "fine", stretch=(3.0, 1.0), low=12.0)
    split = 1.0 - smooth(0.04, 0.75, np.abs(plates + 0.12 * fine))  # where a ridge ends
    split = np.maximum(split, 0.7 * (1.0 - smooth(0.03, 0.35, np.abs(cross + 0.1 * fine))) * smooth(0.2, 1.0, plates))
    tone = np.clip(0.55 + 0.16 * fine + 0.16 * wander - 0.25 * split, 0.0, 1.0)
    rgb = mix(ramp([(0.0, crack), (0.5, middle), (1.0, ridge)], tone), crack, 0.85 * split)
    grown = smooth(0.9, 2.0, spectral(size, 1.8, name + "moss")) * (1.0 - 0.7 * split)
    return Painted(mix(rgb, moss, 0.45 * grown), np.clip(0.8 + 0.07 * fine + 0.06 * wander - 0.75 * split, 0.0, 1.0))


def rock(size: int, name: str, light: Rgb, dark: Rgb, lichen: Rgb) -> Painted:
    """Weathered river rock: uneven, matt, with a little lichen."""
    broad, fine = spectral(size, 1.9, name + "broad"), spectral(size, 0.9, name + "fine", low=6.0)
    tone = np.clip(0.5 + 0.20 * broad + 0.11 * fine, 0.0, 1.0)
    rgb = mix(
        ramp([(0.0, dark), (1.0, light)], tone), lichen, 0.5 * smooth(1.1, 2.2, spectral(size, 1.4, name + "lichen"))
    )
    return Painted(rgb, np.clip(0.5 + 0.22 * broad + 0.10 * fine, 0.0, 1.0))
