"""A street of a town: asphalt, kerb and pavement, houses with windows, lamp posts, a parked van."""

from typing import TYPE_CHECKING

from . import Place, furniture, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 40.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a street of a town: asphalt, kerb and pavement, houses with windows, lamp posts, a parked van."""
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
    side = -38.0
    for number, colour in enumerate(("#b9a58a", "#8d5a48", "#c9c4b8", "#9a8f6e", "#7c8790")):
        wide, storeys = place.random.uniform(12, 19), int(place.random.integers(3, 6))
        front = pieces.facade(colour, place.random, storeys)
        high = 3.0 * storeys
        house = [pieces.block(wide, 10, high, (side + wide / 2, 5, 0), 0.02)]
        furniture.put(film, place, f"house {number + 1}", house, place.spot(kerb + 3.2, 180), front)
        roof = [pieces.block(wide + 0.3, 10.4, 0.35, (side + wide / 2, 5, high), 0.05)]
        furniture.put(film, place, f"roof {number + 1}", roof, place.spot(kerb + 3.2, 180), "slate")
        side += wide + 0.02
    for number, turn in enumerate((-12.0, 9.0)):
        post = [
            pieces.block(0.11, 0.11, 5.2, (turn, 0.6, 0)),
            pieces.block(0.09, 1.3, 0.08, (turn, 0.0, 5.15)),
            pieces.block(0.22, 0.5, 0.09, (turn, -0.5, 5.08)),
        ]
        furniture.put(film, place, f"lamp post {number + 1}", post, place.spot(kerb + 0.2, 180), "steel_dark")
