"""Light a setting as a film asks: move, colour or soften its key light, exchange its surroundings for the film's sky."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, tan

import numpy as np

from worldkit.settings import Light, Setting

from ...treatment import Treatment
from .finish import linear

TOLD = 4
"""The number of the film's own sky, among those of the settings."""
SOFTEST = 0.16
"""The widest spread that the shadow filter draws without grain."""
FAR_M = 650.0
"""On a clear day air hides 63 % of what is so far away, m: the edge of a wood is blue a little, and hills are pale."""
SUN = 3.0
"""The radiance of a white surface that faces a light of strength 1."""


def relight(own: Setting, told: Treatment) -> Setting:
    """The world's own setting, changed as the film asks."""
    key = own.key
    colour = np.array(key.colour)
    if told.light_rgb is not None:
        tint = linear(told.light_rgb)
        colour = colour.max() * tint / max(float(tint.max()), 1e-6)
    if told.light_strength is not None:
        colour = SUN * told.light_strength * colour / max(float(colour.max()), 1e-6)
    azimuth = key.azimuth_deg if told.light_azimuth_deg is None else told.light_azimuth_deg
    elevation = key.elevation_deg if told.light_elevation_deg is None else told.light_elevation_deg
    spread = (
        own.key_spread
        if told.light_softness_deg is None
        else min(max(tan(radians(told.light_softness_deg)), 0.004), SOFTEST)
    )
    found = replace(own, key=Light(azimuth, elevation, tuple(colour.tolist())), key_spread=spread)
    if told.sky_zenith is None:
        fills = tuple(replace(fill, colour=tuple(told.sky_strength * c for c in fill.colour)) for fill in own.fills)
        return replace(found, sky=own.sky * told.sky_strength, fills=fills)
    far = (1e6, 2e6)
    return replace(
        found, index=TOLD, fills=(), sky=1.0, fade=far, pool=far, haze_m=FAR_M, key_in_sky=False, exposure=0.8
    )


def sky_uniforms(setting: Setting, told: Treatment) -> dict[str, object]:
    """The uniforms of the sky's shader."""
    strength = told.sky_strength
    zenith = (0.0, 0.0, 0.0) if told.sky_zenith is None else told.sky_zenith
    half = told.light_softness_deg if told.light_softness_deg is not None else 2.0
    return {
        "key_direction": np.array(setting.key.direction), "key_colour": setting.key.colour,
        "sky_zenith": linear(zenith) * strength, "sky_horizon": linear(told.sky_horizon) * strength,
        "sky_ground": linear(told.sky_ground) * strength,
        "sky_traits": (told.sky_glow, told.sky_clouds, told.sky_stars, cos(radians(max(half, 0.8)))),
        "sky_indoors": told.sky_indoors,
    }  # fmt: skip
