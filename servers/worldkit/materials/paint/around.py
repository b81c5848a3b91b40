"""Balls and fruit: painters over unit directions, so that every turn of the thing can be seen.

Each takes directions (..., 3) and returns sRGB (..., 3) and relief height (...) in 0..1. The pole is +z.
"""

import numpy as np

from .noise import cells, mix, random, smooth

Rgb = tuple[float, float, float]
IVORY = (0.955, 0.935, 0.875)

# Strokes of the digits in a cell 0.6 wide and 1 high about the origin: lines (x0, y0, x1, y1), and arcs (centre x, y, radii,
# from and to in degrees counter-clockwise from +x).
_LINES: dict[str, tuple[tuple[float, float, float, float], ...]] = {
    "1": ((-0.14, 0.26, 0.02, 0.42), (0.02, 0.42, 0.02, -0.42)),
    "2": ((0.21, 0.08, -0.24, -0.42), (-0.24, -0.42, 0.26, -0.42)),
    "4": ((0.10, 0.42, -0.26, -0.16), (-0.26, -0.16, 0.27, -0.16), (0.10, 0.42, 0.10, -0.42)),
    "5": ((0.20, 0.42, -0.18, 0.42), (-0.18, 0.42, -0.21, 0.06)),
    "6": ((-0.235, -0.16, 0.08, 0.42),),
    "7": ((-0.25, 0.42, 0.25, 0.42), (0.25, 0.42, -0.08, -0.42)),
    "9": ((0.235, 0.16, -0.08, -0.42),),
}
_ARCS: dict[str, tuple[tuple[float, float, float, float, float, float], ...]] = {
    "0": ((0.0, 0.0, 0.24, 0.42, 0.0, 360.0),),
    "2": ((0.0, 0.19, 0.24, 0.23, -28.0, 170.0),),
    "3": ((-0.01, 0.215, 0.21, 0.205, -90.0, 150.0), (-0.01, -0.205, 0.245, 0.215, -150.0, 90.0)),
    "5": ((-0.01, -0.15, 0.245, 0.265, -150.0, 135.0),),
    "6": ((0.0, -0.17, 0.24, 0.25, 0.0, 360.0),),
    "8": ((0.0, 0.22, 0.20, 0.20, 0.0, 360.0), (0.0, -0.20, 0.24, 0.22, 0.0, 360.0)),
    "9": ((0.0, 0.17, 0.24, 0.25, 0.0, 360.0),),
}


def _segments(digit: str) -> np.ndarray:
    """Straight pieces (N, 4) of a digit's strokes."""
    pieces = [np.array(line) for line in _LINES.get(digit, ())]
    for x, y, rx, ry, start, end in _ARCS.get(digit, ()):
        angle = np.radians(np.linspace(start, end, 22))
        points = np.stack([x + rx * np.cos(angle), y + ry * np.sin(angle)], -1)
        pieces.extend(np.concatenate([points[:-1], points[1:]], axis=1))
    return np.array(pieces)


