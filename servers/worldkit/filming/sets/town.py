"""What stands in towns: houses with windows that are lit by night, lamp posts that burn then."""

from typing import TYPE_CHECKING

import numpy as np

from ..drawn_only import Surface
from . import Place, furniture, hours
from .pieces import block, boxes

if TYPE_CHECKING:
    from ..dressing import Dressing

BAY_M, STOREY_M = 2.6, 3.1
PANE = (1.05, 1.55)
"""Width and height of a window, m; it stands `SILL_M` above its floor."""
SILL_M = 0.85
AWAKE = 0.42
"""Share of the windows that are lit."""
ROOMS_LIGHT = {"#ffca84": 1.1, "#ffd9a6": 0.7, "#ffb765": 0.5, "#ffe7c6": 0.85}
"""Colours of lit windows, and how much each glows."""
Row = tuple[float, float, float, tuple[float, float, float]]
LAP_M = 0.02
"""Strips of a wall reach so far into each other that no light comes through."""


def house(
    film: "Dressing",
    place: Place,
    name: str,
    at: tuple[float, float, float],
    side: float,
    wide: float,
    storeys: int,
    look: str | Surface,
) -> None:
    """A house whose front faces the camera, its left corner `side` m beside `at`: plinth, cornice, windows in deep reveals."""
    high, random = storeys * STOREY_M + 0.5, place.random
    bays = max(2, int(wide / BAY_M))
    first = side + 0.5 * (wide - (bays - 1) * BAY_M)
    spots = [
        (first + bay * BAY_M, SILL_M + storey * STOREY_M + 0.3) for storey in range(storeys) for bay in range(bays)
    ]
    door = int(random.integers(bays))
    spots = [spot for number, spot in enumerate(spots) if number != door]
    middle = side + wide / 2
    entry = first + door * BAY_M

    def put(part: str, rows: list[Row], made: str | Surface) -> None:
        if rows:
            furniture.put(film, place, f"{name}{part}", [boxes(rows)], at, made)

    put("", _wall(side, wide, high, spots), look)
    put(": within", [(wide, 9.6, high, (middle, 5.2, 0))], Surface(colour="#101114", roughness=0.9))
    trim = [(wide, 0.5, 0.32, (middle, 0.05, high)), (wide, 0.16, 0.5, (middle, -0.04, 0))]
    trim += [(wide, 0.1, 0.14, (middle, -0.03, k * STOREY_M + 0.1)) for k in range(1, storeys)]
    trim += [(PANE[0] + 0.24, 0.2, 0.07, (x, -0.06, z - 0.07)) for x, z in spots]
    put(": sills", trim, "concrete")
    frames = [(0.07, 0.06, PANE[1], (x + k * (PANE[0] - 0.07) / 2, 0.16, z)) for x, z in spots for k in (-1, 0, 1)]
    frames += [(PANE[0], 0.06, 0.07, (x, 0.16, z + k * (PANE[1] - 0.07))) for x, z in spots for k in (0, 0.66, 1)]
    put(": frames", frames, Surface(colour="#d9d5cb", roughness=0.5))
    put(": door", [(1.1, 0.1, 2.3, (entry, -0.03, 0))], "wood_walnut")
    panes = [(PANE[0], 0.02, PANE[1], (x, 0.2, z)) for x, z in spots]
    lit = np.where(random.random(len(spots)) < AWAKE * place.dark, np.arange(len(spots)) % len(ROOMS_LIGHT), -1)
    put(
        ": panes",
        [pane for pane, on in zip(panes, lit, strict=True) if on < 0],
        Surface(colour="#1b232c", roughness=0.07),
    )
    for number, (colour, glow) in enumerate(ROOMS_LIGHT.items()):
        some = [pane for pane, on in zip(panes, lit, strict=True) if on == number]
        put(f": lit panes {number + 1}", some, Surface(colour=colour, glow=glow, roughness=0.4))


def _wall(side: float, wide: float, high: float, spots: list[tuple[float, float]]) -> list[Row]:
    """The front, 0.25 m thick, with openings where windows are: strips between them."""
    found, below, middle = [], 0.0, side + wide / 2
    for z in sorted({round(z, 3) for _, z in spots}):
        found.append((wide, 0.25, z - below, (middle, 0.125, below)))
        left = side
        for x in [*sorted(x for x, at in spots if abs(at - z) < 1e-3), side + wide + PANE[0] / 2]:
            right = x - PANE[0] / 2
            if right - left > 0.01:
                found.append((right - left, 0.25, PANE[1] + 2 * LAP_M, ((left + right) / 2, 0.125, z - LAP_M)))
            left = x + PANE[0] / 2
        below = z + PANE[1]
    return [*found, (wide, 0.25, high - below, (middle, 0.125, below))]


def street_lamp(film: "Dressing", place: Place, number: int, at: tuple[float, float, float], side: float) -> None:
    """A lamp post of a street, 5.2 m high, `side` m to the right of `at`, its arm towards the camera; it burns after sunset."""
    post = [
        block(0.16, 0.16, 0.7, (side, 0.6, 0)),
        block(0.09, 0.09, 5.2, (side, 0.6, 0)),
        block(0.06, 1.3, 0.06, (side, 0.0, 5.16)),
        block(0.24, 0.56, 0.09, (side, -0.5, 5.1)),
    ]
    furniture.put(film, place, f"lamp post {number}", post, at, "steel_dark")
    glass = [block(0.19, 0.48, 0.035, (side, -0.5, 5.07))]
    glow = (
        Surface(colour="#ffe0b4", glow=4.0, roughness=0.3) if place.dark else Surface(colour="#c9ccce", roughness=0.2)
    )
    furniture.put(film, place, f"lamp post {number}: glass", glass, at, glow)
    if place.dark:
        hours.burning(film, f"street lamp {number}", _beside(place, at, side, -0.5, 5.0), place.floor, down=True)


def park_lamp(film: "Dressing", place: Place, number: int, at: tuple[float, float, float]) -> None:
    """A lantern of a park, 3.4 m high, with a frosted globe under a small roof; it burns after sunset."""
    post = [block(0.2, 0.2, 0.5), block(0.08, 0.08, 3.15), block(0.3, 0.3, 0.05, (0, 0, 3.1))]
    post += [block(0.42, 0.42, 0.06, (0, 0, 3.52))]
    post += [block(0.018, 0.018, 0.4, (x, y, 3.14)) for x in (-0.14, 0.14) for y in (-0.14, 0.14)]
    furniture.put(film, place, f"park lamp {number}", post, at, "steel_dark")
    x, y, z = at
    if place.dark:
        hours.burning(film, f"park lamp {number}: light", (x, y, z + 3.32), place.floor, radius=0.11)
    else:
        film.draw(
            f"park lamp {number}: globe",
            "sphere",
            0.24,
            pos=(x, y, z + 3.32),
            look=Surface(colour="#e4e2da", roughness=0.4),
        )


def _beside(
    place: Place, at: tuple[float, float, float], side: float, deep: float, up: float
) -> tuple[float, float, float]:
    """The point of a thing that `furniture.put` stands at a spot, `side` m to its right, `deep` m behind, `up` m."""
    yaw = np.radians(place.yaw_to_camera())
    x = at[0] + side * np.cos(yaw) - deep * np.sin(yaw)
    y = at[1] + side * np.sin(yaw) + deep * np.cos(yaw)
    return float(x), float(y), at[2] + up
