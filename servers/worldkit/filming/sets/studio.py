"""A photographer's studio: a seamless sweep of paper, soft light from the left, nothing else."""

from typing import TYPE_CHECKING

from . import Place

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 400.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a photographer's studio: a seamless sweep of paper, soft light from the left, nothing else."""
    film.mood("high_key")
    film.light(azimuth_deg=place.facing_deg - 55, elevation_deg=50, strength=0.85, softness_deg=8)
    film.sky(zenith="#d9dadb", horizon="#eceae6", ground="#d6d2cb", strength=1.0, indoors=True)
    film.ground("backdrop")
