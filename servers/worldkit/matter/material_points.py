"""The law of a liquid, a sand or a snow, which an author's own class in `laws/NAME.py` derives from: material points.

Each point carries the same mass for ever; a grid of cells of two spacings carries momentum between them (`transfer`), a
constitutive law says what strain and its rate make of stress (`liquids`, `sands`, `snows`), geoms are walls (`wall_distance`).
Steps are explicit: as long as sound and viscosity allow (`Liquid.longest`), several within one question. What walls took is
returned as the mean force and torque on each body; between two questions a free body moves on by what it feels.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NoReturn, Protocol

import numpy as np

from ..errors import ProgramError
from .beforehand import MOST_NODES, check_bowl, check_container, check_points, check_positive, check_sources, check_work
from .body_motion import BodyMotion
from .first_places import Region, Source
from .touched_geoms import Geoms
from .transfer import MOST_PLANES, SLOTS, gather, scatter, turn

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
LOOK_AGAIN = 4
"""Steps after which a point looks for its walls again."""
ROOMY = 3
"""Cells of the grid beyond the points."""


class Stuff(Protocol):
    """A constitutive law; tau is Kirchhoff's stress, xx, yy, zz, xy, xz, yz."""

    @property
    def density(self) -> float:
        """kg/m^3, at rest."""

    @property
    def sound(self) -> float | None:
        """m/s, or None for what its falls ask."""

    @property
    def scatter(self) -> float:
        """Spacings by which points are off their lattice at the start."""

    @property
    def friction(self) -> float:
        """Against walls, Coulomb's."""

    def carried(self, pull: float) -> float:
        """1/s: how fast air takes the speed of what is aloft."""

    def aloft(self, crowd: Array) -> Array:
        """(n,) which points air carries, by the density on the grid, kg/m^3."""

    def fastest(self, falls: float) -> float:
        """m/s: what it reaches, which would fall so fast without air."""

    def stiffness(self, sound: float) -> tuple[float, ...]:
        """Numbers of the law, for a speed of sound, m/s."""

    def holds(self, cell: float) -> bool:
        """Whether it sticks to walls, on a grid of this side, m."""

    def longest(self, sound: float, cell: float) -> float:
        """s: the longest stable step."""

    def begins(self, count: int) -> Array:
        """(n, s) state of each point at rest."""

    def advance(self, law: Array, state: Array, c: Array, crowd: Array, tau: Array, count: int, dt: float) -> None:
        """Advance the state by dt with the slope of velocity c (n, 3, 3), 1/s, and write tau (n, 6), Pa."""

    def stored(self, law: Array, state: Array) -> Array:
        """(n,) J/m^3."""

    def room(self, state: Array) -> Array:
        """(n,) volume over that at rest; 0 where none is kept."""


