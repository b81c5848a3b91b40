"""What landscapes share: turf with flowers, scattered stones, ranges of hills, a sheet of water."""

from typing import TYPE_CHECKING

import numpy as np

from ...forms.lattice import lattice
from ..drawn_only import Surface
from . import Place, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing


def turf(
    film: "Dressing",
    place: Place,
    *,
    height: float,
    look: str,
    reach: float = 0.0,
    name: str = "grass",
    count: int = 45_000,
) -> None:
    """Blades of grass around the action, thinner in its middle, none where anything passes."""
    reach = reach or 2.2 * place.radius + 3.0
    x, y = place.middle
    film.grass(
        name, area=(x - reach, y - reach, x + reach, y + reach), height=height, count=count, look=look,
        clear_of=place.clear(0.6 * height), z=place.floor, seed=int(place.random.integers(1 << 30)),
    )  # fmt: skip


def flowers(
    film: "Dressing", place: Place, colours: tuple[str, ...], reach: float, count: int = 700, height: float = 0.2
) -> None:
    """Small blossoms on the grass, of several colours."""
    for colour in colours:
        foot = place.middle + place.random.uniform(-reach, reach, (count, 2))
        for x, y, radius in place.clear(0.1):
            foot = foot[np.hypot(*(foot - (x, y)).T) > radius]
        tilt = place.random.normal(size=(len(foot), 5, 2)) * 0.3
        angle = np.linspace(0, 2 * np.pi, 6)[:5] + place.random.uniform(0, 6, (len(foot), 1))
        size = place.random.uniform(0.007, 0.016, (len(foot), 1))
        ring = np.stack([size * np.cos(angle), size * np.sin(angle), size * tilt[..., 0] * 0.5], -1)
        heart = np.column_stack([foot, place.floor + height * place.random.uniform(0.5, 1.05, len(foot))])
        points = np.concatenate([heart[:, None], heart[:, None] + ring], axis=1).reshape(-1, 3)
        k = np.arange(5)
        fan = np.stack([np.zeros(5, int), 1 + k, 1 + (k + 1) % 5], axis=1)
        faces = (np.arange(len(foot))[:, None, None] * 6 + np.concatenate([fan, fan[:, ::-1]])[None]).reshape(-1, 3)
        if len(foot):
            sways = np.repeat(0.35 * (heart[:, 2] - place.floor), 6)  # with the blade that carries it
            film.mesh(f"blossoms {colour}", points, faces, look=Surface(colour=colour, roughness=0.7), sways=sways)


def stones(
    film: "Dressing", place: Place, at: np.ndarray, sizes: tuple[float, float], look: str = "rock", name: str = "stones"
) -> None:
    """Stones lying about, half sunk in, each another."""
    found: list[pieces.Mesh] = []
    for x, y in at:
        size = float(np.exp(place.random.uniform(*np.log(sizes))))
        stone = pieces.rock(size, place.random)
        found.append(pieces.placed(stone, (x, y, place.floor + 0.12 * size), place.random.uniform(0, 360)))
    if found:
        film.mesh(name, *pieces.joined(found), look=look)


def range_of_hills(
    film: "Dressing",
    place: Place,
    *,
    away: float,
    height: float,
    look: str | Surface,
    name: str,
    rough: float = 1.0,
    turn_deg: tuple[float, float] = (-70, 70),
) -> None:
    """Hills or mountains on the horizon behind the action, seen from the camera, `away` m off and up to `height` m high."""
    across, deep = 161, 25
    turn = np.radians(place.facing_deg + 180 + np.linspace(*turn_deg, across))
    depth = np.linspace(0.0, 1.0, deep)[:, None]
    far = away * (1 + 0.9 * depth)
    x, y = place.middle[0] + far * np.cos(turn), place.middle[1] + far * np.sin(turn)
    seed = place.random
    shape = 0.55 + 0.45 * pieces.noise(np.linspace(0, 3.0, across)[None] + 0 * depth, depth + 0 * turn, seed, 3)
    crags = (
        rough * 0.22 * np.abs(pieces.noise(np.linspace(0, 9.0, across)[None] + 0 * depth, 3 * depth + 0 * turn, seed))
    )
    z = (
        place.floor
        - 0.5
        + height * np.sin(np.pi * np.minimum(1.0, 1.25 * depth)) ** 0.8 * np.clip(shape - crags, 0.05, None)
    )
    faces = lattice(deep, across)[:, [0, 2, 1]]
    film.mesh(name, np.stack([x, y, z], -1).reshape(-1, 3), faces, look=look)


def wood(
    film: "Dressing",
    place: Place,
    kind: str,
    count: int,
    nearest: float,
    farthest: float,
    height: float,
    name: str,
    free_deg: float = 110.0,
) -> None:
    """Trees in a ring around the action, none before the camera."""
    at = [(float(spot[0]), float(spot[1])) for spot in place.around(count, nearest, farthest, free_deg)]
    film.tree(name, kind, at=at, height=height, z=place.floor, seed=int(place.random.integers(1 << 30)))


def water(film: "Dressing", place: Place, *, shore: float, name: str = "water", beyond: float = 600.0) -> None:
    """A sheet of water behind the action to the horizon, from `shore` m behind its middle."""
    x, y, z = place.spot(shore + beyond / 2, 180.0, 0.012)
    film.draw(name, "box", (2 * beyond, beyond, 0.02), pos=(x, y, z), yaw_deg=place.yaw_to_camera(), look="water")
