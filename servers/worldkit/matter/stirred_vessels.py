"""The inside of a vessel that a stirred liquid stands in, and the grid over it: rings and spokes in a round one, rows and columns in a square one.

A round vessel is told by the profile of its inside, as a lathe's is; as far from its middle as that rises less than it goes outwards it
is floor, which may be hollow as a bowl's, and from there on wall. The computation has an upright wall where the level meets the
vessel's; what is drawn follows the wall as it is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import ProgramError

Array = np.ndarray
STEEP = 1.0
"""What rises more than this is wall."""


@dataclass(frozen=True)
class Vessel:
    """The inside of a vessel that stands still.

    Args:
        profile: of a round one, (r, z) m from the middle of the floor outwards and upwards, z above `at`.
        sides: of a rectangular one, (x, y) m, inside; its profile is that of the floor's height and the rim's: ((0, z), (0, z)).
        at: (x, y, z) m, where the profile's origin stands in the world.
    """

    profile: Sequence[tuple[float, float]]
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    sides: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        line = np.array(self.profile, float)
        good = line.ndim == 2 and line.shape[1:] == (2,) and len(line) >= 2 and np.isfinite(line).all()
        wide = self.sides is not None or (good and line[0, 0] == 0 and line[-1, 0] > 0)
        if not (good and wide and (np.diff(line, axis=0) >= 0).all() and line[-1, 1] > line[0, 1]):
            raise ProgramError(
                f"the inside of the vessel has the profile {self.profile}",
                "worldkit.matter.Vessel",
                "tell (r, z) from (0, floor) on, never inwards nor downwards, up to the rim",
            )

    @property
    def floor(self) -> float:
        """m, world frame, in its middle."""
        return self.at[2] + float(self.profile[0][1])

    @property
    def rim(self) -> float:
        """m, world frame."""
        return self.at[2] + float(self.profile[-1][1])

    def radius(self, z: Array | float) -> Array:
        """m: of the wall of a round one at heights, world frame; above the rim as there."""
        line = np.array(self.profile, float)
        high = line[:, 1] + 1e-12 * np.arange(len(line))  # a level floor: the farthest place of it
        return np.interp(np.asarray(z, float) - self.at[2], high, line[:, 0])

    def bed(self, r: Array) -> Array:
        """m: height of the floor above its middle, so far from it."""
        if self.sides is not None:
            return np.zeros_like(np.asarray(r, float))
        line = np.array(self.profile, float)
        rise = np.diff(line[:, 1]) > STEEP * np.diff(line[:, 0])
        last = int(np.argmax(rise)) if rise.any() else len(line) - 1
        return np.interp(r, line[: last + 1, 0], line[: last + 1, 1] - line[0, 1])


@dataclass(frozen=True)
class Grid:
    """Cells in I rows from the middle outwards, or along x, and J columns around it, or along y.

    Velocities lie on the sides of cells: u (I + 1, J) m/s across the rows, v (I, J) across the columns, where column j lies between j - 1 and j.
    """

    round: bool
    middle: Array
    """(2,) m."""
    deep: float
    """m: of a cell across the rows."""
    turn: float
    """rad between columns; 0 of a square one."""
    wide: Array
    """(I,) m: of a cell across the columns, at its middle."""
    edge: Array
    """(I + 1,) m: of the sides between rows."""
    area: Array
    """(I,) m^2, of a cell."""
    reach: tuple[float, float]
    """m: radius twice, or half sides."""
    columns: int

    @property
    def rows(self) -> int:
        """I."""
        return len(self.area)

    def middles(self) -> tuple[Array, Array]:
        """(I, J) x and y of the cells' middles, m."""
        i, j = np.meshgrid(np.arange(self.rows) + 0.5, np.arange(self.columns) + 0.5, indexing="ij")
        return self.place(i, j)

    def place(self, i: Array, j: Array) -> tuple[Array, Array]:
        """x and y, m, of places counted in rows and columns from the first side on."""
        if self.round:
            return self.middle[0] + i * self.deep * np.cos(j * self.turn), self.middle[1] + i * self.deep * np.sin(
                j * self.turn
            )
        return (
            self.middle[0] - self.reach[0] + i * self.deep,
            self.middle[1] - self.reach[1] + j * self.wide[0],
        )


def over(vessel: Vessel, level: float, rows: int, columns: int) -> Grid:
    """A grid of a vessel that is filled up to a level, m, world frame.

    Raises:
        ProgramError: the level is not between floor and rim.
    """
    if not vessel.floor < level < vessel.rim:
        cause = (
            f"the level of {level:g} m is not between the floor at {vessel.floor:g} m and the rim at {vessel.rim:g} m"
        )
        raise ProgramError(cause, "worldkit.matter.Stirred", "let it be between them")
    middle = np.array(vessel.at[:2], float)
    if vessel.sides is None:
        radius = float(vessel.radius(level))
        deep, turn = radius / rows, 2 * np.pi / columns
        edge = np.arange(rows + 1) * deep * turn
        wide = (np.arange(rows) + 0.5) * deep * turn
        return Grid(True, middle, deep, turn, wide, edge, wide * deep, (radius, radius), columns)
    x, y = vessel.sides
    deep, wide = x / rows, np.full(rows, y / columns)
    return Grid(False, middle, deep, 0.0, wide, np.full(rows + 1, y / columns), wide * deep, (x / 2, y / 2), columns)
