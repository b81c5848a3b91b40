"""Procedural textures: every painter is a pure function of its arguments, so that a look is the same everywhere.

A flat painter takes ``size`` (pixels) and returns a tileable `Painted`; a painter of things seen all around takes unit
directions (..., 3) and returns sRGB colours and heights of the same leading shape.
"""

import importlib
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..look import Look


class Painted(NamedTuple):
    """A texture: `rgb` (H, W, 3) sRGB in 0..1 and `height` (H, W) in 0..1."""

    rgb: np.ndarray
    height: np.ndarray


def _painter(look: Look):
    family, function = str(look.paint).split(".")
    return getattr(importlib.import_module(f".{family}", __package__), function)


def _bytes(rgb: np.ndarray) -> np.ndarray:
    return (np.clip(rgb, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)


@lru_cache(maxsize=96)
def tile(look: Look, size: int) -> np.ndarray:
    """The flat texture of `look`: uint8 (size, size, 4), sRGB and relief height; row 0 is the top."""
    painted = _painter(look)(size, *look.arguments)
    return np.concatenate([_bytes(painted.rgb), _bytes(painted.height)[..., None]], axis=-1)


@lru_cache(maxsize=4)
def cube_directions(size: int) -> np.ndarray:
    """Unit directions of the texels of a cube map: (6, size, size, 3), faces +x -x +y -y +z -z in OpenGL's layout."""
    axis = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    s, t = np.meshgrid(axis, axis)
    one = np.ones_like(s)
    faces = np.stack(
        [
            np.stack([one, -t, -s], -1),
            np.stack([-one, -t, s], -1),
            np.stack([s, one, t], -1),
            np.stack([s, -one, -t], -1),
            np.stack([s, -t, one], -1),
            np.stack([-s, -t, -one], -1),
        ]
    )
    return (faces / np.linalg.norm(faces, axis=-1, keepdims=True)).astype(np.float32)


@lru_cache(maxsize=96)
def cube(look: Look, size: int) -> np.ndarray:
    """The texture of `look` around a centre: uint8 (6, size, size, 4), sRGB and relief height."""
    rgb, height = _painter(look)(cube_directions(size), *look.arguments)
    return np.concatenate([_bytes(rgb), _bytes(height)[..., None]], axis=-1)
