"""The hour of a set: `film.set("park", hour="night")` gives sky, moon or sun, developing, and the lamps that are lit then.

Outdoors an hour is a mood of `MOODS`, with the light on the side where it models what happens. Indoors it is what comes
through the window, and lamps that do the rest.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..dressing import Dressing

Place = Any
"""Where the action is; its module imports this one."""
HOURS = ("noon", "golden_hour", "overcast", "misty_morning", "dusk", "night")
SUNNY = ("", "noon", "golden_hour")
"""Hours at which the sun shines into a room; its own is one."""
LIT = ("dusk", "night")
"""Hours at which lamps burn."""
SEEN_FROM: dict[str, tuple[str, float, float]] = {
    "noon": ("noon", -55.0, 50.0),
    "golden_hour": ("golden_hour", -72.0, 13.0),
    "overcast": ("overcast", -60.0, 62.0),
    "misty_morning": ("misty_morning", 150.0, 18.0),
    "dusk": ("blue_hour", 150.0, 20.0),
    "night": ("night", 128.0, 34.0),
}
"""The mood outdoors, and where its light stands: degrees from the camera's side around the action, and up."""
NIGHT_AIR: dict[str, Any] = {"colour": "#0b1120", "visibility_m": 700.0, "height_m": 40.0}
"""What a set's own mist is by night."""
THROUGH_WINDOWS: dict[str, dict[str, Any]] = {
    "noon": {"colour": "#fff4e4", "strength": 1.1, "elevation_deg": 48.0, "softness_deg": 1.5, "fill": 0.5},
    "golden_hour": {"colour": "#ffb36b", "strength": 1.1, "elevation_deg": 15.0, "softness_deg": 1.5, "fill": 0.42},
    "overcast": {"colour": "#e6ecf2", "strength": 0.4, "elevation_deg": 40.0, "softness_deg": 9.0, "fill": 0.75},
    "misty_morning": {"colour": "#ffe6c6", "strength": 0.6, "elevation_deg": 20.0, "softness_deg": 6.0, "fill": 0.65},
    "dusk": {"colour": "#7f9fe6", "strength": 0.16, "elevation_deg": 24.0, "softness_deg": 7.0, "fill": 0.16},
    "night": {"colour": "#9db8ff", "strength": 0.07, "elevation_deg": 34.0, "softness_deg": 2.5, "fill": 0.07},
}
"""The light of a room by its hour."""
WARM = "#ffcf96"
OVERHEAD = 1.05
"""Radiance of a white surface under a room's lamp."""
CONE_DEG = 79.0
"""Where the light of a lamp that shines down ends."""
BELOW = 1.3
"""Radiance of a white surface on the ground under a lamp that burns by night."""


def outdoors(film: "Dressing", place: Place) -> None:
    """Sky, light and developing of the hour."""
    mood, turn, up = SEEN_FROM[place.hour]
    film.mood(mood)
    film.light(azimuth_deg=place.facing_deg + turn, elevation_deg=up)
    if place.hour == "night":
        film.fog(**NIGHT_AIR)


def indoors(film: "Dressing", place: Place, high: float) -> None:
    """What comes through the window at the hour, and after sunset a lamp `high` m above the floor."""
    film.light(**THROUGH_WINDOWS[place.hour])
    film.grade(temperature=-0.05 if place.hour == "overcast" else 0.05)
    if place.dark:
        film.lamp("lamp overhead", place.spot(0.45 * high, 65, high), strength=OVERHEAD * high**2, colour=WARM)
        film.grade(exposure_stops=0.25, contrast=1.08, vignette=0.32, glow=0.1)


def through_window(film: "Dressing", place: Place) -> None:
    """Let sun fall through the panes of a window on what happens, unless the plan states its own light or the hour has none."""
    if place.hour in SUNNY and not film.recorded.light:
        film.gobo("window")


def burning(
    film: "Dressing",
    name: str,
    at: tuple[float, float, float],
    floor: float,
    *,
    radius: float = 0.0,
    down: bool = False,
) -> None:
    """A lamp that burns over a `floor` at a point, m: all around from a globe of a `radius`, or `down` alone."""
    x, y, z = at
    told = {"aim": (x, y, floor), "cone_deg": CONE_DEG} if down else {"radius": radius}
    film.lamp(name, at, strength=BELOW * (z - floor) ** 2, colour=WARM, **told)
