"""The colour of a hand: how much blood shows and how dark it is at each point, by the bones under it; its nails."""

from collections.abc import Callable
from functools import partial

import numpy as np

from . import brushes
from .hand_bones import BONES, THICK, THUMB_BONES, THUMB_THICK, Bones
from .hand_flesh import MM, PALM_LINES, digit, from_line
from .signed import Array

SKIN = "#c68c73"
"""A middle skin colour, sRGB."""
SIDE = 64
"""Pixels along a side of the picture of all colours that a hand has."""


def tones(points: Array, bones: Bones) -> Array:
    """(N, 2), 0 to 1: how red, and how light, the skin of a right hand is at points (N, 3), m."""
    s = bones.scale
    mm = MM * s
    red = (
        0.26
        + 0.34 * (brushes.mottled(points, 9 * mm, seed=2) - 0.5)
        + 0.16 * (brushes.mottled(points, 3 * mm, seed=5) - 0.5)
    )
    light = (
        0.56
        + 0.10 * (brushes.mottled(points, 14 * mm, seed=3) - 0.5)
        + 0.06 * (brushes.mottled(points, 1.6 * mm, seed=4) - 0.5)
    )
    chains = [(chain, BONES[k] * s, THICK[k] * s) for k, chain in enumerate(bones.fingers)]
    chains.append((bones.thumb, THUMB_BONES * s, THUMB_THICK * s))
    under = np.where((points[:, 0] > 2 * mm) & (points[:, 2] < -6 * mm), 1.0, 0.0)  # on the palm's side
    nearest = np.full(len(points), 0.016 * s)
    for number, (chain, long, thick) in enumerate(chains):
        for k, (at, turned) in enumerate(chain):
            if number == 4 and k == 0:
                continue
            local = (points - at) @ turned
            t = np.clip(local[:, 0], 0.0, long[k])
            away = np.hypot(np.hypot(local[:, 0] - t, local[:, 1]), local[:, 2])
            mine = (away < nearest) & (local[:, 0] > -0.3 * thick[k])
            nearest[mine] = away[mine]
            under[mine] = np.clip(0.5 - local[mine, 2] / (0.9 * thick[k]), 0.0, 1.0)
            joint = np.exp(-((np.linalg.norm(points - at, axis=1) / (1.35 * thick[k])) ** 2))
            red += (0.36 if k else 0.46) * joint
            if k:
                fold = np.exp(-((local[:, 0] / (1.2 * mm)) ** 2)) * (away < 1.4 * thick[k])
                light -= fold * np.where(local[:, 2] < 0, 0.15, 0.08)
        at, turned = chain[2]
        tip = at + turned @ np.array([long[2] - 0.8 * thick[3], 0.0, -0.2 * thick[3]])
        red += 0.40 * np.exp(-((np.linalg.norm(points - tip, axis=1) / (1.25 * thick[3])) ** 2))
    for line in PALM_LINES:
        path = np.array(line, dtype=float) * mm
        on = points[:, 2] < -4 * mm
        if on.any():
            fold = np.exp(-((from_line(points[on, :2], path) / (1.3 * mm)) ** 2)) * np.clip(
                (nearest[on] - 0.008 * s) / (0.008 * s), 0, 1
            )
            light[on] -= 0.13 * fold
            red[on] += 0.2 * fold
    light += 0.13 * under
    red += 0.14 * under
    for pad, wide in (((32, 30, -20), 22.0), ((38, -30, -18), 20.0), ((78, 2, -14), 16.0)):  # the pads of the palm
        red += 0.16 * under * np.exp(-((np.linalg.norm(points - np.array(pad) * mm, axis=1) / (wide * mm)) ** 2))
    return np.clip(np.stack([red, light], axis=1), 0.0, 1.0)


def palette(skin: str = SKIN) -> Array:
    """uint8 (SIDE, SIDE, 3) sRGB: all colours of a skin, redder along its columns, lighter along its rows."""
    return np.asarray(
        np.round(255 * _colour(np.stack(np.meshgrid(*2 * [np.linspace(0, 1, SIDE)]), axis=-1), skin)), dtype=np.uint8
    )


def _colour(told: Array, skin: str) -> Array:
    base = brushes.plain(np.zeros((1, 3)), skin)[0]
    red, light = told[..., :1], told[..., 1:]
    pale, flushed = base * (1.03, 1.05, 1.02), base * (1.03, 0.76, 0.70)
    return np.asarray(np.clip((pale + red * (flushed - pale)) * (0.62 + 0.72 * light), 0.0, 1.0))


