"""Pictures for surfaces, from numpy: seeded noise that repeats without a seam, wood, cloth, lettering, PNG bytes.

A picture is (H, W, 3) float RGB in 0..1 (as displayed, no gamma to undo); row 0 is the top, v = 1.
"""

import cv2
import numpy as np

Colour = tuple[float, float, float]


def colour(code: str) -> np.ndarray:
    """`#rrggbb` as RGB (3,) in 0..1."""
    return np.array([int(code[i : i + 2], 16) for i in (1, 3, 5)]) / 255


def noise(
    shape: tuple[int, int], seed: int, *, slope: float = 1.0, stretch: tuple[float, float] = (1, 1)
) -> np.ndarray:
    """Seamless noise (H, W), zero mean and unit deviation, with spectrum 1 / f^slope.

    `stretch` (across, along rows) makes features longer: (8, 1) gives horizontal streaks.
    """
    h, w = shape
    fy = np.fft.fftfreq(h)[:, None] * h * stretch[1]
    fx = np.fft.rfftfreq(w)[None, :] * w * stretch[0]
    f = np.hypot(fx, fy)
    f[0, 0] = 1
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft2(rng.standard_normal(shape)) / f**slope
    spectrum[0, 0] = 0
    field = np.fft.irfft2(spectrum, s=shape)
    return (field - field.mean()) / field.std()


def ramp(value: np.ndarray, stops: list[str]) -> np.ndarray:
    """Colours (..., 3) along a list of `#rrggbb` stops, evenly spaced over 0..1."""
    at = np.clip(value, 0, 1) * (len(stops) - 1)
    table = np.array([colour(s) for s in stops])
    low = np.minimum(at.astype(int), len(stops) - 2)
    t = (at - low)[..., None]
    return table[low] * (1 - t) + table[low + 1] * t


def wood(size: int, seed: int, stops: list[str], *, rings: int = 9, waviness: float = 1.1) -> np.ndarray:
    """Flat-sawn wood with the grain along u, seamless; `rings` growth lines across the tile."""
    shape = (size, size)
    y = np.arange(size)[:, None] / size
    bend = (
        noise(shape, seed, slope=2.0, stretch=(5, 1)) * 0.16 + noise(shape, seed + 1, slope=1.6, stretch=(14, 1)) * 0.03
    )
    phase = (y * rings + waviness * rings * 0.5 * bend) % 1.0
    growth = np.where(phase < 0.82, phase / 0.82, 1 - (phase - 0.82) / 0.18) ** 1.6
    fibre = noise(shape, seed + 2, slope=0.55, stretch=(40, 1))
    pores = np.clip(noise(shape, seed + 3, slope=0.35, stretch=(26, 1)) - 1.3, 0, 2) * (0.35 + 0.65 * growth)
    broad = noise(shape, seed + 4, slope=1.8, stretch=(3, 1))
    return ramp(0.36 + 0.34 * growth + 0.055 * fibre + 0.05 * broad + 0.10 * pores, stops)


def cloth(size: int, seed: int, stops: list[str], *, contrast: float = 0.12) -> np.ndarray:
    """Felted or brushed cloth, seamless."""
    shape = (size, size)
    field = noise(shape, seed, slope=0.5) * 0.8 + noise(shape, seed + 1, slope=1.5) * 0.6
    return ramp(0.5 + contrast * field, stops)


def weave(size: int, seed: int, threads: int, stops: list[str]) -> np.ndarray:
    """Plain-weave fabric, `threads` each way across the tile, seamless."""
    y, x = np.mgrid[0:size, 0:size] / size * threads
    over = (np.floor(x) + np.floor(y)) % 2
    fx, fy = np.abs(np.sin(np.pi * x)), np.abs(np.sin(np.pi * y))
    height = np.where(over == 0, fy * (0.6 + 0.4 * fx), fx * (0.6 + 0.4 * fy))
    slub = noise((size, size), seed, slope=0.8, stretch=(6, 1)) + noise(
        (size, size), seed + 1, slope=0.8, stretch=(1, 6)
    )
    return ramp(0.25 + 0.5 * height + 0.06 * slub, stops)


def lettering(
    picture: np.ndarray, text: str, centre: tuple[float, float], size: float, ink: str, weight: int = 700
) -> np.ndarray:
    """A copy with `text` set in the bundled sans face, centred at pixel (x, y), `size` pixels high, four times sampled."""
    height, width = picture.shape[:2]
    k = 4
    mask = np.zeros((height * k, width * k, 3), np.uint8)
    face = cv2.FontFace("sans")
    white = (255, 255, 255)
    corner, _ = cv2.putText(mask, text, (0, 0), white, face, int(size * k), weight)[:2]
    mask[:] = 0
    origin = (int(centre[0] * k - corner[0] / 2), int(centre[1] * k + size * k * 0.36))
    cv2.putText(mask, text, origin, white, face, int(size * k), weight)
    cover = cv2.resize(mask[..., 0], (width, height), interpolation=cv2.INTER_AREA)[..., None] / 255
    return picture * (1 - cover) + colour(ink) * cover


def blend(picture: np.ndarray, ink: str | np.ndarray, cover: np.ndarray) -> np.ndarray:
    """Paint `ink` where `cover` (H, W) is 1."""
    rgb = colour(ink) if isinstance(ink, str) else ink
    return picture * (1 - cover[..., None]) + rgb * cover[..., None]


def edge(signed: np.ndarray, softness: float) -> np.ndarray:
    """1 where `signed` is negative, 0 where positive, blended over `softness`."""
    return np.clip(0.5 - signed / softness, 0, 1)


def sphere_directions(height: int, width: int) -> np.ndarray:
    """Unit directions (H, W, 3) of an equirectangular picture's pixel centres; u = 0 is +X, u grows towards +Y."""
    latitude = (0.5 - (np.arange(height) + 0.5) / height) * np.pi
    longitude = (np.arange(width) + 0.5) / width * 2 * np.pi
    c = np.cos(latitude)[:, None]
    return np.stack(
        [c * np.cos(longitude), c * np.sin(longitude), np.broadcast_to(np.sin(latitude)[:, None], (height, width))],
        axis=-1,
    )


def png(picture: np.ndarray, levels: int = 256) -> bytes:
    """PNG bytes; fewer `levels` per channel make noisy pictures smaller."""
    step = 255 / (levels - 1)
    pixels = np.round(np.round(np.clip(picture, 0, 1) * (levels - 1)) * step).astype(np.uint8)
    ok, data = cv2.imencode(".png", np.ascontiguousarray(pixels[..., ::-1]), [cv2.IMWRITE_PNG_COMPRESSION, 9])
    if not ok:
        raise RuntimeError("OpenCV could not encode the picture as PNG")
    return data.tobytes()
