"""Furniture of rooms, drawn only: each stands on its spot and faces the camera. Metres; true sizes."""

from typing import TYPE_CHECKING

import numpy as np

from ..drawn_only import Surface
from ..trees import Mesh, joined
from . import Place
from .pieces import block, placed, turned

if TYPE_CHECKING:
    from ..dressing import Dressing

BOOKS = ("#7a2e2a", "#2f4858", "#c9b27c", "#3d5a3a", "#8a8f98", "#d9d2c3", "#54324a", "#b5652f")


def put(
    film: "Dressing",
    place: Place,
    name: str,
    pieces: list[Mesh],
    at: tuple[float, float, float],
    look: str | Surface,
    turn_deg: float = 0.0,
) -> None:
    """Draw some pieces as one thing with one look, their front toward the camera, turned by `turn_deg` from that."""
    film.mesh(name, *placed(joined(pieces), at, place.yaw_to_camera() + turn_deg), look=look)


def walls(
    film: "Dressing",
    place: Place,
    away: float,
    *,
    high: float = 2.7,
    wall: str | Surface = "plaster",
    side: float | None = None,
) -> None:
    """Two walls behind the action, `away` m from its middle, with skirting, and a window in the left one."""
    wide = 2 * (side or away) + 4.0
    paint = Surface(colour=wall, roughness=0.92) if isinstance(wall, str) and wall.startswith("#") else wall
    for name, turn, yaw in (("back wall", 180.0, 0.0), ("side wall", 270.0, 90.0)):
        put(film, place, name, [block(wide, 0.1, high, radius=0.002)], place.spot(away, turn), paint, yaw)
        put(
            film,
            place,
            f"{name}'s skirting",
            [block(wide, 0.02, 0.1, (0, -0.06, 0))],
            place.spot(away, turn),
            "plastic_white",
            yaw,
        )
    frame = [block(1.5, 0.06, 0.07, (0, -0.06, z)) for z in (0.85, 2.05)]
    frame += [block(0.06, 0.06, 1.25, (x, -0.06, 0.85)) for x in (-0.72, 0.0, 0.72)]
    put(film, place, "window", frame, place.spot(away, 270.0), "plastic_white", 90.0)
    pane = Surface(colour="#dfeaf6", glow=2.2, roughness=0.2)
    if place.dark:
        pane = Surface(colour="#22335c", glow=0.5 if place.hour == "dusk" else 0.12, roughness=0.08)
    put(film, place, "daylight", [block(1.4, 0.02, 1.2, (0, -0.05, 0.88))], place.spot(away, 270.0), pane, 90.0)


def shelf(
    film: "Dressing", place: Place, at: tuple[float, float, float], wide: float = 1.6, name: str = "shelf"
) -> None:
    """A bookshelf with books, upright and leaning, and a bowl."""
    boards = [block(wide, 0.3, 0.025, (0, 0, z)) for z in (0.05, 0.42, 0.79, 1.16, 1.53)]
    boards += [block(0.025, 0.3, 1.6, (x, 0, 0)) for x in (-wide / 2, wide / 2)]
    put(film, place, name, boards, at, "wood_oak")
    random = place.random
    rows: dict[str, list[Mesh]] = {colour: [] for colour in BOOKS}
    for z in (0.075, 0.445, 0.815, 1.185):
        x = -wide / 2 + 0.04
        while x < wide / 2 - 0.1:
            thick, tall = random.uniform(0.018, 0.05), random.uniform(0.2, 0.31)
            if random.random() < 0.12:
                x += random.uniform(0.05, 0.25)
                continue
            rows[BOOKS[int(random.integers(len(BOOKS)))]].append(
                block(thick, random.uniform(0.15, 0.21), tall, (x + thick / 2, -0.03, z), radius=0.003)
            )
            x += thick + 0.002
    for colour, books in rows.items():
        if books:
            put(film, place, f"{name}'s books {colour}", books, at, Surface(colour=colour, roughness=0.75))


def sofa(film: "Dressing", place: Place, at: tuple[float, float, float], colour: str = "#5d6d72") -> None:
    """A sofa with cushions."""
    body = [block(2.1, 0.85, 0.22, (0, 0, 0.14), 0.05), block(2.1, 0.22, 0.5, (0, 0.33, 0.34), 0.09)]
    body += [block(0.2, 0.85, 0.36, (x, 0, 0.26), 0.08) for x in (-0.98, 0.98)]
    body += [block(0.86, 0.66, 0.16, (x, -0.07, 0.34), 0.06) for x in (-0.44, 0.44)]
    put(film, place, "sofa", body, at, Surface(colour=colour, roughness=0.95))
    put(
        film,
        place,
        "sofa's legs",
        [block(0.05, 0.05, 0.14, (x, y, 0)) for x in (-0.95, 0.95) for y in (-0.35, 0.35)],
        at,
        "wood_walnut",
    )
    put(
        film,
        place,
        "cushion",
        [block(0.42, 0.16, 0.4, (0.62, 0.08, 0.5), 0.075)],
        at,
        Surface(colour="#c58a3d", roughness=0.95),
    )


