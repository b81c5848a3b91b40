"""Paint by position: a paint is a function of points (N, 3), m, and normals (N, 3) that gives sRGB colours (N, 3), 0 to 1.

    def fur(points, normals):
        rgb = brushes.gradient(points[:, 2], {0.0: "#8a6a4a", 0.2: "#b08d62"})
        rgb = brushes.over(rgb, "#f4ead8", brushes.within(belly, soft=0.01)(points))
        return rgb, 0.9  # and a roughness, one number or one a point

Masks are (N,) from 0 to 1. Coordinates are those in which the shape was made.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from .deformed import noise
from .signed import AXES, Array, Shape

Colour = str | Sequence[float] | Array
Paint = Callable[[Array, Array], "Array | tuple[Array, Array | float]"]


def colour(value: Colour) -> Array:
    """sRGB (3,) or (N, 3), 0 to 1, of `#rrggbb` or of numbers."""
    if isinstance(value, str):
        if len(value) != 7 or value[0] != "#":
            raise ValueError(f"a colour is '#rrggbb' or three numbers from 0 to 1, not {value!r}")
        return np.array([int(value[k : k + 2], 16) / 255 for k in (1, 3, 5)])
    return np.asarray(value, dtype=float)


def plain(points: Array, value: Colour) -> Array:
    """One colour everywhere: (N, 3)."""
    return np.broadcast_to(colour(value), (len(points), 3)).copy()


def over(rgb: Array, value: Colour, mask: Array) -> Array:
    """Colours with another laid over them where the mask is 1."""
    m = np.clip(np.asarray(mask, dtype=float), 0.0, 1.0)[:, None]
    return rgb * (1 - m) + colour(value) * m


def gradient(along: Array, stops: Mapping[float, Colour]) -> Array:
    """Colours (N, 3) between stops by a coordinate (N,): {0.0: "#000000", 0.3: "#ffffff"}."""
    at = sorted(stops)
    tones = np.array([colour(stops[s]) for s in at])
    return np.stack([np.interp(along, at, tones[:, k]) for k in range(3)], axis=1)


def step(value: Array, edge: float, soft: float = 0.0) -> Array:
    """0 below an edge, 1 above it, smooth over `soft`."""
    if soft <= 0:
        return (value > edge).astype(float)
    t = np.clip((value - edge) / soft + 0.5, 0.0, 1.0)
    return t * t * (3 - 2 * t)


def within(shape: Shape, soft: float = 0.001) -> Callable[[Array], Array]:
    """A mask: 1 where points lie in another shape (a patch, an eye, a sock), its edge smooth over `soft`, m."""
    return lambda points: 1.0 - step(shape(points), 0.0, soft)


def stripes(along: Array, period: float, share: float = 0.5, soft: float = 0.1) -> Array:
    """A mask of stripes across a coordinate (N,), m: 1 on `share` of each period; `soft` is a share of it, too."""
    t = np.abs(np.mod(np.asarray(along) / period, 1.0) - 0.5) * 2  # 0 in the middle of a stripe
    return 1.0 - step(t, share, max(2 * soft, 1e-6))


def spots(points: Array, spacing: float, diameter: float, seed: int = 0, soft: float = 0.15) -> Array:
    """A mask of round spots, about `spacing` m apart, up to `diameter` across, in no order."""
    if not 0 < diameter <= 1.2 * spacing:
        raise ValueError(f"spots: {diameter} m across do not fit {spacing} m apart")
    q = points / spacing
    cell = np.floor(q - 0.5)
    found = np.full(len(points), np.inf)
    for n in range(8):
        there = cell + np.array([n & 1, n >> 1 & 1, n >> 2 & 1])
        shift = np.stack([_chance(there, seed + k) for k in range(4)], axis=1)
        d = np.linalg.norm(q - there - 0.15 - 0.7 * shift[:, :3], axis=1) / (0.6 + 0.4 * shift[:, 3])
        np.minimum(found, d, out=found)
    return 1.0 - step(found * spacing, diameter / 2, soft * diameter)


def net(points: Array, size: float, width: float, seed: int = 0) -> Array:
    """A mask of the seams, `width` m wide, between cells about `size` m across: a giraffe, a tortoise, cracked mud."""
    if not 0 < width < size:
        raise ValueError(f"net: seams of {width} m leave nothing of cells of {size} m")
    q = points / size
    cell = np.floor(q)
    near, next_ = np.full(len(points), np.inf), np.full(len(points), np.inf)
    for n in range(27):
        there = cell + np.array([n % 3 - 1, n // 3 % 3 - 1, n // 9 - 1])
        middle = there + 0.15 + 0.7 * np.stack([_chance(there, seed + k) for k in range(3)], axis=1)
        d = np.linalg.norm(q - middle, axis=1)
        next_ = np.minimum(next_, np.maximum(near, d))
        near = np.minimum(near, d)
    return 1.0 - step((next_ - near) * size / 2, width / 2, width / 4)


def mottled(points: Array, grain: float, seed: int = 0) -> Array:
    """Smooth noise (N,), 0 to 1, with patches about `grain` m across: fur, skin, rust, dirt."""
    return 0.5 + 0.5 * noise(points, grain, seed)


def label(
    points: Array,
    text: str,
    *,
    centre: Sequence[float],
    width: float,
    facing: str = "-y",
    normals: Array | None = None,
) -> Array:
    """A mask of words, `width` m wide, with their middle at `centre`, seen upright by who looks at the side `facing`.

    `facing` is +x, -x, +y, -y, +z or -z; with `normals`, only that side is written on.
    """
    import cv2

    if len(facing) != 2 or facing[0] not in "+-" or facing[1] not in AXES:
        raise ValueError(f"label: facing is one of +x, -x, +y, -y, +z, -z, not {facing!r}")
    font, size, thick = cv2.FONT_HERSHEY_DUPLEX, 4.0, 8
    (wide, tall), below = cv2.getTextSize(text, font, size, thick)
    page = np.zeros((tall + below + 2 * thick, wide + 2 * thick), np.uint8)
    cv2.putText(page, text, (thick, tall + thick), font, size, 255, thick, cv2.LINE_AA)
    axis, sign = AXES[facing[1]], 1.0 if facing[0] == "+" else -1.0
    right = {0: (0, sign, 0), 1: (-sign, 0, 0), 2: (1, 0, 0)}[axis]
    up = (0, sign, 0) if axis == 2 else (0, 0, 1)
    away = np.asarray(points) - np.asarray(centre, dtype=float)
    u = away @ np.array(right) / width * page.shape[1] + page.shape[1] / 2
    v = page.shape[0] / 2 - away @ np.array(up) / width * page.shape[1]
    spare = -len(u) % 256  # a picture that is looked up may not be taller than 32767
    x, y = (np.pad(row, (0, spare), constant_values=-9.0).astype(np.float32).reshape(-1, 256) for row in (u, v))
    mask = cv2.remap(page, x, y, cv2.INTER_LINEAR).ravel()[: len(u)] / 255.0
    return mask if normals is None else mask * (sign * normals[:, axis] > 0.2)


def dial(
    points: Array,
    count: int,
    inner: float,
    outer: float,
    width: float,
    centre: Sequence[float] = (0, 0, 0),
    axis: str = "x",
) -> Array:
    """A mask of `count` ticks round a centre, from one diameter to another, `width` m wide: a clock, a gauge; across x, y or z."""
    away = np.delete(np.asarray(points) - np.asarray(centre, dtype=float), AXES[axis], axis=1)
    far = np.hypot(*away.T)
    turn = np.arctan2(away[:, 0], away[:, 1]) * count / (2 * np.pi)
    across = np.abs(turn - np.round(turn)) * 2 * np.pi / count * far
    return np.asarray((across < width / 2) & (far > inner / 2) & (far < outer / 2), dtype=float)


def _chance(cell: Array, seed: int) -> Array:
    """A number (N,) from 0 to 1 for each cell (N, 3), by an integer hash."""
    c = cell.astype(np.int64).astype(np.uint32)
    with np.errstate(over="ignore"):
        h = c[:, 0] * np.uint32(0x8DA6B343) ^ c[:, 1] * np.uint32(0xD8163841) ^ c[:, 2] * np.uint32(0xCB1AB31F)
        h = (h + np.uint32(seed * 7919 & 0xFFFFFFFF)) * np.uint32(0x9E3779B1)
        h = (h ^ h >> np.uint32(15)) * np.uint32(0x85EBCA77)
    return (h ^ h >> np.uint32(13)).astype(float) / 4294967295.0
