"""The ground as squares around the scene, each painted as finely as it is seen, out to the horizon.

Paint that is only repeated would shimmer far away and show its tiles; so natural ground is painted once and for all, with
a second, turned copy of its paint and with large patches, as the preview renderer shades it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from worldkit.materials.look import Look
from worldkit.materials.paint import noise

from .rounded import Mesh

PIXELS = 2048
STEP = 5.0
"""Each square is so much wider than the one inside it."""
FAR_M = 4096.0
VARIED = 0.13
"""Looks that vary at least this much are natural ground."""
NEAR_M, PLAIN_M = 15.0, 90.0
"""From so near to so far large patches fade, m: farther away they would look as if haze lay on the ground."""
TURN = 0.43 * np.array([[0.81, -0.59], [0.59, 0.81]])


class Ring(NamedTuple):
    """A part of the ground: its mesh, at height 0, and its pixels (N, N, 3), scene-linear."""

    mesh: Mesh
    pixels: np.ndarray


def frame(centre: np.ndarray, inner: float, outer: float) -> tuple[np.ndarray, np.ndarray]:
    """Points (V, 3) and triangles (F, 3) between two squares of these half sizes; with `inner` 0 the whole square."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    if inner <= 0:
        points = np.concatenate([corners * outer])
        faces = np.array([(0, 1, 2), (0, 2, 3)])
    else:
        points = np.concatenate([corners * outer, corners * inner])
        faces = np.array(
            [t for k in range(4) for t in ((k, (k + 1) % 4, 4 + k), ((k + 1) % 4, 4 + (k + 1) % 4, 4 + k))]
        )
    return np.column_stack([points + centre, np.zeros(len(points))]), faces


def _mesh(centre: np.ndarray, inner: float, outer: float, half: float, per_metre: float = 0.0) -> Mesh:
    """A frame whose texture covers the square of half size `half`, or is repeated `per_metre`."""
    points, faces = frame(centre, inner, outer)
    if per_metre > 0:
        uv = points[:, :2] * (per_metre, -per_metre)
    else:
        uv = (points[:, :2] - centre) / (2 * half) * (1, -1) + 0.5
    return Mesh(points, np.tile([0.0, 0.0, 1.0], (len(points), 1)), faces, uv)


def _coarse(tile: np.ndarray, texel_m: float, pixel_m: float) -> np.ndarray:
    """The tile, made smaller until its pixels are about as large as those of the picture."""
    import cv2

    while pixel_m > 1.5 * texel_m and len(tile) > 4:
        tile = cv2.resize(tile, (len(tile) // 2, len(tile) // 2), interpolation=cv2.INTER_AREA)
        texel_m *= 2
    return tile


def _lookup(tile: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    import cv2

    size = len(tile)
    wide = np.pad(tile, ((0, 1), (0, 1), (0, 0)), mode="wrap")
    at = ((u % 1.0 * size).astype(np.float32), (v % 1.0 * size).astype(np.float32))
    return cv2.remap(np.ascontiguousarray(wide), *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def _noise() -> np.ndarray:
    field = noise.spectral(512, 1.35, "surroundings", low=1.0)
    return noise.unit(field, 2.6).astype(np.float32)[..., None]


def painted(tile: np.ndarray, look: Look, centre: np.ndarray, half: float) -> np.ndarray:
    """Natural ground over the square of half size `half`, m: scene-linear (PIXELS, PIXELS, 3)."""
    pixel_m, texel_m = 2 * half / PIXELS, look.tile_m / len(tile)
    axis = (np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1
    x, y = np.meshgrid(centre[0] + half * axis, centre[1] - half * axis)
    u, v = x / look.tile_m, -y / look.tile_m
    near = _coarse(tile, texel_m, pixel_m)
    first = _lookup(near, u, v)
    second = _lookup(
        _coarse(tile, texel_m / 0.43, pixel_m),
        TURN[0, 0] * u + TURN[0, 1] * v + 0.31,
        TURN[1, 0] * u + TURN[1, 1] * v + 0.31,
    )
    patches = _noise()
    blend = np.clip((_lookup(patches, u * 0.061, v * 0.061) - 0.35) / 0.30, 0, 1)[..., None]
    out = first + 0.75 * (blend * blend * (3 - 2 * blend)) * (second - first)
    blur = float(np.clip((np.log2(max(pixel_m / texel_m, 1.0)) - 1.5) / 3.0, 0, 1))
    out += 0.85 * blur * (tile.mean(axis=(0, 1)) - out)
    large = _lookup(patches, x * 0.031, y * 0.031) + _lookup(patches, x * 0.0067, y * 0.0067) - 1.0
    away = np.hypot(x - centre[0], y - centre[1])
    share = np.clip((away - NEAR_M) / (PLAIN_M - NEAR_M), 0.0, 1.0)
    large *= 1.0 - 0.8 * share * share * (3 - 2 * share)
    return np.maximum(out * (1.0 + look.vary * 2.4 * large)[..., None], 0.0).astype(np.float32)


def rings(
    tile: np.ndarray | None, tint: np.ndarray, look: Look, per_metre: float, centre: np.ndarray, radius: float
) -> Iterator[Ring]:
    """The ground from the scene out to the horizon.

    Args:
        tile: scene-linear pixels of its paint (N, N, 3), or None for a plain colour.
        tint: scene-linear colour that multiplies them, (3,).
        look: the ground's look.
        per_metre: repeats of the paint.
        centre: of the scene, (2,) m.
        radius: of the scene, m.
    """
    half = max(1.5 * radius, 1.0)
    if tile is None or look.vary < VARIED:
        mean = tint if tile is None else tile.mean(axis=(0, 1)) * tint
        if tile is not None:
            half *= 4
            yield Ring(_mesh(centre, 0.0, half, half, per_metre), tile * tint.astype(np.float32))
        inner = 0.0 if tile is None else half
    else:
        inner = 0.0
        for _ in range(3):
            yield Ring(_mesh(centre, inner, half, half), painted(tile, look, centre, half) * tint.astype(np.float32))
            inner, half = half, half * STEP
        mean = tile.mean(axis=(0, 1)) * tint
    if inner == 0.0:
        yield Ring(_mesh(centre, 0.0, half, half), np.broadcast_to(mean, (2, 2, 3)))
        inner = half
    plain = np.broadcast_to(mean, (2, 2, 3))
    while inner < FAR_M:
        yield Ring(_mesh(centre, inner, 2 * inner, 2 * inner), plain)
        inner *= 2