class Matter:
    """A law; name, bodies and shown_by are the deriving class's. Geoms of `bodies` are its walls, of no others.

    Args:
        stuff: Liquid, Sand or Snow.
        spacing: m between points; the grid has cells of twice that, so that walls and streams want 3 spacings or more.
        begins: what is filled at the start.
        poured: sources.
        container: a body that must hold it: refused where it is open below the points that lie in it at the start.
        step: s, in place of the longest stable step.
        waits: (x, y, z) m, where what is still to come is drawn; None: in its mouth.

    Raises:
        ProgramError: there are no points, or too many, or two sources overlap.
    """

    name: str = "matter"
    bodies: Sequence[str] = ("world",)
    shown_by: str = "matter"

    def __init__(
        self,
        stuff: Stuff,
        spacing: float,
        begins: Sequence[Region] = (),
        poured: Sequence[Source] = (),
        container: str | None = None,
        step: float | None = None,
        waits: Any = None,
    ) -> None:
        check_positive(self.name, spacing=spacing, step=step)
        self.stuff, self.spacing, self.cell = stuff, spacing, 2.0 * spacing
        self._container, self._step, self._sources = container, step, tuple(poured)
        check_sources(self.name, self._sources, begins, spacing, self.bodies)
        filled = [region.points(spacing, stuff.scatter) for region in begins]
        places, when, speeds, masses, lies = [*filled], [], [], [], [*filled]
        for one in filled:
            when.append(np.full(len(one), -1.0))
            speeds.append(np.zeros((len(one), 3)))
            masses.append(np.full(len(one), stuff.density * spacing**3))
        for source in self._sources:
            at, leaves, speed = source.fed(spacing, stuff.density)
            places.append(at)
            when.append(leaves)
            speeds.append(np.broadcast_to(speed, at.shape))
            masses.append(np.full(len(at), source.mass / len(at)))
            lies.append(np.broadcast_to(np.asarray(source.at if waits is None else waits, float), at.shape))
        count = sum(map(len, places))
        check_points(self.name, count, spacing)
        order = np.argsort(np.concatenate(when), kind="stable")
        self._leaves, self._when, self._speeds, self.mass, self.points = (
            np.concatenate(parts)[order] for parts in (places, when, speeds, masses, lies)
        )
        self.points = self.points.copy()
        self.velocities, self._slope = np.zeros((count, 3)), np.zeros((count, 3, 3))
        self._state, self._tau = stuff.begins(count), np.zeros((count, 6))
        self._crowd = np.full(count, stuff.density)
        self._planes, self._walls = np.zeros((count, MOST_PLANES, 4)), np.zeros((count, MOST_PLANES), np.int64)
        self._near, self.time, self.loose = np.zeros(count, np.int64), 0.0, 0
        """Of the points, those that have left their mouths."""
        self._grid, self._seen = np.zeros((0, 4)), np.full((count, 3), np.inf)

    @property
    def radius(self) -> float:
        """m: of the grains that show it as one surface without holes."""
        return 0.75 * self.spacing

    # what the protocol asks

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Find what it may touch, how stiff it is, and how long a step may be.

        Raises:
            ProgramError: points lie in a wall, a container is open, or the steps would be too many.
        """
        self._pull, self._model = np.array(model.opt.gravity), model
        self._geoms = Geoms(model, self.bodies, 2 * self.cell)
        self._geoms.place(data)
        begun = self._when < 0
        if begun.any():
            check_container(self, data, self._geoms, begun, self._container)
        floor = min([*self._leaves[:, 2], *(data.geom_xpos[g][2] for g in self._geoms.ids)])
        high = max(float(self._leaves[:, 2].max()) - floor, self.cell)
        fastest = max((source.leaves(self.stuff.density) for source in self._sources), default=0.0)
        falls = float(np.hypot(fastest, np.sqrt(2 * np.linalg.norm(self._pull) * high)))
        self.sound = self.stuff.sound or max(7.0 * self.stuff.fastest(falls), 1.0)
        self._law = np.array(self.stuff.stiffness(self.sound))
        self.longest = self.stuff.longest(self.sound, self.cell)
        check_work(self.name, len(self.points), self.longest, self._step)
        self._air = self.stuff.carried(float(np.linalg.norm(self._pull)))
        if self._air and "world" not in self.bodies:
            raise ProgramError(f"the air that carries {self.name} is missing", self.name, 'let "world" be in `bodies`')
        self._sticks = self.stuff.holds(self.cell)
        if self._sticks and begun.any() and getattr(self.stuff, "sticks", True) is None:
            check_bowl(self, self._geoms, begun)
        self._motion = BodyMotion(model, self._geoms.bodies)

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:  # noqa: ARG002
        """Advance it by `seconds`; (k, 6) N, N m, on its bodies.

        Raises:
            ProgramError: the points fly apart.
        """
        self._geoms.place(data)
        bodies = self._motion.now(data, seconds)
        push = np.zeros((len(self.bodies), 6))
        fastest = float(np.linalg.norm(self.velocities[: self.loose], axis=1).max(initial=0.0))
        fastest = max(fastest, self._fastest()) + float(np.linalg.norm(self._pull)) * seconds
        if not np.isfinite(fastest):
            self._apart()
        limit = min(self._step or self.longest, 0.35 * self.cell / max(fastest, 1e-9))
        parts = max(1, int(np.ceil(seconds / limit - 1e-9)))
        room = self._laid(self.cell * ROOMY + 1.5 * fastest * seconds)
        before, feels = bodies[:, 3:].copy(), np.zeros(3)
        for part in range(parts):
            self._advance(seconds / parts, room, bodies, push, part % LOOK_AGAIN == 0, part * seconds / parts, feels)
            self._motion.carry(bodies, before, push, seconds * (part + 1) / parts)
        self._motion.felt = push / seconds
        felt = self._motion.felt.copy()
        if "world" in self.bodies:
            felt[list(self.bodies).index("world"), :3] += feels / seconds
        return felt

    def grows(self, first_s: float, whole_s: float) -> float:
        """How many times as many of its points move, on the mean over `whole_s` s, as over its `first_s` s: of what is poured, few."""
        starts = np.maximum(self._when, 0.0)
        first, whole = (np.maximum(until - starts, 0.0).sum() / until for until in (first_s, whole_s))
        return float(whole / max(first, 1.0))

    def energy(self) -> float:
        """J stored in strain and in the spin of each point's surroundings, and what sources have still to give."""
        here, law = slice(0, self.loose), self._law
        strain = (self.stuff.stored(law, self._state[here]) * self.mass[here]).sum() / self.stuff.density
        spin = (self.mass[here, None, None] * self._slope[here] ** 2).sum() * self.cell**2 / 8
        wait = slice(self.loose, None)
        gives = 0.5 * (self.mass[wait, None] * self._speeds[wait] ** 2).sum()
        lifts = (self.mass[wait, None] * (self.points[wait] - self._leaves[wait])).sum(axis=0) @ self._pull
        return float(strain + spin + gives + lifts)

    def volume(self) -> float:
        """m^3, as the constitutive law has it; 0 where none is kept."""
        room = self.stuff.room(self._state)
        return float((room * self.mass).sum() / self.stuff.density)

    # a step

    def _fastest(self) -> float:
        return float(np.linalg.norm(self._speeds[self.loose : self.loose + 1], axis=1).max(initial=0.0))

    def _laid(self, margin: float) -> tuple[Array, Array]:
        """Where the grid begins, (3,) m, and its nodes, (3,), for the points that are loose or come soon."""
        soon = self._leaves[self.loose :][self._when[self.loose :] < self.time + 0.05]
        here = np.concatenate([self.points[: self.loose], soon])
        if not len(here):
            here = self._leaves[:1]
        low = (np.floor((here.min(axis=0) - margin) / self.cell)) * self.cell
        shape = np.ceil((here.max(axis=0) + margin - low) / self.cell).astype(np.int64) + 1
        if not np.isfinite(shape).all() or float(shape.astype(float).prod()) > MOST_NODES:
            self._apart()
        nodes = int(shape.prod())
        if len(self._grid) < nodes:
            self._grid, self._touched = np.zeros((nodes, 4)), np.zeros(nodes, np.int64)
            self._held, self._holds = np.full(nodes, -1), np.zeros((min(nodes, 27 * len(self.points)), SLOTS, 4))
        self._geoms.sort(low, low + shape * self.cell, 2.61 * self.cell)
        return low, shape

    def _apart(self) -> NoReturn:
        here = self.points[: self.loose]
        away = here.max(axis=0) - here.min(axis=0)
        cause = f"the points of {self.name} fly apart at {self.time:.4f} s: they lie {away[0]:.3g} x {away[1]:.3g} x {away[2]:.3g} m wide"
        raise ProgramError(cause, self.name, "give it a floor to fall on, close its container, or shorten the step")

    def _advance(
        self, dt: float, room: tuple[Array, Array], bodies: Array, push: Array, look: bool, gone: float, feels: Array
    ) -> None:
        self._let_in(dt, feels)
        feels += dt * self.mass[self.loose :].sum() * self._pull  # what still waits is carried
        count = self.loose
        self.time += dt
        if not count:
            return
        if look:
            if gone:
                self._geoms.move(bodies, LOOK_AGAIN * dt)
            reach = 1.5 * self.cell
            self._geoms.near(self.points, count, reach, self._planes, self._walls, self._near, self._seen)
        mass, stuff = self.mass, self.stuff
        stuff.advance(self._law, self._state, self._slope, self._crowd, self._tau, count, dt)
        low, shape = room
        used, _ = scatter(
            self.points, self.velocities, self._slope, self._tau, count, mass, stuff.density, dt, low, shape, self.cell,
            self._grid, self._touched, self._planes, self._walls, self._near, self._held, self._holds,
        )  # fmt: skip
        if used < 0:
            self._apart()
        turn(
            low, shape, self.cell, dt, self._pull, self._grid, self._touched, used, self._held, self._holds, bodies,
            push, stuff.friction, self._sticks,
        )  # fmt: skip
        gather(
            self.points, self.velocities, self._slope, count, mass, dt, low, shape, self.cell, self._grid,
            self._touched, used, self._planes, self._walls, self._near, bodies, push, stuff.friction, self._sticks,
            self._crowd,
        )  # fmt: skip
        if self._air:
            here = slice(0, count)
            slower = self.velocities[here] * (stuff.aloft(self._crowd[here]) * (1 - np.exp(-self._air * dt)))[:, None]
            self.velocities[here] -= slower
            feels += self.mass[here] @ slower

    def _let_in(self, dt: float, feels: Array) -> None:
        """Let those go whose time has come, as far on their way as they are late."""
        upto = int(np.searchsorted(self._when, self.time + dt, side="right"))
        if upto == self.loose:
            return
        new = slice(self.loose, upto)
        late = np.clip(self.time + dt - self._when[new], 0.0, dt)[:, None]
        self.points[new] = self._leaves[new] + late * self._speeds[new]
        self.velocities[new] = self._speeds[new]
        self._near[new], self._seen[new] = 0, np.inf
        self._crowd[new] = self.stuff.density
        feels -= (self.mass[new, None] * self._speeds[new]).sum(axis=0)
        self.loose = upto
