"""A slack skin with gas inside: thin rubber that wrinkles, folds in layers and empties by a hole; the law of a balloon that collapses.

`worldkit.skins.Skin` is for walls that hold their own shape. This one is for those that do not: rubber neither bears pressure in its
plane (a tension field: where it would, it wrinkles, and `creased` of its stiffness is left) nor holds itself up by bending, its layers
lie on each other, and all of it lies on a table. Steps are explicit and short, compiled (numba): 642 points take 0.1 ms each.

Energy of a triangle, of stretches a and b (a the larger), per volume: mu / 2 (a^2 + b^2 + 1 / (a b)^2 - 3), neo-Hookean; wrinkled, b below
a^(-1/2), mu / 2 (a^2 + 2 / a - 3); slack, a below 1, nothing (Pipkin 1986). Bending: quadratic in the mean curvature at each edge (Bergou
et al. 2006), flat at rest. Gas: p = n R T / V, and by a hole as `worldkit.skins.leaking` has it. Bodies but the table are not felt.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ProgramError
from ..skins.gas_and_wall import GAS, Gas, Wall
from ..skins.leaking import AIR, held, opening
from .slack_kernel import advance

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
BOUNCE, LEAST = 0.4, 4e-4
"""Share of the gas's own time that a step takes; less room than this, by area^1.5, counts as this."""
BRISK, APART, NEAR = 0.3, 0.7, 2.2
"""Share of the shortest time in which a wave crosses a triangle that a step takes; how near two layers come, and how far two points lie
apart unstretched to be of two layers, as shares of a mean side."""