def _glyphs(text: str, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Coverage 0..1 of `text` centred at the origin, one unit high, y up, at points (N,)."""
    pitch, nearest = 0.68, np.full(x.shape, 9.0)
    for place, digit in enumerate(text):
        centre = pitch * (place - 0.5 * (len(text) - 1))
        for x0, y0, x1, y1 in _segments(digit):
            dx, dy = x1 - x0, y1 - y0
            px, py = x - centre - x0, y - y0
            along = np.clip((px * dx + py * dy) / max(dx * dx + dy * dy, 1e-9), 0.0, 1.0)
            nearest = np.minimum(nearest, np.hypot(px - along * dx, py - along * dy))
    return 1.0 - smooth(0.055, 0.095, nearest)


def _flat(direction: np.ndarray) -> np.ndarray:
    return np.full(direction.shape[:-1], 0.9)


def pool(direction: np.ndarray, tone: Rgb, number: str, striped: bool) -> tuple[np.ndarray, np.ndarray]:
    """A pool ball: colour (or ivory with a coloured band) and its number in an ivory disc on two opposite sides."""
    x, y, z = np.moveaxis(direction, -1, 0)
    rgb = np.array(np.broadcast_to(np.asarray(tone, dtype=direction.dtype), direction.shape))
    if striped:
        rgb = mix(rgb, np.asarray(IVORY), smooth(0.50, 0.53, np.abs(z)))
    # The discs cover little of the ball: paint only there.
    near = np.flatnonzero(np.abs(x).ravel() > 0.93)
    side = np.sign(x.ravel()[near])
    across, up = side * y.ravel()[near], z.ravel()[near]
    disc = 1.0 - smooth(0.325, 0.345, np.hypot(across, up))
    height = 0.36 if len(number) == 1 else 0.31
    patch = mix(rgb.reshape(-1, 3)[near], np.asarray(IVORY), disc)
    patch = mix(patch, np.array((0.06, 0.06, 0.07)), disc * _glyphs(number, across / height, up / height))
    rgb.reshape(-1, 3)[near] = patch
    return rgb, _flat(direction)


def cue(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The cue ball of broadcast matches: ivory with six red spots that show its spin."""
    rgb = np.broadcast_to(np.asarray(IVORY), direction.shape)
    spots = 1.0 - smooth(0.155, 0.18, np.arccos(np.clip(np.abs(direction).max(axis=-1), 0, 1)))
    return mix(rgb, (0.78, 0.07, 0.08), spots), _flat(direction)


def _pebbles(direction: np.ndarray, name: str, count: int = 34) -> np.ndarray:
    """Small bumps everywhere, 0 in the grooves and 1 on the crowns, projected from the nearest axis."""
    near, far, _ = cells(768, count, name)
    bump = smooth(0.0, 0.35, far - near)
    absolute = np.abs(direction)
    major = absolute.argmax(axis=-1)
    first = np.take_along_axis(direction, ((major + 1) % 3)[..., None], -1)[..., 0]
    second = np.take_along_axis(direction, ((major + 2) % 3)[..., None], -1)[..., 0]
    largest = absolute.max(axis=-1)
    u = ((first / largest * 0.5 + 0.5 + 0.37 * major) * 768).astype(int) % 768
    v = ((second / largest * 0.5 + 0.5 + 0.21 * major) * 768).astype(int) % 768
    return bump[v, u]


def basketball(direction: np.ndarray, tone: Rgb, seam: Rgb) -> tuple[np.ndarray, np.ndarray]:
    """Eight panels: two great circles and two bowed seams, over pebbled rubber."""
    x, y, z = np.moveaxis(direction, -1, 0)
    angle = np.minimum(np.abs(np.arcsin(np.clip(x, -1, 1))), np.abs(np.arcsin(np.clip(z, -1, 1))))
    for side in (1.0, -1.0):
        bowed = np.abs(np.arccos(np.clip(side * y * 0.985, -1, 1)) - 0.93 + 0.30 * (z * z - x * x * 0.55))
        angle = np.minimum(angle, bowed)
    line = 1.0 - smooth(0.020, 0.034, angle)
    pebble = _pebbles(direction, "basketball")
    value = 0.86 + 0.14 * pebble
    rgb = mix(np.asarray(tone) * value[..., None], seam, line)
    return rgb, np.clip(0.55 + 0.35 * pebble, 0, 1) * (1.0 - 0.9 * line)


def football(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Truncated icosahedron: twelve black pentagons, twenty white hexagons."""
    golden = (1.0 + 5.0**0.5) / 2.0
    corners = np.array([(0, s, t * golden) for s in (1, -1) for t in (1, -1)], dtype=float)
    corners = np.concatenate([np.roll(corners, k, axis=1) for k in range(3)]) / np.hypot(1.0, golden)
    faces = np.array([(s, t, u) for s in (1, -1) for t in (1, -1) for u in (1, -1)], dtype=float)
    more = np.array([(0, s / golden, t * golden) for s in (1, -1) for t in (1, -1)], dtype=float)
    faces = np.concatenate([faces] + [np.roll(more, k, axis=1) for k in range(3)]) / 3.0**0.5
    # Face planes of the solid with unit edge: pentagons lie at 2.327, hexagons at 2.267 from the centre.
    pentagon = direction @ (corners.T / 2.3274).astype(direction.dtype)
    hexagon = direction @ (faces.T / 2.2673).astype(direction.dtype)
    both = np.concatenate([pentagon, hexagon], axis=-1)
    top = np.partition(both, -2, axis=-1)[..., -2:]
    seam = 1.0 - smooth(0.002, 0.009, top[..., 1] - top[..., 0])
    black = pentagon.max(axis=-1) > hexagon.max(axis=-1)
    rgb = np.where(black[..., None], (0.05, 0.05, 0.06), (0.94, 0.94, 0.93))
    return mix(rgb, (0.10, 0.10, 0.11), 0.8 * seam), 0.95 - 0.8 * seam


def tennis(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Yellow-green nap with the single wandering seam."""
    x, y, z = np.moveaxis(direction, -1, 0)
    longitude = np.arctan2(y, x)
    seam = (
        np.abs(np.arcsin(np.clip(z, -1, 1)) - 0.75 * np.sin(2.0 * longitude))
        * np.cos(0.75 * np.sin(2 * longitude)) ** 0.5
    )
    line = 1.0 - smooth(0.05, 0.07, seam / np.sqrt(1.0 + (1.2 * np.cos(2.0 * longitude)) ** 2) * 1.3)
    nap = random("tennis").normal(0.0, 0.05, direction.shape[:-1])
    rgb = np.asarray((0.80, 0.90, 0.22)) * (1.0 + nap)[..., None]
    return mix(rgb, (0.94, 0.95, 0.90), line), np.clip(0.6 + nap - 0.4 * line, 0, 1)


def beach(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Six coloured gores and white caps."""
    colours = np.array(
        [
            (0.86, 0.12, 0.13),
            (0.96, 0.96, 0.94),
            (0.10, 0.35, 0.75),
            (0.97, 0.78, 0.10),
            (0.95, 0.95, 0.93),
            (0.10, 0.60, 0.32),
        ]
    )
    gore = np.floor((np.arctan2(direction[..., 1], direction[..., 0]) / (2 * np.pi) + 0.5) * 6).astype(int) % 6
    cap = smooth(0.962, 0.968, np.abs(direction[..., 2]))
    return mix(colours[gore], (0.96, 0.96, 0.95), cap), _flat(direction)


def banded(direction: np.ndarray, tone: Rgb, band: Rgb) -> tuple[np.ndarray, np.ndarray]:
    """A coloured ball with one broad band and dots at its poles."""
    z = np.abs(direction[..., 2])
    stripe = 1.0 - smooth(0.17, 0.185, z)
    dot = smooth(0.962, 0.968, z)
    return mix(np.broadcast_to(np.asarray(tone), direction.shape), band, np.maximum(stripe, dot)), _flat(direction)


def _meridian_noise(direction: np.ndarray, name: str, count: int, along: float) -> np.ndarray:
    """Streaks along the meridians, deviation about 1."""
    generator = random(name)
    longitude = np.arctan2(direction[..., 1], direction[..., 0])
    total = np.zeros(direction.shape[:-1])
    for _ in range(14):
        frequency = generator.integers(3, count)
        phase, bend = generator.random(2) * 2 * np.pi
        total += np.sin(frequency * longitude + phase + along * np.sin(2.0 * direction[..., 2] + bend))
    return total / np.sqrt(7.0)


def apple(direction: np.ndarray, skin: Rgb, blush: Rgb, base: Rgb) -> tuple[np.ndarray, np.ndarray]:
    """Streaked skin, paler toward the stalk, with fine dots."""
    z = direction[..., 2]
    streak = _meridian_noise(direction, "apple", 46, 1.2)
    broad = _meridian_noise(direction, "apple broad", 6, 0.8)
    rgb = mix(skin, blush, np.clip(0.35 + 0.22 * streak + 0.22 * broad, 0, 1))
    rgb = mix(rgb, base, np.clip(smooth(0.72, 0.99, z + 0.05 * streak) * 0.85, 0, 1))
    dots = _pebbles(direction, "apple dots", 20) < 0.012
    return mix(rgb, (0.92, 0.80, 0.55), 0.6 * dots), _flat(direction)


def citrus(direction: np.ndarray, tone: Rgb) -> tuple[np.ndarray, np.ndarray]:
    """Dimpled peel."""
    pebble = _pebbles(direction, "citrus", 46)
    rgb = np.asarray(tone) * (0.90 + 0.10 * pebble)[..., None]
    stalk = smooth(0.988, 0.993, direction[..., 2])
    return mix(rgb, (0.30, 0.36, 0.12), stalk), np.clip(pebble, 0, 1)
