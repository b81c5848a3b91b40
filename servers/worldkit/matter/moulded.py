"""A soft solid in a shape of its own, as an author's law: what is squeezed, dented, kneaded, and its skin, which is drawn.

    class Sponge(Moulded):
        name, bodies, shown_by = "sponge", ("jaw", "table"), "sponge"

        def __init__(self, foam_density, foam_young):
            super().__init__(foam(foam_density, foam_young), sculpt.box((0.09, 0.07, 0.06), rounded=0.008), (0, 0, 0.03), 0.01)

Explicit steps of a lattice of hexahedra (`lattices`, `solid_kernel`); geoms of `bodies` are its walls, of no others, and it does not feel
itself where it folds. What walls took is returned as the mean force and torque on each body.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ProgramError
from ..sculpt.marching import MOST_CELLS, evaluated, surface
from ..sculpt.signed import Shape
from .beforehand import MOST_POINTS, check_positive, check_work
from .body_motion import BodyMotion
from .lattices import filled, ridden
from .soft_solids import Solid
from .solid_kernel import moved, pulled, touched
from .touched_geoms import Geoms
from .transfer import MOST_PLANES

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
WALL, WALL_YIELDING = 5.0, 600.0
"""How stiff a wall is to it: Pa for each cell's depth, in units of what the solid is where it is pressed most; of its yield stress at most,
as nothing presses much harder on what yields."""
COURANT = 0.35
STILL = 1e-3
"""m/s: a body that goes slower than this wakes nothing, until it has gone `CREPT` of a cell."""
CREPT = 1e-3
SLOWEST, CALM, FADES = 2e-4, 20, 0.1
"""Of the speed of sound in it: slower than this for so many questions, and borne, it lies still; how much a question's forces count for
their mean."""
BORNE = 0.5
"""The share of its weight by which what bears it may be off."""
LOOK_AGAIN = 8
"""Steps after which a node looks for its walls again."""


class Moulded:
    """A law; name, bodies and shown_by are the deriving class's.

    Args:
        stuff: `Solid`, `foam()` or `clay()`.
        shape: of `worldkit.sculpt`, in its own frame, m.
        at: (x, y, z) m, where that frame's origin stands in the world.
        cell: m, side of its cells: four and more across what is thinnest.
        skin: what is drawn around it, in the same frame, where it is finer (pores, a rough surface); None: the shape.
        grain: m between the corners of the skin; None: a third of a cell.
        paint: gives the skin's corners (n, 3) m, own frame, and their depths within `shape`, (n,) m, colours (n, 3) sRGB; None: the look's.

    Raises:
        ProgramError: no cell fits, or points and skin are too many.
    """

    name: str = "moulded"
    bodies: Sequence[str] = ("world",)
    shown_by: str = "moulded"

    def __init__(
        self,
        stuff: Solid,
        shape: Shape,
        at: Any,
        cell: float,
        *,
        skin: Shape | None = None,
        grain: float | None = None,
        paint: Callable[[Array, Array], Array] | None = None,
    ) -> None:
        check_positive(self.name, cell=cell, grain=grain)
        place, drawn = np.asarray(at, float), skin or shape
        self.stuff, self._lattice = stuff, filled(shape, cell, self.name)
        cells = max(8, int(np.ceil(float(drawn.size.max()) / (grain or cell / 3))))
        if cells > MOST_CELLS:
            cause = f"the skin of {self.name} would have {cells} cells along its longest side, more than {MOST_CELLS}"
            raise ProgramError(cause, self.name, f"give it a `grain` of {float(drawn.size.max()) / MOST_CELLS:.2g} m")
        made = surface(drawn, cells)
        self.triangles, corners = np.asarray(made.faces, int), np.asarray(made.vertices, float)
        most = MOST_POINTS - len(self._lattice.nodes)
        if len(corners) > most:
            cause = f"the skin of {self.name} has {len(corners)} corners, its lattice {len(self._lattice.nodes)}: more than {MOST_POINTS}"
            wider = (grain or cell / 3) * (len(corners) / max(most, 1)) ** 0.5
            raise ProgramError(cause, self.name, f"give it a `grain` of {wider:.2g} m")
        self._rides, self._share = ridden(self._lattice, corners)
        self._x, self._v = self._lattice.nodes + place, np.zeros_like(self._lattice.nodes)
        weigh = np.repeat(stuff.density * self._lattice.room.sum(axis=1) / 8, 8)
        self._mass = np.bincount(self._lattice.cells.ravel(), weigh, len(self._x))
        self._kept = np.zeros((*self._lattice.room.shape, 6))
        self._kept[..., :3] = 1.0
        self._stored, self._force = 0.0, np.zeros_like(self._x)
        self._asked = self._reckoned = self._calm = 0
        """Questions: in all, those that were reckoned, and how many of the last it was calm in."""
        self._lay: Array | None = None
        """Where the geoms were when it came to lie still."""
        self.mass = np.concatenate([np.zeros(len(corners)), self._mass])
        if paint is not None:
            told = np.clip(np.asarray(paint(corners, -evaluated(shape, corners)), float), 0.0, 1.0)
            self.colours = np.concatenate([told, np.tile(told.mean(axis=0), (len(self._x), 1))])
        self._tell()

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Find what it may touch, and how long a step may be.

        Raises:
            ProgramError: the steps would be too many.
        """
        lattice = self._lattice
        self._pull, self._geoms = np.array(model.opt.gravity), Geoms(model, self.bodies, 2 * lattice.cell)
        self._motion = BodyMotion(model, self._geoms.bodies)
        lam, mu = self.stuff.lame
        self._sound, self._mean = float(np.sqrt((lam + 2 * mu) / self.stuff.density)), np.zeros((len(self.bodies), 6))
        hard = min(WALL * self.stuff.hardest, WALL_YIELDING * (self.stuff.yields or np.inf))
        self._stiff = hard / lattice.cell
        lightest = float((self._mass[lattice.outer] / lattice.area).min())
        self.longest = min(
            COURANT * lattice.cell * float(np.sqrt(self.stuff.density / self.stuff.hardest)),
            float(np.sqrt(2 * lightest / self._stiff)),
            0.08
            * self.stuff.density
            * (self.stuff.down_to * lattice.cell) ** 2
            / max(self.stuff.damping * self.stuff.young, 1e-12),
        )
        check_work(self.name, 2 * len(lattice.cells), self.longest, None)  # a cell takes as long as two points
        reach = np.linalg.norm(data.geom_xpos - data.xipos[model.geom_bodyid], axis=1) + model.geom_rbound
        self._wide = [float(reach[model.geom_bodyid == body].max(initial=0.0)) for body in self._geoms.bodies]
        many = len(lattice.outer)
        self._planes, self._walls = np.zeros((many, MOST_PLANES, 4)), np.zeros((many, MOST_PLANES), np.int64)
        self._near, self._held = np.zeros(many, np.int64), np.full((many, 4), -1.0)

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:  # noqa: ARG002
        """Advance it by `seconds`; (k, 6) N, N m, on its bodies.

        Raises:
            ProgramError: it tears apart.
        """
        lattice, stuff, (lam, mu) = self._lattice, self.stuff, self.stuff.lame
        self._geoms.place(data)
        bodies, push = self._motion.now(data, seconds), np.zeros((len(self.bodies), 6))
        self._asked += 1
        if self._rests(bodies, seconds):
            return self._lies()
        self._reckoned, self._lay = self._reckoned + 1, None
        before, parts = bodies[:, 3:].copy(), max(1, int(np.ceil(seconds / self.longest - 1e-9)))
        h, eta = seconds / parts, stuff.damping * stuff.young
        left = float(np.exp(-h / stuff.creeps)) if stuff.creeps else 1.0
        for part in range(parts):
            if part % LOOK_AGAIN == 0:
                if part:
                    self._geoms.move(bodies, LOOK_AGAIN * h)
                self._look()
            self._stored = pulled(
                self._x, self._v, lattice.cells, lattice.slopes, lattice.room, self._kept, lam, mu, stuff.yields or 0.0, left,
                eta, self._force,
            )  # fmt: skip
            self._stored += touched(
                self._x, self._v, self._mass, lattice.outer, lattice.area, self._planes, self._walls, self._near, self._held,
                bodies, self._stiff, stuff.wall_friction, h, self._force, push,
            )  # fmt: skip
            moved(self._x, self._v, self._mass, self._pull, self._force, h)
            self._motion.carry(bodies, before, push, (part + 1) * h)
        if not np.isfinite(self._x).all() or np.ptp(self._x, axis=0).max() > 20 * np.ptp(lattice.nodes, axis=0).max():
            cause = f"the cells of {self.name} turn inside out"
            raise ProgramError(
                cause, self.name, "squeeze it less or more slowly, or tell its Solid a smaller `down_to`"
            )
        self._motion.felt = push / seconds
        self._calm = self._calm + 1 if float(np.abs(self._v).max()) < SLOWEST * self._sound else 0
        self._mean += FADES * (self._motion.felt - self._mean)
        self._tell()
        return self._motion.felt.copy()

    def grows(self, first_s: float, whole_s: float) -> float:  # noqa: ARG002
        """How many times as much it costs, at most, as so far: as if it never lay still again."""
        return max(1.0, self._asked / max(self._reckoned, 1))

    def energy(self) -> float:
        """J stored in strain and in its walls."""
        return float(self._stored)

    def volume(self) -> float:
        """m^3 of what yields; 0 of foam, which keeps none."""
        if not self.stuff.yields:
            return 0.0
        f = np.einsum("cka,cqkb->cqab", self._x[self._lattice.cells], self._lattice.slopes)
        return float((np.linalg.det(f) * self._lattice.room).sum())

    def _rests(self, bodies: Array, seconds: float) -> bool:
        """Whether it lies still on what bears it, and nothing near moves, or has crept on since: then nothing is reckoned."""
        weight = self._mass.sum() * self._pull
        off = float(np.linalg.norm(self._mean[:, :3].sum(axis=0) - weight))
        if self._calm < CALM or not off < BORNE * float(np.linalg.norm(weight)):
            return False
        low, high, near = self._x.min(axis=0), self._x.max(axis=0), []
        for row, body in enumerate(bodies):
            speed = float(np.linalg.norm(body[3:6]) + np.linalg.norm(body[6:]) * self._wide[row])
            away = np.linalg.norm(np.maximum(np.maximum(low - body[:3], body[:3] - high), 0.0)) - self._wide[row]
            if away < 2 * self._lattice.cell + speed * seconds:
                near.append(row)
                if speed > STILL:
                    return False
        self._lay = self._geoms.poses if self._lay is None else self._lay
        return self._geoms.gone(self._lay, near) < CREPT * self._lattice.cell

    def _lies(self) -> Array:
        """What it gives its bodies while it lies still: what it gave them on the mean, so corrected that it bears its weight."""
        weight = self._mass.sum() * self._pull
        bears = int(np.abs(self._mean[:, :3]).sum(axis=1).argmax())
        self._motion.felt = self._mean.copy()
        self._motion.felt[bears, :3] += weight - self._mean[:, :3].sum(axis=0)
        if self._v.any():
            self._v[:] = 0.0
            self._tell()
        return self._motion.felt.copy()

    def _look(self) -> None:
        """Find the walls near the outer nodes."""
        here = np.ascontiguousarray(self._x[self._lattice.outer])
        margin = self._lattice.cell
        self._geoms.sort(here.min(axis=0) - 2 * margin, here.max(axis=0) + 2 * margin, 2.61 * margin)
        self._geoms.near(here, len(here), margin, self._planes, self._walls, self._near, np.full(here.shape, np.inf))

    def _tell(self) -> None:
        rides, share = self._rides, self._share[..., None]
        self.points = np.concatenate([(share * self._x[rides]).sum(axis=1), self._x])
        self.velocities = np.concatenate([(share * self._v[rides]).sum(axis=1), self._v])
