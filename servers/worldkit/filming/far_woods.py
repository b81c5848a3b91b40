"""The edge of a wood far away: crowns of many leaf clumps side by side, of which none is as high as the next."""

import numpy as np

from ..forms.lattice import lattice

CLUMPS = 420
"""Of a crown; each is four corners, small enough that through a long lens it is foliage and not a sheet of paper."""
SKIRT = 0.25
"""So many of them are the bushes at its foot, within this share of its height."""
HEART = 0.8
"""What is within this share of a crown is closed: no sky shines through the middle of a tree in full leaf."""
RINGS, SIDES = 8, 12


def crowns(
    places: np.ndarray, height: float, floor: float, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and triangles (F, 3) of crowns of trees at places (N, 2), m, up to `height` m high over `floor`.

    They have leaves down to the ground, as the edge of a wood has, and no trunks; seen from afar, two triangles a clump
    around a closed heart.
    """
    count = len(places)
    tall = height * random.uniform(0.55, 1.0, count)
    wide = tall * random.uniform(0.3, 0.46, count)
    phase = random.uniform(0, 6, (count, 1))

    def skin(up: np.ndarray, turn: np.ndarray, share: np.ndarray | float) -> np.ndarray:
        """Points (count, K, 3) of eggs that are broadest below their middle, lobed, as wide at the foot as bushes are."""
        swell = np.sqrt(np.clip(1.0 - ((up - 0.42) / np.where(up > 0.42, 0.6, 0.62)) ** 2, 0.02, 1.0))
        lobes = 1.0 + 0.22 * np.sin(3 * turn + 9 * up + phase)
        away = np.maximum(swell, np.where(up < SKIRT, 0.85, 0.0)) * lobes * wide[:, None] * share
        flat = places[:, None] + np.stack([np.cos(turn), np.sin(turn)], -1) * away[..., None]
        return np.concatenate([flat, (floor + up * tall[:, None])[..., None]], axis=-1)

    up = random.uniform(0.0, 1.0, (count, CLUMPS)) ** 0.8
    up[:, : int(SKIRT * CLUMPS)] *= SKIRT
    turn = random.uniform(0, 2 * np.pi, (count, CLUMPS))
    middle = skin(up, turn, random.uniform(0.8, 1.05, up.shape))
    out = np.stack([np.cos(turn), np.sin(turn)], -1)
    ahead = np.concatenate([0.8 * out, (1.4 * up - 0.35)[..., None]], axis=-1) + random.normal(0, 0.35, middle.shape)
    ahead /= np.linalg.norm(ahead, axis=-1, keepdims=True)
    side = np.cross(ahead, random.normal(size=middle.shape))
    side /= np.maximum(np.linalg.norm(side, axis=-1, keepdims=True), 1e-9)
    size = (0.05 * tall[:, None] * random.uniform(0.6, 1.3, up.shape))[..., None]
    one, other = side * size, np.cross(ahead, side) * size * random.uniform(0.5, 1.0, (*up.shape, 1))
    skew = random.uniform(-0.45, 0.45, (*up.shape, 1))
    corners = np.stack([middle - one + skew * other, middle - other, middle + one, middle + other - skew * one], axis=2)
    levels, ways = np.meshgrid(np.linspace(0, 0.97, RINGS), np.linspace(0, 2 * np.pi, SIDES + 1), indexing="ij")
    hearts = skin(np.tile(levels.ravel(), (count, 1)), np.tile(ways.ravel(), (count, 1)), HEART)
    points = np.concatenate([corners.reshape(count, -1, 3), hearts], axis=1)
    clumps = 4 * np.arange(CLUMPS)[:, None, None] + np.array([(0, 1, 2), (0, 2, 3)])
    faces = np.concatenate([clumps.reshape(-1, 3), 4 * CLUMPS + lattice(RINGS, SIDES + 1)])
    every = points.shape[1] * np.arange(count)[:, None, None] + faces
    return points.reshape(-1, 3), every.reshape(-1, 3)
