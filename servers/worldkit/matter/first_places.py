"""Where matter begins: regions that are filled with points at the start, and sources that let it in over time.

All in the world frame. Points lie on a cubic lattice; those of sand and snow a little off it, by a seeded draw.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import ProgramError

Array = np.ndarray
SEED = 7


@dataclass(frozen=True)
class Region:
    """A part of space: where a test of (n, 3) points, m, says True, between two corners."""

    low: Array
    high: Array
    holds: Callable[[Array], Array]

    def points(self, spacing: float, scatter: float) -> Array:
        """(n, 3) m: a lattice that is centred in it, each point off by up to `scatter` spacings."""
        sides = self.high - self.low
        counts = np.maximum(np.floor(sides / spacing + 1e-6).astype(int), 1)
        axes = [
            a + (side - (n - 1) * spacing) / 2 + spacing * np.arange(n)
            for a, side, n in zip(self.low, sides, counts, strict=True)
        ]
        found = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        found = found[np.asarray(self.holds(found), bool)]
        off = np.random.default_rng(SEED).uniform(-scatter, scatter, found.shape)
        return np.asarray(found + spacing * off)


def block(low: Any, high: Any) -> Region:
    """A box from corner to corner, m."""
    return within(lambda p: np.ones(len(p), bool), low, high)


def column(foot: Any, radius: float, height: float) -> Region:
    """An upright cylinder on the middle of its foot, m."""
    x, y, z = map(float, foot)
    low, high = (x - radius, y - radius, z), (x + radius, y + radius, z + height)
    return within(lambda p: np.hypot(p[:, 0] - x, p[:, 1] - y) <= radius, low, high)


def within(holds: Callable[[Array], Array], low: Any, high: Any) -> Region:
    """What a test of (n, 3) points says True of, between two corners, m: inside a bowl, a heap.

    Raises:
        ProgramError: the corners leave no room.
    """
    a, b = np.array(low, float), np.array(high, float)
    if a.shape != (3,) or b.shape != (3,) or not (b > a).all():
        cause = f"a region from {low} to {high} has no room"
        raise ProgramError(cause, "worldkit.matter", "give its low and its high corner, (x, y, z) m")
    return Region(a, b, holds)


@dataclass(frozen=True)
class Source:
    """A mouth through which a told mass comes in, evenly, from one time to another.

    Args:
        mass: kg, exactly.
        at: (x, y, z) m, middle of the mouth.
        starts, ends: s.
        radius: m, of a round mouth that faces along `way`; matter fills it, and its speed follows.
        sides: (x, y) m, of a level rectangle, over which flakes or grains are strewn, in place of `radius`.
        speed: m/s, of what is strewn.
        way: direction in which it leaves.
    """

    mass: float
    at: tuple[float, float, float]
    starts: float
    ends: float
    radius: float | None = None
    sides: tuple[float, float] | None = None
    speed: float = 0.0
    way: tuple[float, float, float] = (0.0, 0.0, -1.0)

    def __post_init__(self) -> None:
        """Refuse what pours nothing.

        Raises:
            ProgramError: neither or both kinds of mouth, no mass, or no time.
        """
        if (self.radius is None) == (self.sides is None) or self.mass <= 0 or self.ends <= self.starts:
            cause = f"a source of {self.mass:g} kg from {self.starts:g} to {self.ends:g} s has no mouth, or two, or gives nothing"
            raise ProgramError(cause, "worldkit.matter", "give mass > 0, ends > starts, and either radius or sides")

    def leaves(self, density: float) -> float:
        """m/s at the mouth."""
        if self.radius is None:
            return self.speed
        return self.mass / (density * np.pi * self.radius**2 * (self.ends - self.starts))

    def fed(self, spacing: float, density: float) -> tuple[Array, Array, Array]:
        """Points (n, 3), m, on the mouth, the times (n,), s, at which they leave it, and their velocity (3,), m/s.

        Raises:
            ProgramError: the mouth is too narrow for the spacing.
        """
        way = np.array(self.way, float) / np.linalg.norm(self.way)
        count = max(1, round(self.mass / (density * spacing**3)))
        draw = np.random.default_rng(SEED)
        if self.sides is not None:
            flat = draw.uniform(-0.5, 0.5, (count, 2)) * self.sides
            places = np.column_stack([flat, np.zeros(count)])
            when = self.starts + (np.arange(count) + 0.5) / count * (self.ends - self.starts)
            return places + self.at, when, way * self.speed
        radius = float(self.radius or 0.0)
        if radius < 1.5 * spacing:
            cause = f"a mouth of {radius:g} m is too narrow for points {spacing:g} m apart"
            raise ProgramError(
                cause, "worldkit.matter", f"make it {1.5 * spacing:.3g} m or wider, or the spacing finer"
            )
        aside = np.cross(way, (1, 0, 0) if abs(way[0]) < 0.7 else (0, 1, 0))
        aside /= np.linalg.norm(aside)
        across = np.cross(way, aside)
        reach = int(radius / spacing) + 1
        grid = spacing * (np.stack(np.meshgrid(*[np.arange(-reach, reach + 1)] * 2), -1).reshape(-1, 2) + 0.25)
        slice_ = grid[np.hypot(*grid.T) <= radius - 0.25 * spacing]
        rows = max(1, round(count / len(slice_)))
        flat = np.tile(slice_, (rows, 1))
        when = self.starts + (np.repeat(np.arange(rows), len(slice_)) + 0.5) / rows * (self.ends - self.starts)
        places = np.asarray(self.at) + flat[:, :1] * aside + flat[:, 1:] * across
        return places, when, way * self.leaves(density)
