"""Trees of a film: a trunk, branches by one rule, and leaves or needles on cards; drawn only, the same for the same seed."""

from collections.abc import Iterable
from functools import cache
from math import sqrt
from typing import NamedTuple

import numpy as np

from ..turning import cross

Mesh = tuple[np.ndarray, np.ndarray]
"""Vertices (V, 3), m, and faces (F, 3)."""

KINDS = ("conifer", "broadleaf")
SIDES = 5
"""Of a trunk or branch."""
UP = np.array([0.0, 0.0, 1.0])
TURN = np.pi * (3 - 5**0.5)
"""From one branch to the next around the trunk: the golden angle, as plants have it."""


class Tree(NamedTuple):
    """One tree, its foot at the origin: the wood and the leaves, each (V, 3) m and (F, 3)."""

    wood: np.ndarray
    wood_faces: np.ndarray
    leaves: np.ndarray
    leaf_faces: np.ndarray


def tree(kind: str, height: float, seed: int) -> Tree:
    """A tree of one of `KINDS`, as high as `height` (m): at most 6000 triangles, most of them leaves."""
    random = np.random.default_rng(seed)
    return (_conifer if kind == "conifer" else _broadleaf)(height, random)


def _conifer(height: float, random: np.random.Generator) -> Tree:
    """A spruce: whorls of boughs that hang at the foot and rise at the top, with twigs of needles on both sides."""
    wood = [limb(np.array([[0, 0, 0], [0, 0, 0.55 * height], [0, 0, height]]), [0.018 * height, 0.011 * height, 0.001])]
    cards, levels = [], 30
    for level in range(levels):
        share = (level + 0.5 * random.random()) / levels
        z = height * (0.07 + 0.92 * share)
        reach = 0.24 * height * (1 - share) ** 0.8 + 0.015 * height
        for bough in range(5 if share < 0.75 else 4):
            yaw = TURN * level + 2 * np.pi * bough / 5 + random.uniform(-0.25, 0.25)
            long = reach * random.uniform(0.72, 1.08)
            out = np.array([np.cos(yaw), np.sin(yaw), 0.0])
            sag = long * (0.42 - 0.95 * share)
            base = np.array([0, 0, z])
            way = [base, base + 0.5 * long * out - [0, 0, 0.65 * sag], base + long * out - [0, 0, 0.75 * sag]]
            if share < 0.8:
                wood.append(limb(np.array(way), [0.004 * height * (1 - share) + 0.002, 0.003, 0.001], sides=3))
            cards += _twigs(np.array(way), yaw, long, random)
    return _whole(wood, cards)


def _twigs(way: np.ndarray, yaw: float, long: float, random: np.random.Generator) -> list[np.ndarray]:
    """Pointed sprays of needles along a bough, to its left and right, and one at its end: four corners each."""
    found = []
    for at in (0.18, 0.34, 0.5, 0.66, 0.83, 1.0):
        foot = way[0] * (1 - at) ** 2 + 2 * way[1] * at * (1 - at) + way[2] * at**2
        for side in (-1, 1) if at < 1 else (0,):
            turn = yaw + side * random.uniform(0.7, 1.05)
            ahead = np.array([np.cos(turn), np.sin(turn), random.uniform(-0.35, 0.0)])
            size = long * (0.46 - 0.16 * at) * random.uniform(0.85, 1.2)
            roll = random.uniform(0.3, 1.0) * random.choice((-1, 1))  # a spray is seen from the side, too
            level = cross(ahead, UP)
            across = (np.cos(roll) * level + np.sin(roll) * UP) * 0.24 * size
            middle = foot + 0.45 * size * ahead
            found.append(np.array([foot, middle - across, foot + size * ahead, middle + across]))
    return found