class Membrane:
    """A law; name, bodies (`world` alone) and shown_by are the deriving class's.

    Args:
        shape: points (n, 3), m, world frame, at the start, and triangles (f, 3) of a closed surface.
        wall: what it is of: `young`, `thickness` of all, `density`, `stretched`, `damping` s, `friction` on the table, `air` 1/s.
        gas: what is inside; `hole` and `hole_at` let it out.
        creased: share of the stiffness against pressure in its plane that a wrinkled triangle keeps.
        supple: share of its stiffness against bending that it keeps: a mesh of triangles is stiffer against folds as fine as its sides.
        table: m, height of the table.

    Raises:
        ProgramError: the surface is not closed, a hole is not at it, or it is not on `world` alone.
    """

    name: str = "membrane"
    bodies: Sequence[str] = ("world",)
    shown_by: str = "membrane"

    def __init__(
        self,
        shape: tuple[Any, Any],
        wall: Wall,
        gas: Gas,
        creased: float = 0.0005,
        supple: float = 0.05,
        table: float = 0.0,
    ) -> None:
        self.points, self.triangles = np.array(shape[0], float), np.asarray(shape[1], np.int64)
        if tuple(self.bodies) != ("world",):
            raise ProgramError(
                f"{self.name} feels no bodies", self.name, 'let it lie on the table: bodies = ("world",)'
            )
        held(gas, self.triangles, self.name)
        self.wall, self.gas, self.creased, self.supple, self.table = wall, gas, creased, supple, table
        rest = self.points / wall.stretched
        p, q = (rest[self.triangles[:, n]] - rest[self.triangles[:, 0]] for n in (1, 2))
        twice = np.linalg.norm(np.cross(p, q), axis=1)
        along = p / np.linalg.norm(p, axis=1)[:, None]
        across = np.cross(np.cross(p, q) / twice[:, None], along)
        flat = np.stack(
            [np.stack([(p * along).sum(1), (q * along).sum(1)], 1), np.stack([0 * twice, (q * across).sum(1)], 1)], 1
        )
        self._inverse = np.ascontiguousarray(np.linalg.inv(flat).reshape(-1, 4))
        self._matter = twice / 2 * float(wall.thickness)
        self.mass = np.bincount(
            self.triangles.ravel(), np.repeat(self._matter * wall.density / 3, 3), minlength=len(rest)
        )
        self._edges, self._bends, sides = self._hinged(rest)
        side = float(sides.mean())
        self._far = NEAR * side
        self.apart = APART * side
        """m between two layers that lie on each other."""
        self._rest = rest
        self.finest = BRISK * float(sides.min()) * np.sqrt(wall.density / wall.young)
        """s, of a step."""
        self._hard = float(self.mass.mean()) * (0.2 / self.finest) ** 2
        self._gain = min(wall.damping * wall.young * float(wall.thickness), 0.05 * float(self.mass.min()) / self.finest)
        self.velocities = np.zeros_like(self.points)
        self._sums = np.zeros(7)  # impulse to the world (3), J that the gas gave, J in the walls, J in contacts, mol
        self.given, self.time = 0.0, 0.0

    def _hinged(self, rest: Array) -> tuple[Array, Array, Array]:
        """(e, 4) each edge's ends and the corners beside it, (e, 4) 1/m how the curvature there depends on them, (e,) m."""
        owner: dict[tuple[int, int], list[int]] = {}
        for a, b, c in self.triangles.tolist():
            for i, j, k in ((a, b, c), (b, c, a), (c, a, b)):
                owner.setdefault((min(i, j), max(i, j)), []).append(k)
        if any(len(beside) != 2 for beside in owner.values()):
            raise ProgramError(f"the skin {self.name} is not closed", self.name, "close it: `revolved`, `ball`")
        at = np.array([(*ends, *beside) for ends, beside in owner.items()], np.int64)
        x0, x1, x2, x3 = (rest[at[:, n]] for n in range(4))

        def cot(u: Array, v: Array) -> Array:
            return np.asarray((u * v).sum(1) / np.linalg.norm(np.cross(u, v), axis=1))

        at0, at1 = cot(x1 - x0, x2 - x0), cot(x0 - x1, x2 - x1)
        other0, other1 = cot(x1 - x0, x3 - x0), cot(x0 - x1, x3 - x1)
        area = (
            np.linalg.norm(np.cross(x1 - x0, x2 - x0), axis=1) + np.linalg.norm(np.cross(x1 - x0, x3 - x0), axis=1)
        ) / 2
        stiff = self.supple * self.wall.young * float(self.wall.thickness) ** 3 / 9  # E t^3 / 12 (1 - 1/4)
        rows = np.stack([at1 + other1, at0 + other0, -at0 - at1, -other0 - other1], axis=1)
        return at, rows * np.sqrt(3.0 * stiff / area)[:, None], np.linalg.norm(x1 - x0, axis=1)

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:  # noqa: ARG002
        """Close it: filled as the skin balances it, or to the pressure that is told."""
        self._gravity = np.array(model.opt.gravity)
        self._ask(self.points.copy(), self.velocities.copy(), 0.0, 1, 0.0)
        over = self.gas.pressure - self.gas.outside if self.gas.pressure is not None else self._balance()
        self._sums[6] = (self.gas.outside + over) * self.room / (GAS * self.gas.temperature(0.0))
        self.given = 0.0

    def _balance(self) -> float:
        """Pa: what a little growth all over costs, for the room that it gives."""
        little, walls = 1e-4, self._sums[4]
        self._ask(self.points * (1 + little), self.velocities.copy(), 0.0, 1, 0.0)
        return float((self._sums[4] - walls) / (3 * little * self.room))

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:  # noqa: ARG002
        """Advance it by `seconds`; returns (1, 3) N on the world."""
        parts = max(1, int(np.ceil(seconds / min(self.finest, self._bounce()) - 1e-9)))
        self._sums[:4] = 0.0
        self._ask(self.points, self.velocities, seconds / parts, parts, opening(self.gas))
        self.time += seconds
        self.given += float(self._sums[3])
        return np.array([self._sums[:3] / seconds])

    def _bounce(self) -> float:
        """s: a share of the time in which the gas would throw all of the skin back: the less room is left, the stiffer it is."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
        room = max(self.room, LEAST * area**1.5)
        return BOUNCE * float(np.sqrt(room * self.mass.sum() / self.gas.outside)) / area

    def energy(self) -> float:
        """J in walls and contacts, less what gas and air outside gave since the start."""
        return float(self._sums[4] + self._sums[5]) - self.given

    @property
    def room(self) -> float:
        """m^3 inside."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return float((a * np.cross(b, c)).sum()) / 6

    @property
    def pressure(self) -> float:
        """Pa inside."""
        return float(self._sums[6]) * GAS * self.gas.temperature(self.time) / max(self.room, 1e-9)

    def grown(self) -> Array:
        """(n,) how many times its unstretched area the wall has at each point: what colours may show."""

        def areas(x: Array) -> Array:
            a, b, c = x[self.triangles].transpose(1, 0, 2)
            return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1))

        at = self.triangles.ravel()
        return np.asarray(np.bincount(at, np.repeat(areas(self.points) / areas(self._rest), 3)) / np.bincount(at))

    def _ask(self, x: Array, v: Array, h: float, parts: int, hole: float) -> None:
        warmth = GAS * self.gas.temperature(self.time)
        advance(
            x, v, self.mass, self.triangles, self._inverse, self._matter, self.wall.young / 3, self.creased, self._edges,
            self._bends, self._gain, self._rest, self._far, self.apart, self._hard, self.wall.friction, self.wall.air, self.table,
            self._gravity, warmth, self.gas.outside, self.gas.outside * AIR / warmth, self.gas.hole_at, hole, h, parts, self._sums,
        )  # fmt: skip
