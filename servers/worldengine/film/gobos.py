"""Slides that a film holds before its key light: what part of the light goes through, as a picture; nothing of it is ever seen.

A slide lies across the light, through the film's own point. Both renderers read the same one, so their shadows agree.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from worldkit.filming.film_bounds import FAR_M, GOBO_M, GOBOS

PIXELS = 1024
REACH = 4.0
"""A slide reaches so many times its pattern's size to each side of its middle; beyond it all light goes through."""
AWAY = {"leaves": 3.5}
"""So many times its size is the pattern before what it falls on, which softens it; others are 2.5."""
FADE = 0.1
"""The share of the slide, at its edges, over which it becomes clear."""


class Gobo(NamedTuple):
    """One slide as a film tells it."""

    kind: str
    size_m: float
    """The pattern's size: a pane of a window, five slats, three bars, a tuft of leaves, m."""
    turn_deg: float
    seed: int
    at: tuple[float, float, float]
    """The middle of the pattern lies on the light's way to this point of the world, m."""

    def across(self, direction: np.ndarray) -> np.ndarray:
        """(3, 4): what of a point of the world, m, comes to lie where on the slide: right and up from its middle, in units of
        its reach, -1 to 1, as seen from the light, and how far on, m; `direction` points to the light."""
        along = -np.asarray(direction, dtype=float)
        side = np.cross(along, [0.0, 0.0, 1.0] if abs(along[2]) < 0.99 else [0.0, 1.0, 0.0])
        side /= np.linalg.norm(side)
        up, turn = np.cross(side, along), np.radians(self.turn_deg)
        rows = np.stack([np.cos(turn) * side + np.sin(turn) * up, np.cos(turn) * up - np.sin(turn) * side, along])
        rows[:2] /= REACH * self.size_m
        return np.column_stack([rows, -rows @ np.array(self.at)])


def told(film: dict[str, Any]) -> Gobo | None:
    """The slide of a film's description, read with distrust; a ValueError for none that may be."""
    if film.get("gobo") is None:
        return None
    one = film["gobo"]
    x, y, z = (float(v) for v in one["at"])
    found = Gobo(str(one["kind"]), float(one["size_m"]), float(one["turn_deg"]), int(one["seed"]), (x, y, z))
    near = np.abs([found.turn_deg, x, y, z]).max() <= FAR_M
    if found.kind not in GOBOS or not (GOBO_M[0] <= found.size_m <= GOBO_M[1] and 0 <= found.seed < 1 << 32 and near):
        raise ValueError(f"no pattern {found.kind!r} of {found.size_m} m can be held before the light")
    return found


@lru_cache(maxsize=4)
def slide(kind: str, seed: int, spread: float) -> np.ndarray:
    """The share of light that goes through, float32 (N, N), row 0 the top; `spread` is the tangent of the light's radius."""
    import cv2

    drawn = _KINDS[kind](np.random.default_rng(seed)).astype(np.float32)
    blur = max(0.5 * spread * AWAY.get(kind, 2.5) * PIXELS / (2 * REACH), 0.6)
    drawn = np.asarray(cv2.GaussianBlur(drawn, (0, 0), blur), np.float32)
    from_edge = np.minimum(np.arange(PIXELS), np.arange(PIXELS)[::-1]) / (FADE * PIXELS)
    kept = np.minimum(np.minimum(from_edge[:, None], from_edge[None]), 1.0).astype(np.float32)
    found: np.ndarray = np.clip(1.0 - (1.0 - drawn) * kept, 0.0, 1.0)
    found.setflags(write=False)
    return found


def _grid() -> tuple[np.ndarray, np.ndarray]:
    """Right and up of every pixel, in sizes of the pattern."""
    side = ((np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * REACH
    return side[None, :], -side[:, None]


def _near(values: np.ndarray, apart: float, wide: float) -> np.ndarray:
    """Whether values lie within half of `wide` of the middle between two multiples of `apart`."""
    return np.abs(values / apart % 1.0 - 0.5) * apart < wide / 2


def _window(_: np.random.Generator) -> np.ndarray:
    x, y = _grid()
    frames = _near(x, 3.0, 0.19) | _near(y, 3.6, 0.19)
    return 1.0 - (_near(x, 1.0, 0.085) | _near(y, 1.2, 0.085) | frames)


def _blinds(random: np.random.Generator) -> np.ndarray:
    x, y = _grid()
    cords = sum(np.abs(x - at) < 0.012 for at in (-2.7, -0.9, 0.9, 2.7))
    slats = _near(y + random.uniform(0, 0.2), 0.2, 0.1)
    return 1.0 - np.maximum(np.broadcast_to(slats, (PIXELS, PIXELS)), cords)


def _bars(_: np.random.Generator) -> np.ndarray:
    x, y = _grid()
    return 1.0 - (_near(x, 0.36, 0.1) | _near(y + 0.4, 2.4, 0.12))


def _leaves(random: np.random.Generator) -> np.ndarray:
    picture = np.ones((PIXELS, PIXELS), np.uint8)
    for tuft in random.uniform(0, PIXELS, (190, 2)):
        for _ in range(int(random.integers(4, 15))):
            _leaf(picture, random, tuft + random.normal(0, 28, 2), random.uniform(26, 58))
    return picture


def _leaf(picture: np.ndarray, random: np.random.Generator, at: np.ndarray, long: float) -> None:
    """A pointed leaf that is seen more or less from its edge."""
    import cv2

    t = np.linspace(0, 1, 9)
    half = random.uniform(0.12, 0.3) * long * np.sin(np.pi * t)
    outline = np.concatenate([np.stack([long * t, half], 1), np.stack([long * t, -half], 1)[::-1]])
    angle = random.uniform(0, 2 * np.pi)
    turned = outline @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    cv2.fillPoly(picture, [np.round(turned + at).astype(np.int32)], 0)


def _branches(random: np.random.Generator) -> np.ndarray:
    import cv2

    picture = np.ones((PIXELS, PIXELS), np.uint8)

    def grow(at: np.ndarray, angle: float, thick: float, left: int) -> None:
        for _ in range(int(random.integers(4, 8))):
            angle += random.normal(0, 0.16)
            ahead = at + random.uniform(0.5, 1.0) * (26 + 4.5 * thick) * np.array([np.cos(angle), np.sin(angle)])
            ends = [tuple(int(v) for v in np.round(point)) for point in (at, ahead)]
            cv2.line(picture, ends[0], ends[1], 0, max(1, round(thick)))
            at, thick = ahead, 0.9 * thick
            if left and random.random() < 0.75:
                grow(at, angle + random.choice([-1, 1]) * random.uniform(0.4, 1.0), 0.6 * thick, left - 1)
            elif not left and random.random() < 0.7:
                _leaf(picture, random, at, random.uniform(10, 22))

    for _ in range(7):
        edge = random.uniform(0, 2 * np.pi)
        foot = PIXELS / 2 + random.uniform(0.4, 0.55) * PIXELS * np.array([np.cos(edge), np.sin(edge)])
        grow(foot, edge + np.pi + random.normal(0, 0.6), 13.0, 3)
    return picture


_KINDS: dict[str, Callable[[np.random.Generator], np.ndarray]] = {
    "window": _window, "blinds": _blinds, "leaves": _leaves, "branches": _branches, "bars": _bars,
}  # fmt: skip
