"""The four settings: where the light comes from, what lies behind the scene, and how the picture is developed.

Light is in scene-linear units in which a white surface facing a light of colour (1, 1, 1) has radiance 1.
"""

from dataclasses import dataclass
from math import cos, radians, sin

Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Light:
    """A distant light."""

    azimuth_deg: float
    """Where the light comes from, counter-clockwise from +x."""
    elevation_deg: float
    colour: Rgb

    @property
    def direction(self) -> Rgb:
        """Unit vector toward the light."""
        azimuth, elevation = radians(self.azimuth_deg), radians(self.elevation_deg)
        return (cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation))


@dataclass(frozen=True)
class Setting:
    """Light, surroundings and development of one kind of scene."""

    name: str
    index: int
    """Number by which the sky shader knows it."""
    floor: str
    """Look of the ground unless the scene names another."""
    key: Light
    key_spread: float
    """Tangent of the key light's angular radius: the wider, the softer its shadows."""
    fills: tuple[Light, ...]
    """Lights without shadows."""
    sky: float
    """Brightness of the surroundings as a light source."""
    exposure: float
    fade: tuple[float, float]
    """Where the ground begins to fade into the surroundings, and where the fade ends, in radii of the scene."""
    pool: tuple[float, float]
    """Where the key light begins to fall off, and where the fall-off ends, in radii of the scene."""
    haze_m: float
    """Distance at which haze hides 63 % of what is behind, metres; 0: clear air."""
    vignette: float
    key_in_sky: bool
    """The surroundings show the key light itself, so that glossy things mirror its shape."""


STUDIO = Setting(
    name="studio", index=0, floor="backdrop",
    key=Light(-122.0, 50.0, (2.35, 2.20, 2.00)), key_spread=0.15,
    fills=(Light(10.0, 26.0, (0.24, 0.27, 0.31)), Light(128.0, 34.0, (0.52, 0.50, 0.50))),
    sky=1.0, exposure=0.86, fade=(2.6, 7.5), pool=(1.6, 4.5), haze_m=0.0, vignette=0.26, key_in_sky=True,
)  # fmt: skip
ROOM = Setting(
    name="room", index=1, floor="wood_planks",
    key=Light(-118.0, 46.0, (2.30, 2.12, 1.86)), key_spread=0.12,
    fills=(Light(20.0, 32.0, (0.24, 0.26, 0.29)),),
    sky=1.0, exposure=0.92, fade=(1e6, 2e6), pool=(1e6, 2e6), haze_m=0.0, vignette=0.24, key_in_sky=False,
)  # fmt: skip
OUTDOOR = Setting(
    name="outdoor", index=2, floor="grass",
    key=Light(-128.0, 42.0, (3.1, 2.85, 2.45)), key_spread=0.03,
    fills=(),
    sky=1.0, exposure=0.78, fade=(1e6, 2e6), pool=(1e6, 2e6), haze_m=300.0, vignette=0.14, key_in_sky=False,
)  # fmt: skip
DARK = Setting(
    name="dark", index=3, floor="slate",
    key=Light(-125.0, 48.0, (1.35, 1.42, 1.60)), key_spread=0.07,
    fills=(Light(95.0, 24.0, (0.60, 0.42, 0.28)), Light(10.0, 20.0, (0.12, 0.17, 0.32))),
    sky=1.0, exposure=1.0, fade=(2.0, 7.0), pool=(1.2, 3.6), haze_m=0.0, vignette=0.40, key_in_sky=False,
)  # fmt: skip

SETTINGS: dict[str, Setting] = {setting.name: setting for setting in (STUDIO, ROOM, OUTDOOR, DARK)}