def _broadleaf(height: float, random: np.random.Generator) -> Tree:
    """An oak or lime: a trunk that forks four times, each fork shorter and more level, and leaves around the last twigs."""
    wood: list[tuple[np.ndarray, np.ndarray]] = []
    tips: list[np.ndarray] = []

    def grow(foot: np.ndarray, ahead: np.ndarray, long: float, thick: float, level: int) -> None:
        bend = random.normal(0, 0.12, 3)
        middle = foot + 0.5 * long * (ahead + bend)
        end = foot + long * (ahead + 0.5 * bend)
        wood.append(
            limb(np.array([foot, middle, end]), [thick, 0.8 * thick, 0.6 * thick], sides=SIDES if level < 2 else 3)
        )
        if level >= 2:
            tips.append(end)
        if level == 3:
            return
        start = random.uniform(0, 2 * np.pi)
        for number in range(5 if level == 0 else 4):
            yaw, lean = start + TURN * number, random.uniform(0.45, 0.95) + (0.1 if level else 0.0)
            across = cross(ahead, np.array([np.cos(yaw), np.sin(yaw), 0.2]))
            across /= _norm(across)
            new = np.cos(lean) * ahead + np.sin(lean) * across + [0, 0, 0.12]
            grow(
                foot + (0.7 + 0.3 * random.random()) * (end - foot),
                new / _norm(new),
                0.66 * long,
                0.5 * thick,
                level + 1,
            )

    grow(np.zeros(3), np.array([0, 0, 1.0]), 0.38 * height, 0.026 * height, 0)
    ends = np.array(tips)
    cards = []
    for end in ends:
        for _ in range(23):
            foot = end + random.normal(0, 0.05 * height, 3)
            ahead, side = random.normal(size=3), random.normal(size=3)
            ahead[2] -= 0.4  # leaves hang a little
            ahead /= _norm(ahead)
            side = cross(ahead, side)
            size = 0.034 * height * random.uniform(0.7, 1.3)
            side *= 0.3 * size / _norm(side)
            cards.append(
                np.array(
                    [foot, foot + 0.5 * size * ahead - side, foot + size * ahead, foot + 0.5 * size * ahead + side]
                )
            )
    made = _whole(wood, cards)
    top = max(made.wood[:, 2].max(), made.leaves[:, 2].max())
    return made._replace(wood=made.wood * (height / top), leaves=made.leaves * (height / top))


def limb(way: np.ndarray, radii: list[float], sides: int = SIDES) -> tuple[np.ndarray, np.ndarray]:
    """A tube through some points (N, 3), with a radius at each, m; open at its ends."""
    ahead = way[-1] - way[0]
    one = cross(ahead, np.array([0.3, 0.9, 0.1] if abs(ahead[0]) > abs(ahead[1]) else [0.9, 0.3, 0.1]))
    one /= _norm(one)
    other = cross(ahead / _norm(ahead), one)
    turn = 2 * np.pi * np.arange(sides) / sides
    ring = np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * other
    points = np.concatenate([point + radius * ring for point, radius in zip(way, radii, strict=True)])
    return points, _tube(len(way), sides)


@cache
def _tube(rings: int, sides: int) -> np.ndarray:
    """The faces between rings of points, for all tubes of as many."""
    faces = []
    for k in range(rings - 1):
        for i in range(sides):
            a, b = k * sides + i, k * sides + (i + 1) % sides
            faces += [(a, b, b + sides), (a, b + sides, a + sides)]
    found = np.array(faces)
    found.flags.writeable = False
    return found


def _norm(vector: np.ndarray) -> float:
    """Its length, as numpy's own gives it, without its questions: a tree asks it thousands of times."""
    return sqrt(vector.dot(vector))


def joined(meshes: Iterable[Mesh]) -> Mesh:
    """Several meshes as one."""
    points, faces = zip(*meshes, strict=True)
    starts = np.cumsum([0, *map(len, points)])
    return np.concatenate(points), np.concatenate([part + start for part, start in zip(faces, starts, strict=False)])


def _whole(wood: list[Mesh], cards: list[np.ndarray]) -> Tree:
    leaves = np.concatenate(cards)
    k = 4 * np.arange(len(cards))[:, None]
    leaf_faces = np.concatenate([k + np.array(one) for one in ((0, 1, 2), (0, 2, 3))])
    return Tree(*joined(wood), leaves, leaf_faces)