def lamp(film: "Dressing", place: Place, at: tuple[float, float, float], high: float = 1.6) -> None:
    """A floor lamp that is lit; after sunset it lights the room."""
    if place.dark:
        x, y, z = at
        film.lamp("floor lamp", (x, y, z + high), strength=2.2, colour="#ffc98a", radius=0.04)
    put(
        film,
        place,
        "lamp's stand",
        [turned([(0, 0), (0.14, 0), (0.14, 0.02), (0.012, 0.03), (0.012, high), (0, high)], smooth=0)],
        at,
        "steel_dark",
    )
    shade = turned([(0.2, 0), (0.205, 0), (0.135, 0.26), (0.13, 0.26)], smooth=0)
    put(
        film,
        place,
        "lamp's shade",
        [(shade[0] + [0, 0, high - 0.1], shade[1])],
        at,
        Surface(colour="#ffdba6", glow=1.6),
    )


def plant(
    film: "Dressing", place: Place, at: tuple[float, float, float], high: float = 1.1, name: str = "plant"
) -> None:
    """A pot plant with arching leaves."""
    put(
        film,
        place,
        f"{name}'s pot",
        [turned([(0, 0), (0.13, 0), (0.17, 0.28), (0.15, 0.28), (0.14, 0.25), (0, 0.25)], smooth=0)],
        at,
        "ceramic_terracotta",
    )
    random, pieces = place.random, []
    for _ in range(46):
        yaw, reach, tall = random.uniform(0, 2 * np.pi), random.uniform(0.15, 0.5), high * random.uniform(0.45, 1.0)
        t = np.linspace(0, 1, 7)
        out = np.array([np.cos(yaw), np.sin(yaw)])
        line = np.column_stack(
            [out[0] * reach * t**1.5, out[1] * reach * t**1.5, 0.25 + (tall - 0.25) * np.sin(t * 1.9) / np.sin(1.9)]
        )
        width = 0.035 * np.sin(np.pi * np.clip(t, 0.04, 0.97))[:, None] * np.array([[-out[1], out[0], 0.0]])
        points = np.concatenate([line - width, line + width])
        k = np.arange(6)
        faces = np.concatenate([np.stack([k, k + 1, k + 7], 1), np.stack([k + 1, k + 8, k + 7], 1)])
        pieces.append((points, np.concatenate([faces, faces[:, ::-1]])))
    put(film, place, f"{name}'s leaves", pieces, at, Surface(colour="#47693a", roughness=0.55))


def picture(
    film: "Dressing",
    place: Place,
    at: tuple[float, float, float],
    wide: float,
    high: float,
    name: str = "picture",
    turn_deg: float = 0.0,
) -> None:
    """A framed picture: soft fields of colour."""
    random = place.random
    y, x = np.mgrid[0:1:96j, 0:1:96j]
    field = np.zeros((96, 96, 3))
    for _ in range(7):
        cx, cy, r = random.uniform((0, 0, 0.15), (1, 1, 0.5))
        field += np.exp(-(((x - cx) ** 2 + (y - cy) ** 2) / r**2))[..., None] * random.uniform(0.1, 0.8, 3)
    pixels = (255 * np.clip(0.25 + 0.5 * field / field.max(), 0, 1)).astype(np.uint8)
    put(
        film,
        place,
        f"{name}'s frame",
        [block(wide + 0.06, 0.03, high + 0.06, (0, 0, -0.03))],
        at,
        "wood_walnut",
        turn_deg,
    )
    put(
        film,
        place,
        name,
        [block(wide, 0.01, high, (0, -0.018, 0), 0.001)],
        at,
        Surface(picture=pixels, tile_m=max(wide, high), roughness=0.6),
        turn_deg,
    )


def bench_top(
    film: "Dressing",
    place: Place,
    at: tuple[float, float, float],
    wide: float,
    deep: float,
    high: float,
    top: str,
    body: str,
    name: str,
) -> None:
    """A run of cupboards with a worktop: doors with gaps and handles."""
    count = max(1, round(wide / 0.6))
    doors = [
        block(wide / count - 0.006, 0.02, high - 0.16, ((k + 0.5) * wide / count - wide / 2, -deep / 2, 0.1))
        for k in range(count)
    ]
    put(film, place, name, [block(wide, deep - 0.04, high - 0.04, (0, 0.01, 0)), *doors], at, body)
    put(film, place, f"{name}'s top", [block(wide + 0.03, deep + 0.03, 0.04, (0, 0, high - 0.04))], at, top)
    bars = [
        block(0.16, 0.015, 0.012, ((k + 0.5) * wide / count - wide / 2, -deep / 2 - 0.03, high - 0.14))
        for k in range(count)
    ]
    put(film, place, f"{name}'s handles", bars, at, "steel_brushed")
