"""What landscapes share: turf with flowers, scattered stones, ranges of hills, a sheet of water."""

from typing import TYPE_CHECKING

import numpy as np

from ...forms.lattice import lattice
from .. import far_woods, sward
from ..drawn_only import Surface, matt, rgb
from ..trees import Mesh, joined
from . import Place, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing


HUES = (
    ("", 1.0, "", 0.44),
    (" (dark)", 0.7, "", 0.26),
    (" (young)", 1.0, "#a9c25a", 0.2),
    (" (dry)", 1.0, "#b7a468", 0.1),
)
"""Blades of a turf: what their name ends in, how bright they are, the colour that they go halfway to, and their share."""
LOW_M = 0.024
"""Where something passes, the turf is no higher than this, and than `LOW_SHARE` of what passes."""
LOW_SHARE = 0.12
BARE = ("snow", "ice", "sand", "asphalt", "concrete", "cobble", "brick", "tile")
"""Where the plan says that the ground is one of these, no grass grows."""


def grows(film: "Dressing") -> bool:
    """Whether grass grows on the ground that the plan states, or it states none."""
    return not any(stem in film.recorded.floor for stem in BARE)


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
    """Grass of several hues around the action, densest there and short where anything passes; `reach` m it is in its fullness."""
    if not grows(film):
        return
    reach = 2.5 * (reach or 2.2 * place.radius + 3.0)
    (x, y), colour = place.middle, np.array(rgb(look))
    for ending, bright, towards, share in HUES:
        tint = bright * (0.5 * (colour + np.array(rgb(towards))) if towards else colour)
        film.grass(
            name + ending, area=(x - reach, y - reach, x + reach, y + reach), height=height, count=int(share * count),
            look=_written(tint), clear_of=place.clear(0.5 * height), z=place.floor, densest=(float(x), float(y)),
            seed=int(place.random.integers(1 << 30)),
        )  # fmt: skip


def short_turf(film: "Dressing", place: Place, *, look: str, count: int = 12_000, name: str = "short grass") -> None:
    """What grows where something passes, too, so that no carpet is seen there: low, trodden, some of it dry."""
    thin = float(place.ways[:, 2].min()) / 1.3 if len(place.ways) else place.radius
    height, reach = min(LOW_M, LOW_SHARE * thin), min(place.radius + 1.2, 4.0)
    if height < 0.004 or not grows(film):
        return
    (x, y), colour = place.middle, np.array(rgb(look))
    for ending, tint, share in (("", 0.8 * colour, 0.7), (" (dry)", 0.5 * (colour + np.array(rgb("#b7a468"))), 0.3)):
        film.grass(
            name + ending, area=(x - reach, y - reach, x + reach, y + reach), height=height, count=int(share * count),
            look=_written(tint), z=place.floor, densest=(float(x), float(y)), seed=int(place.random.integers(1 << 30)),
        )  # fmt: skip


def _written(colour: np.ndarray) -> str:
    return "#" + "".join(f"{round(255 * float(np.clip(part, 0, 1))):02x}" for part in colour)


