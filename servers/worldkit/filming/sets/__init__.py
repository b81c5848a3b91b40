"""Sets: surroundings of a film in one line, `film.set("meadow")`; each is a file of this folder.

A set is drawn only. It stands around the space that the movers cross, at true scale, leaves the side free from which the
camera looks, and gives light, sky and air; what the film says afterwards changes that. `Place` says where the action is;
`seed` makes another of the same kind.
"""

from dataclasses import dataclass, replace
from math import remainder
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ...errors import ProgramError
from ...seams import Seam
from ..plain_refusals import whole
from ..recorded import Recorded
from . import hours

if TYPE_CHECKING:
    from ..dressing import Dressing


class Set(Protocol):
    """The protocol of the modules of this folder."""

    WIDEST: float
    """The largest radius, m, of what happens that this set can hold."""

    def build(self, film: "Dressing", place: "Place") -> None:
        """Draw what stands around, and set light, sky and air."""


SETS: Seam[Set] = Seam(__name__, Set, "set")
ROOMS = ("living_room", "workshop", "gym")
"""Sets with walls and furniture, which stand around the furniture of the world, too."""
ON_TOPS = ("kitchen_counter", "laboratory", "still_life")
"""Sets on the top of a table, in a room."""
NO_SETS = ("pieces", "land", "furniture", "dried_flowers", "hours", "town")
"""Modules of this folder that the sets are made with."""


def names() -> tuple[str, ...]:
    """The sets there are, sorted."""
    return tuple(known for known in SETS.names() if known not in NO_SETS)


LAND_M = 2.0
"""What is at least twice so wide is ground, not furniture, m."""


@dataclass(frozen=True)
class Place:
    """Where the action is, and where around it there is room."""

    middle: np.ndarray
    """(2,) m: the middle of the space that the movers cross, x and y."""
    radius: float
    """Around the middle, m: all that moves stays within."""
    top: float
    """Its highest point, m."""
    floor: float
    """Height of the ground, m."""
    facing_deg: float
    """From where the camera looks at it: an azimuth, counter-clockwise from +x."""
    ways: np.ndarray
    """(N, 3): x, y and radius of discs, m, that the movers pass: nothing grows there."""
    random: np.random.Generator
    colour: str = ""
    """Of the wall, where the film names one."""
    hour: str = ""
    """The time of day, one of `hours.HOURS`; empty is the set's own."""
    bare: bool = False
    """Whether nothing stands about in it that is there for its looks alone."""
    standing: float = 0.0
    """The radius, m, with the things of the world that stand near what moves; a room leaves them their place."""

    @classmethod
    def of(cls, recorded: Recorded, facing_deg: float, seed: int) -> "Place":
        """The place of a recording."""
        names = recorded.movers or recorded.bodies
        times = np.linspace(0.0, recorded.duration, 60)
        points = [recorded.position(name, times) for name in names] or [np.zeros((1, 3))]
        every = np.concatenate(points)
        low, high = every.min(axis=0), every.max(axis=0)
        own = recorded.radius(*names)
        rows = [
            np.column_stack([way[:, :2], np.full(len(way), 1.3 * recorded.radius(n))])
            for n, way in zip(names, points, strict=False)
        ]
        middle, radius = 0.5 * (low + high)[:2], float(np.linalg.norm((high - low)[:2]) / 2 + own)
        return cls(
            middle=middle,
            radius=radius,
            top=float(high[2] + own),
            floor=recorded.floor_z,
            facing_deg=remainder(float(facing_deg), 360.0),
            ways=np.concatenate(rows) if rows else np.zeros((0, 3)),
            random=np.random.default_rng(whole(seed)),
            standing=max([radius, *_furniture(recorded, middle)]),
        )  # fmt: skip

    @property
    def dark(self) -> bool:
        """Whether lamps burn at this hour."""
        return self.hour in hours.LIT

    def spot(self, away: float, turn_deg: float, up: float = 0.0) -> tuple[float, float, float]:
        """A point `away` m from the middle, seen from the camera `turn_deg` to the right (180: straight behind), `up` m."""
        angle = np.radians(self.facing_deg - turn_deg)
        x, y = self.middle + away * np.array([np.cos(angle), np.sin(angle)])
        return float(x), float(y), float(self.floor + up)

    def yaw_to_camera(self) -> float:
        """The yaw, degrees, of a thing whose front is -y, turned so that it faces the camera."""
        return self.facing_deg + 90.0

    def around(self, count: int, nearest: float, farthest: float, free_deg: float = 95.0) -> np.ndarray:
        """(count, 2) places, m, in a ring around the middle, none in the `free_deg` before the camera."""
        away = nearest + (farthest - nearest) * self.random.random(count) ** 0.7
        turn = self.random.uniform(free_deg / 2, 360 - free_deg / 2, count)
        return np.array([self.spot(a, t)[:2] for a, t in zip(away, turn, strict=True)]).reshape(-1, 2)

    def clear(self, room: float = 0.0) -> list[tuple[float, float, float]]:
        """Discs (x, y, radius), m, that have to stay free, with some room."""
        return [(float(x), float(y), float(r) + room) for x, y, r in self.ways[:: max(1, len(self.ways) // 150)]]


def _furniture(recorded: Recorded, middle: np.ndarray) -> list[float]:
    """How far from a place (2,), m, things of the world reach that are no land."""
    found = []
    for name in recorded.bodies:
        half = recorded.box(name)[1]
        if half[:2].max() < LAND_M:
            away = np.linalg.norm(recorded.position(name, 0.0)[:2] - middle)
            found.append(float(away + np.linalg.norm((np.abs(recorded.orientation(name, 0.0)) @ half)[:2])))
    return [far for far in found if far < 2 * LAND_M]


def build(
    film: "Dressing", name: str, facing_deg: float, seed: int, colour: str = "", hour: str = "", *, bare: bool = False
) -> None:
    """Draw a set around what is recorded, at an hour of `hours.HOURS` or, with none, at its own.

    Raises:
        ProgramError: there is no such set or hour, what happens is too large for it, or it has no wall of a colour of choice.
    """
    there = names()
    if name not in there:
        raise ProgramError(f"there is no set {name!r}", "film.py", f"use one of: {', '.join(there)}")
    if hour not in ("", *hours.HOURS):
        raise ProgramError(f"no set has the hour {hour!r}", "film.py", f"use one of: {', '.join(hours.HOURS)}")
    place, found = Place.of(film.recorded, facing_deg, seed), SETS.find(name)
    if place.radius > found.WIDEST:
        larger = [known for known in there if place.radius <= SETS.find(known).WIDEST]
        raise ProgramError(
            f"what happens is {2 * place.radius:.1f} m across, and the set {name!r} holds {2 * found.WIDEST:.0f} m",
            "film.py",
            f"use a wider one: {', '.join(larger) or 'none is wider'}",
        )
    if colour and not hasattr(found, "COLOUR"):
        choice = ", ".join(known for known in there if hasattr(SETS.find(known), "COLOUR"))
        raise ProgramError(f"the set {name!r} has no wall whose colour is chosen", "film.py", f"use {choice}")
    place = replace(place, colour=colour, hour=hour, bare=bare)
    found.build(film, replace(place, radius=place.standing) if name in ROOMS else place)
    if hour and name in (*ROOMS, *ON_TOPS):
        hours.indoors(film, place, 0.95 if name in ON_TOPS else 2.3)
    elif hour:
        hours.outdoors(film, place)
