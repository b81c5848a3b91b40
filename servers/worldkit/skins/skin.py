"""The law of a closed skin with gas inside, which an author's own class in `laws/NAME.py` derives from.

A step is implicit (backward Euler): it ends where inertia and everything stored are least together,

    1 / (2 h^2) |x - (x0 + h v0 + h^2 g)|^2_m + sheet + hinges - n R T ln(V) + p_out V + contact,

found by Newton's method with a search along each direction. So a wall of real plastic (2.5 GPa, 0.3 mm) is stepped by
milliseconds with its own stiffness, nothing softened, where an explicit step would take a microsecond. The price: what vibrates within a few steps dies
away (shorter `longest`, livelier). It never makes energy.

Gas is one pressure, p = n R T / V, with that of steam where it is wet, its temperature Newton's: T = T_around + (T_warm - T_around) exp(-t / takes). Its weight, its
buoyancy and that of a liquid are left out. By a hole it leaves as through an orifice, C A sqrt(2 p / rho), and its jet pushes back. Walls do not feel each other: a bottle may cave in, not be crumpled flat. A flat mesh of
triangles is stiffer against folds finer than a few of its sides.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ProgramError
from ..naming import names
from . import leaking, met_geoms
from .banded import Banded
from .gas_and_wall import GAS, Gas, Wall
from .pressed_on import Met, lightness, turned
from .thin_elements import Hinges, Sheet, curved

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
TRIES, CREEPS_ON = 8, 2e-3
"""At most so many times it is tried how a free body goes on; m/s, rad/s: off by less, it is well known."""
MET_FREE, MET = 0.65, 0.5
"""After this share of its way in a step a body is met. At one half of a way that is known, springing off keeps what was stored, or
gains a little; after all of it, it loses a tenth of the speed at steps of 4 ms."""
SEARCHES, STEPS, CLOSE = 14, 10, 1e-3
"""Halvings of a direction; directions of a step; the share of a triangle's side within which it has ended."""


