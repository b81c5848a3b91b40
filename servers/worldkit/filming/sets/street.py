"""A street of a town: asphalt, kerb and pavement, houses with windows, lamp posts."""

from typing import TYPE_CHECKING

from ..drawn_only import Surface
from . import Place, town

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 40.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a street of a town: asphalt, kerb and pavement, houses with windows, lamp posts."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 60, elevation_deg=44)
    film.ground("asphalt")
    kerb = 1.3 * place.radius + 3.0
    yaw = place.yaw_to_camera()
    for name, away, wide, high, look in (
        ("kerb", kerb, 0.14, 0.13, "granite"),
        ("pavement", kerb + 1.6, 3.06, 0.12, "concrete"),
    ):
        x, y, _ = place.spot(away, 180)
        film.draw(name, "box", (160, wide, high), pos=(x, y, place.floor + high / 2), yaw_deg=yaw, look=look)
    line = place.spot(kerb - 1.2, 180, 0.003)
    film.draw("line", "box", (160, 0.12, 0.006), pos=line, yaw_deg=yaw, look="plastic_white")
    front = place.spot(kerb + 3.2, 180)
    side = -38.0
    for number, look in enumerate(("#8f7f68", "brick", "#a39c8d", "#7d7059", "brick")):
        wide, storeys = place.random.uniform(12, 19), int(place.random.integers(3, 6))
        wall = Surface(colour=look, roughness=0.92) if look.startswith("#") else look
        town.house(film, place, f"house {number + 1}", front, side, wide, storeys, wall)
        side += wide + 0.02
    for number, beside in enumerate((-0.6 * place.radius - 2.6, 0.6 * place.radius + 9.5)):
        town.street_lamp(film, place, number + 1, place.spot(kerb + 0.2, 180), beside)
