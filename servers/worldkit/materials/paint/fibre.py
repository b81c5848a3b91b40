"""Cloth, felt, leather, paper, card, brushed metal: surfaces made of fibres, threads or strokes."""

import numpy as np

from . import Painted
from .noise import cells, mix, smooth, spectral, unit

Rgb = tuple[float, float, float]


def felt(size: int, name: str, tone: Rgb) -> Painted:
    """Napped wool: short tangled hairs and a faint nap."""
    hairs = np.maximum(
        spectral(size, 0.5, name + "a", stretch=(1.0, 3.0), low=10.0),
        spectral(size, 0.5, name + "b", stretch=(3.0, 1.0), low=10.0),
    )
    nap = spectral(size, 1.8, name + "nap")
    value = 1.0 + 0.075 * (hairs - 0.6) + 0.022 * nap
    return Painted(np.asarray(tone) * value[..., None], np.clip(0.45 + 0.16 * hairs, 0.0, 1.0))


def weave(size: int, name: str, warp: Rgb, weft: Rgb, threads: int = 32, slub: float = 1.0) -> Painted:
    """Plain weave of `threads` per side, with uneven yarn."""
    axis = (np.arange(size) + 0.5) / size * threads
    x, y = np.meshgrid(axis, axis)
    x = x + 0.12 * slub * spectral(size, 1.7, name + "x")
    y = y + 0.12 * slub * spectral(size, 1.7, name + "y")
    over = (np.floor(x).astype(int) + np.floor(y).astype(int)) % 2 == 0
    across_x = np.sin(np.pi * np.mod(x, 1.0))
    across_y = np.sin(np.pi * np.mod(y, 1.0))
    crown = np.where(over, across_x * (0.55 + 0.45 * across_y), across_y * (0.55 + 0.45 * across_x))
    yarn_x = spectral(size, 1.0, name + "u", stretch=(1.0, 22.0), low=4.0)
    yarn_y = spectral(size, 1.0, name + "v", stretch=(22.0, 1.0), low=4.0)
    value = (0.60 + 0.40 * np.sqrt(np.clip(crown, 0, 1))) * (1.0 + 0.07 * slub * np.where(over, yarn_x, yarn_y))
    rgb = np.where(over[..., None], np.asarray(warp), np.asarray(weft)) * value[..., None]
    return Painted(rgb, np.clip(crown, 0.0, 1.0))


def leather(size: int, name: str, tone: Rgb) -> Painted:
    """Pebbled hide: small convex cells with creases."""
    near, far, number = cells(size, 36, name)
    crease = 1.0 - smooth(0.02, 0.30, far - near)
    cloud = spectral(size, 1.8, name + "cloud")
    value = (0.94 + 0.10 * number + 0.06 * cloud) * (1.0 - 0.34 * crease)
    rgb = np.asarray(tone) * value[..., None]
    return Painted(rgb, np.clip(0.95 - 0.8 * crease - 0.15 * near, 0.0, 1.0))


def paper(size: int, name: str, tone: Rgb, contrast: float = 1.0) -> Painted:
    """Uncoated paper: cloudy fibres."""
    fine = spectral(size, 0.7, name + "fine", low=12.0)
    value = 1.0 + contrast * (0.012 * fine + 0.010 * spectral(size, 1.6, name))
    return Painted(np.asarray(tone) * value[..., None], np.clip(0.5 + 0.1 * fine, 0.0, 1.0))


def cardboard(size: int, name: str, tone: Rgb) -> Painted:
    """Corrugated board: kraft fibres over faint flutes."""
    fine = spectral(size, 0.6, name + "fine", stretch=(3.0, 1.0), low=8.0)
    u = np.arange(size)[None, :] / size
    flute = np.sin(2.0 * np.pi * 36.0 * u) + 0.0 * fine
    fleck = smooth(2.0, 3.0, spectral(size, 0.8, name + "fleck", stretch=(4.0, 1.0), low=16.0))
    value = 1.0 + 0.035 * fine + 0.022 * flute + 0.03 * spectral(size, 1.7, name) - 0.25 * fleck
    return Painted(np.asarray(tone) * value[..., None], np.clip(0.5 + 0.2 * flute + 0.05 * fine, 0.0, 1.0))


def brushed(size: int, name: str, tone: Rgb) -> Painted:
    """Metal brushed along x."""
    stroke = spectral(size, 0.35, name + "stroke", stretch=(40.0, 1.0), low=6.0)
    value = 1.0 + 0.055 * stroke + 0.02 * spectral(size, 1.8, name)
    return Painted(np.asarray(tone) * value[..., None], np.clip(0.5 + 0.16 * stroke, 0.0, 1.0))


def worn(size: int, name: str, tone: Rgb, contrast: float = 1.0) -> Painted:
    """A moulded or cast surface with the slightest unevenness."""
    fine = spectral(size, 0.5, name + "fine", low=24.0)
    value = 1.0 + contrast * (0.02 * fine + 0.03 * spectral(size, 1.8, name))
    return Painted(np.asarray(tone) * value[..., None], np.clip(0.5 + 0.15 * fine, 0.0, 1.0))


def rust(size: int, name: str, metal: Rgb, oxide: Rgb) -> Painted:
    """Iron with patches of rust."""
    patch = smooth(-0.5, 1.0, spectral(size, 1.35, name + "patch"))
    fine = spectral(size, 0.8, name + "fine", low=6.0)
    rgb = mix(np.asarray(metal), np.asarray(oxide), np.clip(patch + 0.12 * fine, 0, 1))
    rgb = rgb * (1.0 + 0.10 * fine)[..., None]
    return Painted(rgb, np.clip(unit(fine) * (0.3 + 0.7 * patch), 0.0, 1.0))