class Skin:
    """A law; name, bodies and shown_by are the deriving class's.

    Args:
        shape: points (n, 3), m, world frame, at the start, and triangles (f, 3) of a closed surface.
        wall: what it is of.
        gas: what is inside.
        pinned: whole numbers: points that stay where they are; what holds them is `world`, among its bodies then.
        longest: s; the time from one question to the next is cut in equal steps no longer than this.

    Raises:
        ProgramError: the surface is not closed, a hole is not at it, or `world` is missing among the bodies.
    """

    name: str = "skin"
    bodies: Sequence[str] = ("world",)
    shown_by: str = "skin"

    def __init__(
        self, shape: tuple[Any, Any], wall: Wall, gas: Gas, pinned: Sequence[int] = (), longest: float = 0.004
    ) -> None:
        self.points, self.triangles = np.array(shape[0], float), np.asarray(shape[1], int)
        self.wall, self.gas, self._longest, self._pinned = wall, gas, longest, np.array(pinned, int)
        young, poisson = wall.young, 0.5 if wall.rubber else wall.poisson
        thickness = np.broadcast_to(np.asarray(wall.thickness, float), len(self.triangles))
        if (self._pinned.size or wall.air or gas.hole) and "world" not in self.bodies:
            raise ProgramError(
                f"what holds, brakes or is blown at by {self.name} is missing", self.name, 'let "world" be in `bodies`'
            )
        leaking.held(gas, self.triangles, self.name)
        unstretched = self.points / wall.stretched
        try:
            self.hinges = Hinges(unstretched, self.triangles, young, poisson, thickness, wall.yields)
        except ValueError as error:
            raise ProgramError(
                f"the skin {self.name} is not closed: {error}", self.name, "close it: `revolved`, `ball`"
            ) from error
        self.sheet = Sheet(unstretched, self.triangles, young, poisson, thickness, wall.rubber)
        count = len(self.points)
        at = self.triangles.ravel()
        self.mass = np.bincount(at, np.repeat(self.sheet.matter * wall.density / 3, 3), minlength=count)
        self._hard = wall.hard * np.bincount(at, np.repeat(self.sheet.area / 3, 3), minlength=count)
        self.velocities, self.time, self.given, self._pressed = np.zeros((count, 3)), 0.0, 0.0, 0.0
        self._free = ~np.isin(np.arange(count), self._pinned)
        self._band = Banded(count, [np.arange(count)[:, None], self.triangles, self.hinges.at])
        self._side = float(np.sqrt(self.sheet.area.mean()))
        self.moles: float | None = None
        """Of the gas, once it is closed."""

    # what the protocol asks

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:  # noqa: ARG002
        """Find what it may touch."""
        self._pull = np.array(model.opt.gravity)
        known = names(model, "body", model.nbody)
        self._bodies = [known.index(body) for body in self.bodies]
        self._moves, self._asked = np.zeros((len(self._bodies), 6)), 0.0
        self._felt = np.zeros((len(self._bodies), 6))
        self._light = np.array([lightness(model, body) for body in self._bodies])
        self._geoms = [(row, geom) for row, body in enumerate(self._bodies) for geom in met_geoms.of_body(model, body)]

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:
        """Advance it by `seconds`, and return (k, 6) N, N m, on its bodies.

        A free body goes on meanwhile as it is pushed by what is returned: found by trying, or a body that is asked about seldom would
        be pushed from where it no longer is, and gain by it.
        """
        others, kept, tried = self._follow(model, data), self._state(), 0
        guess, over, before = self._felt, 1.0, None
        while True:
            # Its mean speed: with one at each part, what it is given in all would not be what it is given in each.
            self._goes = self._moves + (others + turned(guess)) * self._light * (seconds + model.opt.timestep) / 2
            found = self._advanced(model, data, seconds)
            off, tried = turned(found - guess) * self._light, tried + 1
            if tried == TRIES or np.abs(off).max() * seconds < CREEPS_ON:
                break
            if before is not None and (change := off - before).any():  # Aitken's, of what converges as one number does
                over = float(np.clip(-over * (before * change).sum() / (change * change).sum(), 0.02, 1.0))
            guess, before = guess + over * (found - guess), off
            self._restore(kept)
        self._felt, self._asked = found, seconds
        return found

    def _advanced(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:
        parts = max(1, int(np.ceil(seconds / self._longest - 1e-9)))
        return np.asarray(
            sum(self._advance(model, data, seconds / parts, n * seconds / parts) for n in range(parts)) / parts
        )

    def energy(self) -> float:
        """J in its walls and where it is pressed on bodies, less what gas and air outside gave since the start: heat too comes
        from that store."""
        return self._walls(self.points) + self._pressed - self.given

    def colours_by(self, low: Any, high: Any, strain: float) -> Array:
        """(n, 3) sRGB from `low` where the wall is unstretched to `high` where its area grew by `strain`."""
        c = 2 * self.sheet.strain(self.points) + (1, 1, 0)
        grown = np.sqrt(np.maximum(c[:, 0] * c[:, 1] - c[:, 2] ** 2, 0)) - 1
        at = self.triangles.ravel()
        mean = np.bincount(at, np.repeat(grown, 3)) / np.bincount(at)
        share = np.clip(mean / strain, 0, 1)[:, None]
        return np.asarray(np.asarray(low) * (1 - share) + np.asarray(high) * share)

    # the gas

    @property
    def room(self) -> float:
        """m^3 inside."""
        return self._room(self.points)

    @property
    def pressure(self) -> float:
        """Pa inside."""
        return self._pressure(self.room)

    def _room(self, x: Array) -> float:
        a, b, c = x[self.triangles].transpose(1, 0, 2)
        return float((a * np.cross(b, c)).sum()) / 6

    def _grows(self, x: Array) -> Array:
        """(n, 3) m^2: how the room grows with each point."""
        a, b, c = x[self.triangles].transpose(1, 0, 2)
        return self._at_points(np.cross(b - a, c - a)[:, None] / 6 * np.ones((1, 3, 1)), self.triangles)

    def _pressure(self, room: float) -> float:
        if self.moles is None:
            return self.gas.outside
        dry = self.moles * GAS * self.gas.temperature(self.time) / max(room - self.gas.liquid, 1e-9)
        return dry + self.gas.steam(self.time)

    def _close(self) -> None:
        """Close it, when it is time."""
        if self.moles is not None or self.time < self.gas.closes - 1e-9:
            return
        begins = self.gas.pressure
        if begins is None:  # virtual work of growing all over: what the walls pull, the gas pushes
            pulls = float((self._pulls(self.points) * self.points).sum())
            begins = self.gas.outside + pulls / (3 * self.room)
        self.moles = (
            (begins - self.gas.steam(self.time))
            * (self.room - self.gas.liquid)
            / (GAS * self.gas.temperature(self.time))
        )

    # the walls

    def _at_points(self, each: Array, at: Array) -> Array:
        """(n, 3): the sum of what elements give their corners."""
        where = at.ravel()
        flat = each.reshape(-1, 3)
        return np.stack([np.bincount(where, flat[:, axis], minlength=len(self.points)) for axis in range(3)], axis=1)

    def _walls(self, x: Array) -> float:
        bent = self.hinges.bent(self.hinges.angle(x))
        return float(
            (self.sheet.matter * self.sheet.dense(self.sheet.strain(x))).sum() + (self.hinges.stiff * bent**2).sum() / 2
        )

    def _pulls(self, x: Array) -> Array:
        """(n, 3) N: the slope of what is stored in the walls."""
        bend = self.hinges.stiff * self.hinges.bent(self.hinges.angle(x))
        slope, _ = self.sheet.spread(x, self.sheet.stress(self.sheet.strain(x)), None)
        return self._at_points(slope, self.triangles) + self._at_points(
            bend[:, None, None] * self.hinges.slope(x), self.hinges.at
        )

    # a step

    def _follow(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> Array:
        """Note how the bodies move now, (k, 6) rad/s and m/s; returns what else acts on them, (k, 6) N m and N, by how they moved since."""
        import mujoco

        before, self._moves = self._moves, np.zeros((len(self._bodies), 6))
        for row, body in enumerate(self._bodies):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, self._moves[row], 0)
        if not self._asked:
            return np.zeros_like(before)
        known = self._light > 0
        gained = (self._moves - before) / self._asked
        return np.where(known, gained / np.where(known, self._light, 1.0), 0.0) - turned(self._felt) * known

    def _state(self) -> tuple[Any, ...]:
        """All that a step changes."""
        return self.points, self.velocities, self.time, self.given, self._pressed, self.moles, self.hinges.rest

    def _restore(self, state: tuple[Any, ...]) -> None:
        self.points, self.velocities, self.time, self.given, self._pressed, self.moles, self.hinges.rest = state

    def _advance(self, model: "mujoco.MjModel", data: "mujoco.MjData", h: float, gone: float) -> Array:
        """A step of `h` seconds, `gone` seconds after what `data` shows; returns (k, 6) N, N m."""
        self._close()
        room, over = self.room, self.pressure - self.gas.outside
        self.time += h
        task = _Step(self, model, data, h, gone)
        x = self.points + h * self.velocities * self._free[:, None]
        for _ in range(STEPS):
            x, moved = task.nearer(x)
            if moved < CLOSE * self._side:
                break
        self.velocities, wrench = task.ends(x)
        self.given += float((task.jet * (x - self.points)).sum())  # the jet's push is the gas's work, too
        self._pressed = sum(met.left(x) for met in task.met)
        self.points = x
        if self.moles is not None:
            overs, dry = (over, self.pressure - self.gas.outside), self.pressure - self.gas.steam(self.time)
            self.moles -= leaking.lost(self.gas, overs, dry, self.moles, self.time, h)
        self.given += (over + self.pressure - self.gas.outside) / 2 * (self.room - room)
        self.hinges.flow(x)
        return wrench


class _Step:
    """What one step of `h` seconds makes least, with bodies that have gone on for `gone` seconds since `data`."""

    def __init__(self, skin: Skin, model: "mujoco.MjModel", data: "mujoco.MjData", h: float, gone: float) -> None:
        self.skin, self.h, self.x0 = skin, h, skin.points
        self.mass = skin.mass[:, None]
        over = 0.0 if skin.moles is None else skin.pressure - skin.gas.outside
        self.jet = leaking.jet(skin.gas, skin.points, skin.triangles, over)
        self.pull = skin._pull + self.jet / self.mass
        self.aim = self.x0 + h * skin.velocities + h * h * self.pull
        self.strain, self.angle = skin.sheet.strain(self.x0), skin.hinges.angle(self.x0)
        self.thick = skin.wall.damping / h
        self.tough = skin.sheet.stiff(self.strain)
        self.room, self.warmth, self.outside = skin.room, 0.0, skin.gas.outside - skin.gas.steam(skin.time)
        if skin.moles is not None:
            self.warmth = skin.moles * GAS * skin.gas.temperature(skin.time)
        self.met = [
            Met(
                row,
                geom,
                skin._hard,
                skin.wall.friction,
                self.x0,
                model,
                data,
                h,
                skin._goes[row],
                gone,
                MET_FREE if skin._light[row].any() else MET,
            )
            for row, geom in skin._geoms
        ]
        self.middles = data.xipos[skin._bodies]
        self.now: float | None = None  # its value where the search stands
        self.bold = True  # with what may push uphill, until it does

    def value(self, x: Array) -> float:
        """J; infinite where there is no room left for the gas."""
        skin, h = self.skin, self.h
        room = skin._room(x)
        if room <= skin.gas.liquid:
            return np.inf
        total = skin._walls(x) + sum(met.value(x) for met in self.met)
        total += float((self.mass * (x - self.aim) ** 2).sum()) / (2 * h * h)
        total += skin.wall.air / (2 * h) * float((self.mass * (x - self.x0) ** 2).sum())
        if self.thick:
            change = skin.sheet.strain(x) - self.strain
            inside = ((self.tough @ change[:, :, None])[:, :, 0] * change).sum(axis=1)
            turned = skin.hinges.angle(x) - self.angle
            total += self.thick / 2 * float((skin.sheet.matter * inside).sum() + (skin.hinges.stiff * turned**2).sum())
        if self.warmth:
            free = skin.gas.liquid
            total += self.outside * (room - self.room) - self.warmth * np.log((room - free) / (self.room - free))
        return float(total)

    def slopes(self, x: Array, stiff: bool, bold: bool = False) -> "tuple[Array, list[Array], Array, float]":
        """The slope (n, 3) N of all but inertia, blocks of the stiffness, how the room grows, and by how much more that pushes back."""
        skin, sheet, hinges, h = self.skin, self.skin.sheet, self.skin.hinges, self.h
        strain, angle, by = sheet.strain(x), hinges.angle(x), hinges.slope(x)
        stress, bend, tough = sheet.stress(strain), hinges.stiff * hinges.bent(angle), None
        if self.thick:
            stress = stress + self.thick * (self.tough @ (strain - self.strain)[:, :, None])[:, :, 0]
            bend = bend + self.thick * hinges.stiff * (angle - self.angle)
        if stiff:
            tough = sheet.stiff(strain) + self.thick * self.tough
        pulls, full = sheet.spread(x, stress, tough, -np.inf if bold else 0.0)
        slope = skin._at_points(pulls, sheet.at) + skin._at_points(bend[:, None, None] * by, hinges.at)
        slope += self.mass * skin.wall.air / h * (x - self.x0)
        grows, stiffer = skin._grows(x), 0.0
        if self.warmth:
            pressure = self.warmth / (skin._room(x) - skin.gas.liquid)
            slope += (self.outside - pressure) * grows
            stiffer = pressure**2 / self.warmth
            if full is not None and bold:
                full = full + (self.outside - pressure) * curved(x[skin.triangles])
        each = np.zeros((len(x), 3, 3))
        for met in self.met:
            met.add(x, slope, each)
        if full is None:
            return slope, [], grows, stiffer
        each[:, [0, 1, 2], [0, 1, 2]] += self.mass * (1 / h**2 + skin.wall.air / h)
        flat = by.reshape(len(by), 12)
        bends = ((1 + self.thick) * hinges.stiff)[:, None, None] * flat[:, :, None] * flat[:, None]
        return slope, [each, full, bends], grows, stiffer

    def nearer(self, x: Array) -> tuple[Array, float]:
        """Points nearer to where the step ends, and the m that the farthest of them wanted to go."""
        skin = self.skin
        held, factor = skin._pinned, None
        while factor is None:
            slope, blocks, grows, stiffer = self.slopes(x, stiff=True, bold=self.bold)
            slope = slope + self.mass / self.h**2 * (x - self.aim)
            if held.size:
                slope[held], grows[held] = 0.0, 0.0
                blocks[0][held] += 1e6 * float(blocks[2].max() + blocks[1].max()) * np.eye(3)
            try:
                factor = skin._band.factored(blocks)
            except np.linalg.LinAlgError:
                if not self.bold:
                    raise
                self.bold = False
        found = skin._band.solved(factor, np.stack([slope, grows], axis=-1))
        plain, puffed = found[..., 0], found[..., 1]
        way = puffed * (stiffer * (grows * plain).sum() / (1 + stiffer * (grows * puffed).sum())) - plain
        way[held] = 0.0
        wanted, down, now = (
            float(np.abs(way).max()),
            float((slope * way).sum()),
            self.value(x) if self.now is None else self.now,
        )
        share = 1.0
        for _ in range(SEARCHES):
            there = self.value(x + share * way)
            if there <= now + 1e-4 * share * down + 1e-14 * abs(now):
                self.now = there
                return x + share * way, wanted
            share /= 2
        return x, 0.0

    def ends(self, x: Array) -> tuple[Array, Array]:
        """Velocities (n, 3), m/s, at the end, and (k, 6) N, N m, on the bodies."""
        skin, h = self.skin, self.h
        speed = (x - self.x0) / h
        slope, _, _, _ = self.slopes(x, stiff=False)
        lacks = self.mass * ((speed - skin.velocities) / h - self.pull) + slope
        wrench = np.zeros((len(skin.bodies), 6))
        for met in self.met:
            push = np.zeros_like(x)
            met.add(x, push, None)
            self._act(wrench, met.row, x, push)
        if "world" in skin.bodies:
            world = list(skin.bodies).index("world")
            self._act(wrench, world, x, self.mass * skin.wall.air * speed - self.jet)
            self._act(wrench, world, x[skin._pinned], -lacks[skin._pinned])
        free = skin._free
        # What the search left over is nobody's push: momentum is kept to the last digit.
        speed[free] -= h * lacks[free].sum(axis=0) / skin.mass[free].sum()
        return speed, wrench

    def _act(self, wrench: Array, row: int, at: Array, force: Array) -> None:
        wrench[row, :3] += force.sum(axis=0)
        wrench[row, 3:] += np.cross(at - self.middles[row], force).sum(axis=0)
