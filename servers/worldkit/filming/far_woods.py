"""The edge of a wood far away: crowns of many leaf clumps side by side, of which none is as high as the next."""

import numpy as np

CLUMPS = 130
"""Of a crown; each is four corners."""


def crowns(
    places: np.ndarray, height: float, floor: float, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and triangles (F, 3) of crowns of trees at places (N, 2), m, up to `height` m high over `floor`.

    They have leaves down to the ground, as the edge of a wood has, and no trunks; seen from afar, two triangles a clump.
    """
    count = len(places)
    tall = height * random.uniform(0.55, 1.0, count)
    wide = tall * random.uniform(0.3, 0.46, count)
    # Clumps all over an egg that is broadest below its middle, and a skirt of bushes at its foot.
    up = random.uniform(0.0, 1.0, (count, CLUMPS)) ** 0.8
    turn = random.uniform(0, 2 * np.pi, (count, CLUMPS))
    swell = np.sqrt(np.clip(1.0 - ((up - 0.42) / np.where(up > 0.42, 0.6, 0.62)) ** 2, 0.02, 1.0))
    lobes = 1.0 + 0.22 * np.sin(3 * turn + 9 * up + random.uniform(0, 6, (count, 1)))
    out = np.stack([np.cos(turn), np.sin(turn)], -1)
    middle = np.empty((count, CLUMPS, 3))
    middle[..., :2] = (
        places[:, None] + out * (swell * lobes * wide[:, None] * random.uniform(0.8, 1.05, up.shape))[..., None]
    )
    middle[..., 2] = floor + up * tall[:, None]
    ahead = np.concatenate([0.8 * out, (1.4 * up - 0.35)[..., None]], axis=-1) + random.normal(0, 0.35, middle.shape)
    ahead /= np.linalg.norm(ahead, axis=-1, keepdims=True)
    side = np.cross(ahead, random.normal(size=middle.shape))
    side /= np.maximum(np.linalg.norm(side, axis=-1, keepdims=True), 1e-9)
    size = (0.095 * tall[:, None] * random.uniform(0.6, 1.3, up.shape))[..., None]
    one, other = side * size, np.cross(ahead, side) * size * random.uniform(0.5, 1.0, (*up.shape, 1))
    skew = random.uniform(-0.45, 0.45, (*up.shape, 1))
    corners = np.stack([middle - one + skew * other, middle - other, middle + one, middle + other - skew * one], axis=2)
    k = 4 * np.arange(count * CLUMPS)[:, None, None]
    faces = (k + np.array([(0, 1, 2), (0, 2, 3)])).reshape(-1, 3)
    return corners.reshape(-1, 3), faces
