"""A still life: a painted wall close behind, a wooden top, low hard sun from the side through a window that is not seen."""

from typing import TYPE_CHECKING

import numpy as np

from ..drawn_only import Surface, rgb
from . import LAND_M, Place, furniture, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 3.0
COLOUR = "#5f7d78"
"""The wall's, unless the film names another."""
PIXELS = 256


def build(film: "Dressing", place: Place) -> None:
    """Draw a painted wall close behind and a wooden top, in low hard sun from the side through a window that is not seen."""
    large = max(place.radius, 0.5 * (place.top - place.floor))
    film.light(azimuth_deg=place.facing_deg - 48, elevation_deg=27, colour="#ffe3ba", strength=1.25)
    film.sky(zenith="#8d9aa6", horizon="#84827e", ground="#54483c", glow=0.0, strength=0.62)
    film.grade(exposure_stops=0.1, contrast=1.1, saturation=1.02, temperature=0.03, vignette=0.3, glow=0.05)
    film.ground("wood_walnut")
    spot = place.spot(_depth(film, place) + 0.16 * large, 180)
    paint = _mottled(place.colour or COLOUR, place.random, 2.5 * large)
    furniture.put(film, place, "wall", [pieces.block(30 * large, 0.05, 12 * large, (0, 0.025, 0), 0.002)], spot, paint)
    strip = [pieces.block(30 * large, 0.03 * large, 0.09 * large, (0, -0.015 * large, 0))]
    furniture.put(film, place, "back board", strip, spot, "wood_walnut")
    film.gobo("window", size=1.25 * large, seed=int(place.random.integers(1 << 16)))


def _depth(film: "Dressing", place: Place) -> float:
    """How far from its middle, away from the camera, movers and the things of the world among them reach, m."""
    away = np.array(place.spot(1.0, 180)[:2]) - place.middle
    reach = [float(((place.ways[:, :2] - place.middle) @ away + place.ways[:, 2]).max())] if len(place.ways) else [0.0]
    for name in film.recorded.bodies:
        half = film.recorded.box(name)[1]
        at = film.recorded.position(name, 0.0)[:2] - place.middle
        if half[:2].max() < LAND_M and np.linalg.norm(at) < 2 * max(place.radius, 0.2):
            turned = np.abs(film.recorded.orientation(name, 0.0)) @ half
            reach.append(float(at @ away + np.abs(away) @ turned[:2]))
    return max(reach)


def _mottled(colour: str, random: np.random.Generator, tile_m: float) -> Surface:
    """Paint that is a little uneven, as from a brush, without a seam where it repeats."""
    waves = np.hypot(np.fft.fftfreq(PIXELS)[:, None], np.fft.fftfreq(PIXELS)[None]) * PIXELS
    field = np.zeros((PIXELS, PIXELS))
    for share, steep in ((0.75, 1.9), (0.25, 0.9)):
        spectrum = np.fft.fft2(random.normal(size=(PIXELS, PIXELS))) / np.maximum(waves, 2.0) ** steep
        spectrum[0, 0] = 0.0
        part = np.real(np.fft.ifft2(spectrum))
        field += share * part / part.std()
    shade = 1.0 + 0.045 * np.clip(field, -2.5, 2.5)
    pixels = np.clip(255 * np.array(rgb(colour)) * shade[..., None], 0, 255).astype(np.uint8)
    return Surface(picture=pixels, tile_m=tile_m, roughness=0.88)
