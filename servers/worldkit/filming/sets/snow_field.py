"""A field of snow under a pale sky, with drifts, dark spruces at its edge and hills behind."""

from typing import TYPE_CHECKING

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 80.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a field of snow under a pale sky, with drifts, dark spruces at its edge and hills behind."""
    film.mood("overcast")
    film.light(azimuth_deg=place.facing_deg - 70, elevation_deg=26, colour="#ffeeda", strength=0.62, softness_deg=3)
    film.sky(zenith="#8fa9c6", horizon="#dfe6ec", ground="#c8d0d8", clouds=0.25, glow=0.3)
    film.fog(colour="#dfe6ec", visibility_m=900.0)
    film.grade(exposure_stops=-0.35, contrast=1.14, saturation=1.0)
    film.ground("snow")
    reach = 1.8 * place.radius + 4.0
    for number, (x, y) in enumerate(place.around(14, reach, reach + 26)):
        across = place.random.uniform(2, 7)
        film.draw(
            f"drift {number + 1}",
            "ellipsoid",
            (across, 0.6 * across, 0.12 * across),
            pos=(x, y, place.floor),
            look="snow",
        )
    land.wood(film, place, "conifer", 18, reach + 8, reach + 40, 11.0, "spruces")
    land.range_of_hills(film, place, away=170 + 3 * place.radius, height=44, look="snow", name="hills", rough=0.5)
