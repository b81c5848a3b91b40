"""A still life: a painted wall close behind, a wooden top, low hard sun from the side through a window that is not seen, and
a vase with dried flowers on that side."""

from typing import TYPE_CHECKING

import numpy as np

from ...errors import ProgramError
from ..drawn_only import Surface, rgb
from . import LAND_M, Place, dried_flowers, furniture, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 3.0
COLOUR = "#d6bd9f"
"""The wall's, unless the film names another: pale plaster, on which sun and shadow are seen best."""
LEAST_M, ROOM_M = 0.08, 0.03
"""Beside what is smaller no vase stands, of which a picture would show the foot alone; so much room is left around it."""
PIXELS = 256


def build(film: "Dressing", place: Place) -> None:
    """Draw a painted wall close behind and a wooden top, in low hard sun from the side through a window that is not seen."""
    large = max(place.radius, 0.5 * (place.top - place.floor))
    film.light(azimuth_deg=place.facing_deg - 48, elevation_deg=27, colour="#ffe3ba", strength=1.25)
    film.sky(zenith="#8d9aa6", horizon="#84827e", ground="#54483c", glow=0.0, strength=0.62, indoors=True)
    film.grade(exposure_stops=0.1, contrast=1.1, saturation=1.02, temperature=0.03, vignette=0.3, glow=0.05)
    film.ground("wood_walnut")
    depth = _depth(film, place) + 0.16 * large
    spot, wide = place.spot(depth, 180), max(30 * large, 5 * depth)
    paint = _mottled(place.colour or COLOUR, place.random, 2.5 * large)
    furniture.put(film, place, "wall", [pieces.block(wide, 0.05, 0.4 * wide, (0, 0.025, 0), 0.002)], spot, paint)
    strip = [pieces.block(wide, 0.03 * large, 0.09 * large, (0, -0.015 * large, 0))]
    furniture.put(film, place, "back board", strip, spot, "wood_walnut")
    side = max(place.standing, place.radius) + dried_flowers.WIDE + ROOM_M
    if large >= LEAST_M and not place.bare:
        back = np.hypot(side, before := max(depth - dried_flowers.WIDE - ROOM_M, 0.0))
        dried_flowers.stand(film, place, place.spot(float(back), 90 + np.degrees(np.arctan2(before, side))))
    film.gobo("window", size=1.25 * large, seed=int(place.random.integers(1 << 16)))


def _depth(film: "Dressing", place: Place) -> float:
    """How far from its middle, away from the camera, movers and the things of the world reach, m.

    Raises:
        ProgramError: something stands so far behind that a wall close behind what happens would hide it.
    """
    recorded, away = film.recorded, np.array(place.spot(1.0, 180)[:2]) - place.middle
    times = np.linspace(0.0, recorded.duration, 60)
    low = min((float(recorded.position(n, times)[:, 2].min()) for n in recorded.movers or recorded.bodies), default=0.0)
    reach = [float(((place.ways[:, :2] - place.middle) @ away + place.ways[:, 2]).max())] if len(place.ways) else [0.0]
    for name in dict.fromkeys((*recorded.bodies, *recorded.still)):
        points = recorded.outline(name)
        if np.ptp(points[:, :2], axis=0).max() >= 2 * LAND_M:  # what is so wide and below all that moves is ground
            points = points[points[:, 2] > low]
        far = float(((points[:, :2] - place.middle) @ away).max(initial=0.0))
        if far > max(2 * LAND_M, reach[0]):
            raise ProgramError(
                f"{name!r} stands {far:.1f} m behind what happens, where the wall of a still life would hide it",
                "film.py",
                "use another set, or look from another side: facing_deg=…",
            )
        reach.append(far)
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
