"""Blades of grass as they grow: in clumps with thin places between them, none as tall, as broad or as bent as its neighbour."""

from collections.abc import Sequence

import numpy as np

from .ground import Height

NEAR_M = 2.2
"""Around the densest place it is about equally dense as far as this, m; from there on it thins, and blades stand for several."""
ASPECT = 0.045
"""No blade is half so wide as this share of its height."""
WAVES_M = (0.22, 0.35, 0.6, 1.0, 1.7, 3.1)
"""Clumps and thin places are so far apart."""


def blades(
    area: tuple[float, float, float, float],
    height: float,
    count: int,
    ground: Height,
    clear_of: Sequence[tuple[float, float, float]],
    seed: int,
    densest: tuple[float, float] | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (5 B, 3) and triangles (3 B, 3) of B blades of grass that stand in an area (x0, y0, x1, y1), m, on `ground`.

    Args:
        area: where they stand.
        height: of the tallest, m.
        count: of the blades, of which none stand where there is no ground.
        ground: what they stand on.
        clear_of: discs (x, y, radius), m, where nothing grows.
        seed: another is another grass.
        densest: a place (x, y), m, around which most of them stand; without one they are spread evenly.
    """
    random = np.random.default_rng(seed)
    foot, apart = _feet(area, count, densest, random)
    for x, y, radius in clear_of:
        far = np.hypot(foot[:, 0] - x, foot[:, 1] - y) > radius
        foot, apart = foot[far], apart[far]
    level = np.asarray(ground(foot[:, 0], foot[:, 1]), dtype=float)
    there = np.isfinite(level)
    foot, apart, level = foot[there], apart[there], level[there]
    n = len(foot)
    lush = _uneven(foot, random)
    tall = height * np.clip(random.uniform(0.3, 0.9, n) + 0.22 * lush, 0.22, 1.0)
    half = np.minimum(ASPECT * tall, np.maximum(0.0011 + 0.0055 * tall, 0.03 * apart)) * random.uniform(0.7, 1.25, n)
    yaw = random.uniform(0, 2 * np.pi, n)
    across = np.stack([np.cos(yaw), np.sin(yaw), np.zeros(n)], -1) * half[:, None]
    # Neighbours lean the same way, some of them far over.
    turn = np.pi * _uneven(foot, random) + random.normal(0, 0.9, n)
    bent = np.clip(random.gamma(2.0, 0.19, n), 0.03, 1.1)
    toward = np.stack([np.cos(turn), np.sin(turn), np.zeros(n)], -1) * (bent * tall)[:, None]
    upright = np.sqrt(np.maximum(1.0 - 0.6 * bent**2, 0.2)) * tall
    base = np.concatenate([foot, level[:, None] - 0.002], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    middle = base + 0.32 * toward + up * (0.62 * upright)[:, None]
    tip = base + toward + up * upright[:, None]
    corners = np.stack([base - across, base + across, middle + 0.8 * across, middle - 0.8 * across, tip], axis=1)
    triangles = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
    faces = (np.arange(n)[:, None, None] * 5 + triangles[None]).reshape(-1, 3)
    return corners.reshape(-1, 3), faces


def scattered(
    area: tuple[float, float, float, float],
    count: int,
    densest: tuple[float, float] | None,
    random: np.random.Generator,
) -> np.ndarray:
    """(count, 2) places, m, where grass would stand: for what grows among it."""
    return _feet(area, count, densest, random)[0]


def _feet(
    area: tuple[float, float, float, float],
    count: int,
    densest: tuple[float, float] | None,
    random: np.random.Generator,
) -> tuple[np.ndarray, np.ndarray]:
    """Where blades stand (count, 2), and about how far they are apart there (count,), m."""
    low, high = np.array(area[:2], dtype=float), np.array(area[2:], dtype=float)
    if densest is None:
        foot = random.uniform(low, high, (2 * count, 2))
        apart = np.full(2 * count, np.sqrt(np.prod(high - low) / count))
    else:
        middle = np.array(densest, dtype=float)
        reach = max(float(np.abs(np.concatenate([low - middle, high - middle])).max()), 1e-3)
        most = np.log1p((reach / NEAR_M) ** 2)
        away = NEAR_M * np.sqrt(np.expm1(most * random.random(2 * count)))
        turn = random.uniform(0, 2 * np.pi, 2 * count)
        foot = middle + away[:, None] * np.stack([np.cos(turn), np.sin(turn)], -1)
        inside = ((foot >= low) & (foot <= high)).all(axis=1)
        foot[~inside] = random.uniform(low, high, (int((~inside).sum()), 2))
        apart = np.sqrt(np.pi * most * (NEAR_M**2 + np.square(foot - middle).sum(axis=1)) / count)
    # Of twice as many places half are taken, by chance, and rather in clumps than between them.
    lot = random.exponential(size=2 * count) / np.exp(2.2 * _uneven(foot, random))
    taken = np.sort(np.argpartition(lot, count - 1)[:count])
    return foot[taken], apart[taken]


def _uneven(places: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """A number from about -1 to 1 for each of some places (N, 2), alike for neighbours."""
    total = np.zeros(len(places))
    for long in WAVES_M:
        for _ in range(2):
            turn, shift = random.uniform(0, 2 * np.pi, 2)
            wave = 2 * np.pi / (long * random.uniform(0.8, 1.25))
            total += np.sin(wave * (places @ np.array([np.cos(turn), np.sin(turn)])) + shift)
    return total / (0.5 * len(WAVES_M) ** 0.5 * 4)