def paint(bones: Bones, left: bool, skin: str = SKIN) -> Callable[[Array, Array], tuple[Array, Array]]:
    """A paint of `worldkit.sculpt` for the shape of a hand: its skin and its nails, and how rough they are."""
    return partial(_painted, bones=bones, flip=np.array([1.0, -1.0 if left else 1.0, 1.0]), skin=skin)


def _painted(points: Array, normals: Array, bones: Bones, flip: Array, skin: str) -> tuple[Array, Array]:
    points, normals = points * flip, normals * flip
    rgb, rough = _colour(tones(points, bones), skin), np.full(len(points), 0.5)
    for chain, long, thick in [
        *((bones.fingers[k], BONES[k], THICK[k]) for k in range(4)),
        (bones.thumb, THUMB_BONES, THUMB_THICK),
    ]:
        at, turned = chain[2]
        local, out = (points - at) @ turned / bones.scale, normals @ turned
        x, y = (local[:, 0] - 0.46 * long[2]) / (0.49 * long[2]), local[:, 1] / (0.78 * thick[3])
        on = (
            (out[:, 2] > 0.25)
            & (x > 0)
            & (x < 1.1)
            & (np.abs(y) < _half(np.clip(x, 0, 1)))
            & (np.abs(local[:, 2]) < 0.012)
        )
        rgb[on], rough[on] = NAIL[np.clip((x[on] * 63).astype(int), 0, 63)] / 255.0, 0.3
    return rgb, rough


def _half(x: Array) -> Array:
    """Half the width of a nail along it: round at its root, nearly straight, a little rounded at its end."""
    return np.asarray(
        np.sqrt(np.clip(1 - (1 - np.clip(x / 0.34, 0, 1)) ** 2, 0, 1))
        * (1 - 0.30 * np.clip((x - 0.80) / 0.20, 0, 1) ** 2)
    )


def _nail_colours() -> Array:
    along = np.linspace(0, 1, 64)
    return np.round(
        255
        * brushes.gradient(
            along,
            {
                0.0: "#c08a74",
                0.08: "#d3a794",
                0.2: "#c98f7d",
                0.5: "#c68575",
                0.84: "#c88f7f",
                0.93: "#dcbfae",
                1.0: "#e0c9b8",
            },
        )
    )


NAIL = _nail_colours()
"""(64, 3), 0 to 255: from the pale moon at its root to its white edge."""


def nails(bones: Bones) -> tuple[Array, Array, Array]:
    """The five nails of a right hand as one mesh: vertices (V, 3), m, faces (F, 3), and uv (V, 2), v along each nail."""
    s = bones.scale
    rows, columns = 15, 11
    points: list[Array] = []
    faces: list[Array] = []
    uv: list[Array] = []
    u, v = np.meshgrid(np.linspace(-1, 1, columns), np.linspace(0.02, 1, rows))
    for k in range(5):
        long, thick = (BONES[k], THICK[k]) if k < 4 else (THUMB_BONES, THUMB_THICK)
        part = digit(
            [(np.array([x, 0.0, 0.0]), np.eye(3)) for x in (-long[0] - long[1], -long[1], 0.0)], long, thick, 1.0
        )
        x, y = (0.46 + 0.47 * v) * long[2], 0.78 * thick[3] * u * _half(v)
        # The nail is a bent plate that keeps its bow to its edge, where the flesh falls away under it.
        held = np.minimum(x, 0.86 * long[2])
        low, high = np.zeros(x.shape), np.full(x.shape, 0.014)
        for _ in range(18):
            middle = (low + high) / 2
            inside = part.measure(np.stack([held, y, middle], -1).reshape(-1, 3)).reshape(x.shape) < 0
            low, high = np.where(inside, middle, low), np.where(inside, high, middle)
        z = (
            low
            + 0.22 * MM
            - 0.6 * MM * np.abs(u) ** 6
            - 0.7 * MM * np.clip(1 - v / 0.10, 0, 1)
            - 0.42 * np.maximum(x - held, 0.0)
        )
        at, turned = (bones.thumb if k == 4 else bones.fingers[k])[2]
        top = at + np.stack([x, y, z], -1).reshape(-1, 3) * s @ turned.T
        first, grid = len(points) * rows * columns, np.arange(rows * columns).reshape(rows, columns)
        a, b, c, d = (g.ravel() for g in (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]))
        points.append(top)
        faces.append(first + np.concatenate([np.stack([a, d, c], 1), np.stack([a, c, b], 1)]))
        uv.append(np.stack([np.full(u.size, 0.5), v.ravel()], axis=1))
    return np.concatenate(points), np.concatenate(faces), np.concatenate(uv)