def flowers(
    film: "Dressing", place: Place, colours: tuple[str, ...], reach: float, count: int = 260, height: float = 0.2
) -> None:
    """Small blossoms on stems among the grass, of several colours, in clumps."""
    x, y = place.middle
    stems: list[Mesh] = []
    for colour in colours:
        foot = sward.scattered((x - reach, y - reach, x + reach, y + reach), count, (float(x), float(y)), place.random)
        for at_x, at_y, radius in place.clear(0.1):
            foot = foot[np.hypot(*(foot - (at_x, at_y)).T) > radius]
        if not len(foot):
            continue
        tall = height * place.random.uniform(0.45, 1.05, len(foot))
        lean = 0.3 * tall[:, None] * place.random.normal(size=(len(foot), 2))
        heart = np.column_stack([foot + lean, place.floor + tall])
        tilt = place.random.normal(size=(len(foot), 1, 2)) * 0.45
        angle = np.linspace(0, 2 * np.pi, 9)[:8] + place.random.uniform(0, 6, (len(foot), 1))
        size = place.random.uniform(0.005, 0.011, (len(foot), 1)) * np.where(np.arange(8) % 2, 0.55, 1.0)
        flat = np.stack([size * np.cos(angle), size * np.sin(angle)], -1)
        ring = np.concatenate([flat, (flat * tilt).sum(axis=-1, keepdims=True) + 0.15 * size[..., None]], axis=-1)
        points = np.concatenate([heart[:, None], heart[:, None] + ring], axis=1).reshape(-1, 3)
        k = np.arange(8)
        fan = np.stack([np.zeros(8, int), 1 + k, 1 + (k + 1) % 8], axis=1)
        faces = (np.arange(len(foot))[:, None, None] * 9 + np.concatenate([fan, fan[:, ::-1]])[None]).reshape(-1, 3)
        sways = np.repeat(0.35 * tall, 9)  # with the stem that carries it
        film.mesh(f"blossoms {colour}", points, faces, look=Surface(colour=colour, roughness=0.7), sways=sways)
        low = np.column_stack([foot, np.full(len(foot), place.floor)])
        half = np.array([0.0012, 0.0, 0.0])
        stem = np.stack([low - half, low + half, heart - (0, 0, 0.001)], axis=1)
        stems.append((stem.reshape(-1, 3), np.arange(3 * len(foot)).reshape(-1, 3)))
    if stems:
        points, faces = joined(stems)
        sways = np.where(np.arange(len(points)) % 3 == 2, 0.35 * (points[:, 2] - place.floor), 0.0)
        film.mesh("stems", points, faces, look=matt("#5d7a38"), sways=sways)


def stones(
    film: "Dressing", place: Place, at: np.ndarray, sizes: tuple[float, float], look: str = "rock", name: str = "stones"
) -> None:
    """Stones lying about, half sunk in, each another."""
    found: list[Mesh] = []
    for x, y in at:
        size = float(np.exp(place.random.uniform(*np.log(sizes))))
        stone = pieces.rock(size, place.random)
        found.append(pieces.placed(stone, (x, y, place.floor + 0.12 * size), place.random.uniform(0, 360)))
    if found:
        film.mesh(name, *joined(found), look=look)


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
    faces, uv = lattice(deep, across)[:, [0, 2, 1]], None
    if isinstance(look, str) and look.startswith("#"):
        look = pieces.wooded(look, place.random)
        uv = np.stack(np.broadcast_arrays(np.linspace(0, 1, across)[None], 1.0 - depth), -1).reshape(-1, 2)
    film.mesh(name, np.stack([x, y, z], -1).reshape(-1, 3), faces, uv=uv, look=look)


def edge_of_a_wood(
    film: "Dressing",
    place: Place,
    *,
    away: float,
    height: float = 11.0,
    count: int = 110,
    looks: tuple[str, str] = ("#46602f", "#5c7438"),
    name: str = "edge of the wood",
) -> None:
    """Trees side by side far around the action, none on the side of the camera: groves and gaps, from `away` m on."""
    turn = place.random.uniform(50.0, 310.0, 3 * count)
    groves = pieces.noise(turn / 40.0, 0 * turn, place.random, 3)
    order = np.argsort(place.random.exponential(size=len(turn)) / np.exp(3.0 * groves), kind="stable")[:count]
    far = away * (1.0 + 0.35 * np.abs(pieces.noise(turn / 25.0, 0 * turn, place.random, 2)))
    far *= place.random.uniform(1.0, 1.16, len(turn))
    spots = np.array([place.spot(far[k], turn[k])[:2] for k in order])
    for number, look in enumerate(looks):
        mine = spots[number :: len(looks)]
        title = name if number == 0 else f"{name} (lighter)"
        film.mesh(title, *far_woods.crowns(mine, height, place.floor, place.random), look=matt(look))


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
