"""A liquid that is stirred, as an author's law: it turns in its vessel, falls in the middle, and carries marks and colours along.

    class Water(Stirred):
        name, bodies, shown_by = "water", ("spoon", "world"), "water"

        def __init__(self, water_density, water_level):
            glass = Vessel([(0, 0.01), (0.035, 0.01), (0.0375, 0.012), (0.041, 0.104)])
            super().__init__(glass, water_level, water_density)

Depth-averaged flow with a free surface (`swirl_kernel`): of each column the depth and one velocity. Bodies of the law are tools and floats: they
take the water along where they are in it, feel the opposite, and are borne by what they displace at the surface as it lies. The vessel
stands still: what no body is given, `world` is. What two dimensions do not know: waves on water deeper than a third of its width (they run at sqrt(g h)
here), the flow across a turning liquid's bottom (only its braking, Ekman's), overturning, drops.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ProgramError
from .beforehand import MOST_POINTS, check_positive
from .body_motion import BodyMotion
from .stirred_tools import Tools
from .stirred_vessels import Vessel, over
from .swirl_kernel import advanced, carried, centred, dyed, read
from .swirl_marks import AROUND, RINGS, Marks, body
from .tool_samples import Samples

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
CELLS, SPOKES = 24, 48
COURANT = 0.7
EDDY = 0.06
"""Viscosity of eddies that the grid does not see, in radii times what the flow is off its mean way round."""
SEEN_S = 0.008
"""s: what is drawn is told anew so often, at most."""
DRAINS = 0.6
"""A hole's coefficient of discharge."""


class Stirred(Tools):
    """A law; name, bodies and shown_by are the deriving class's, `world` among its bodies.

    Args:
        vessel: the inside of what it stands in.
        level: m, height of its surface at rest, world frame.
        density: kg/m^3.
        viscosity: Pa s.
        spin: rad/s, with which all of it turns at the start.
        rough: coefficient of friction at walls and floor, of a turbulent flow.
        calms: s, within which its slowest sloshing falls to 1/e, as breaking and foam do to steep waves; None: only friction does.
        drain: (x, y, radius) m, a hole in the floor, world frame.
        foam, motes: how many marks it carries on its surface and within.
        mark: m, how wide each is; None: a thirtieth of the vessel's radius.
        trail: s, how much of its way is drawn behind each.
        foam_colour, mote_colour: sRGB of 0 to 1.
        dye: gives places (n, 2) m colours (n, 3) sRGB at the start, which the liquid carries along and mixes; seen where its look is not clear.

    Raises:
        ProgramError: the level is not within the vessel, the drain not in its floor, `world` is missing.
    """

    name: str = "stirred"
    bodies: Sequence[str] = ("world",)
    shown_by: str = "stirred"

    def __init__(
        self,
        vessel: Vessel,
        level: float,
        density: float = 998.0,
        viscosity: float = 1e-3,
        *,
        spin: float = 0.0,
        rough: float = 0.0025,
        calms: float | None = 0.3,
        drain: tuple[float, float, float] | None = None,
        foam: int = 70,
        motes: int = 40,
        mark: float | None = None,
        trail: float = 0.12,
        foam_colour: tuple[float, float, float] = (0.95, 0.97, 0.98),
        mote_colour: tuple[float, float, float] = (0.45, 0.68, 0.85),
        dye: Callable[[Array], Array] | None = None,
    ) -> None:
        check_positive(self.name, density=density, viscosity=viscosity, trail=trail, mark=mark, calms=calms)
        if "world" not in self.bodies:
            raise ProgramError(f"what holds {self.name} is missing", self.name, 'let "world" be in `bodies`')
        self.vessel, self.level, self.density, self._rough = vessel, float(level), float(density), float(rough)
        self._thin = viscosity / density
        rows, columns, fine_rows, fine_columns = CELLS, SPOKES, RINGS, AROUND
        if vessel.sides is not None:
            x, y = vessel.sides
            each, fine = np.sqrt(x * y / (CELLS * SPOKES)), np.sqrt(x * y / (RINGS * AROUND))
            rows, columns = max(6, round(x / each)), max(6, round(y / each))
            fine_rows, fine_columns = max(8, round(x / fine)), max(8, round(y / fine))
        self.grid, shown = over(vessel, level, rows, columns), over(vessel, level, fine_rows, fine_columns)
        slosh = 1.841 / self.grid.reach[0] if self.grid.round else np.pi / 2 / max(self.grid.reach)
        self._still = 0.0 if calms is None else 2.0 / (slosh**2 * calms)
        self._x, self._y = self.grid.middles()
        far = np.hypot(self._x - self.grid.middle[0], self._y - self.grid.middle[1])
        self.bed = np.minimum(vessel.bed(far), 0.75 * (level - vessel.floor))
        self.depth = level - vessel.floor - self.bed
        self.u, self.v = np.zeros((rows + 1, columns)), np.zeros((rows, columns))
        self._spun(spin)
        self._old = np.zeros_like(self.u), np.zeros_like(self.v)
        self._drain, self.drained = self._hole(drain), 0.0
        self._left = np.zeros_like(self.depth)
        self._body = body(vessel, shown)
        self._shown, self._fine = shown, shown.middles()
        small = mark or 0.033 * min(self.grid.reach)
        self._marks = Marks(
            self._strewn(foam + motes),
            np.where(np.arange(foam + motes) < foam, 1.0, _low(np.arange(foam + motes) - foam)),
            small,
            trail,
        )
        corners = len(self._body.corners(np.full(len(self._body.places), level), self._wall_floor()))
        self._counts = corners, 3 * len(self._marks.way) * (foam + motes)
        if (count := sum(self._counts) + self.depth.size + 1) > MOST_POINTS:
            raise ProgramError(
                f"{self.name} has {count} points, more than {MOST_POINTS}", self.name, "give it fewer marks"
            )
        self.triangles = np.concatenate([self._body.triangles, self._marks.triangles + corners])
        hues = np.repeat([foam_colour, mote_colour], [foam, motes], axis=0)
        self._hues, self._dye = np.repeat(hues, 3 * len(self._marks.way), axis=0), None
        if dye is not None:
            places = np.column_stack([part.ravel() for part in self._fine])
            told = np.clip(np.asarray(dye(places), float), 0.0, 1.0)
            self._dye = np.broadcast_to(told, (len(places), 3)).reshape(*self._fine[0].shape, 3).copy()
        self.time, self._drawn_at, self._drawn = 0.0, -1.0, np.zeros((0, 3))
        self._ways = np.zeros((*self.depth.shape, 2))
        centred(self.u, self.v, self.grid.round, self.grid.turn, self._ways)
        self._rises, self._outflow = np.zeros_like(self.depth), np.zeros(2)
        self._tell()

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Find its tools, and how long a step may be."""
        self._pull = np.array(model.opt.gravity)
        self._gravity = float(np.linalg.norm(self._pull))
        numbers = [number for number, name in enumerate(self.bodies) if name != "world"]
        self._tools = numbers
        self._samples = Samples(model, data, [self.bodies[n] for n in numbers], self.grid.deep)
        self._motion = BodyMotion(model, self._samples.bodies)
        self._spread = 1.5 * max(self.grid.deep, self._samples.coarse)
        masses = [model.body_subtreemass[body] for body in self._samples.bodies]
        free = [self._motion._own[row] is not None for row in range(len(numbers))]
        self._masses = np.array([mass if one else np.inf for mass, one in zip(masses, free, strict=True)])
        self._momentum = self._told_momentum()

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> Array:  # noqa: ARG002
        """Advance it by `seconds`; (k, 6) N, N m, on its bodies.

        Raises:
            ProgramError: it flies apart.
        """
        found, grid = np.zeros((len(self.bodies), 6)), self.grid
        cover, goes, whose = self._met(data, seconds, found)
        wave = float(np.sqrt(self._gravity * self.depth.max()))
        fastest = wave + max(float(np.abs(self._ways).max()), 0.5 * float(np.abs(goes).max()))
        narrow = 1.0 / float(np.hypot(1 / grid.deep, 1 / grid.wide.min()))
        if not np.isfinite(fastest) or fastest > 100.0:
            cause = f"{self.name} flies apart at {self.time:.4f} s"
            raise ProgramError(cause, self.name, "stir it more slowly")
        parts = max(1, int(np.ceil(seconds * fastest / (COURANT * narrow))))
        goes_u, goes_v = self._at_sides(goes)
        held = np.zeros((*self.depth.shape, 2))
        turning = self._turning()
        before, self._left[:] = self.depth.copy(), 0.0
        gone = advanced(
            self.depth, self.u, self.v, self.bed, *self._old, grid.round, grid.deep, grid.wide, grid.edge, grid.area,
            seconds / parts, parts, self._gravity, self._thin + EDDY * self._off() * min(grid.reach), self._still, self._rough,
            np.sqrt(self._thin * abs(turning) / 2), self._rough, cover, goes_u, goes_v, held, self._drain, self._left,
        )  # fmt: skip
        self.drained += gone
        self._rises = (self.depth - before) / seconds
        middle = self._left.ravel() @ np.column_stack([self._x.ravel(), self._y.ravel()])
        self._outflow = self._outflow + middle
        centred(self.u, self.v, grid.round, grid.turn, self._ways)
        self._push(held, whose, seconds, found)
        self._carry(seconds)
        self.time += seconds
        self._tell()
        momentum = self._told_momentum()
        world = list(self.bodies).index("world")
        total = (self.depth * grid.area[:, None]).sum() * self.density + self.drained * self.density
        others = found[:, :3].sum(axis=0)
        found[world, :3] = total * self._pull - (momentum - self._momentum) / seconds - others
        self._momentum = momentum
        self._motion.felt = found[self._tools].copy()
        return found

    def energy(self) -> float:
        """J: what the columns have besides the motion and weight of their points, which lie at the surface."""
        grid, rows = self.grid, self.density * self.grid.area[:, None]
        next_v = np.roll(self.v, -1, axis=1)
        mean_u = (self.u[:-1] ** 2 * grid.edge[:-1, None] + self.u[1:] ** 2 * grid.edge[1:, None]) * grid.deep
        mean_v = (self.v**2 + next_v**2) * grid.wide[:, None] * grid.deep
        motion = 0.25 * self.density * float(((mean_u + mean_v) * self.depth).sum())
        weight = float((rows * self.depth * (self.vessel.floor + self.bed + self.depth / 2)).sum()) * self._gravity
        points = self.mass @ (self.velocities**2).sum(axis=1) / 2 + self.mass @ self.points[:, 2] * self._gravity
        out = self.drained * self.density * self.points[-1, 2] * self._gravity
        return motion + weight + out - float(points)

    def volume(self) -> float:
        """m^3, with what has drained."""
        return float((self.depth * self.grid.area[:, None]).sum()) + self.drained

    def angular_momentum(self) -> float:
        """kg m^2/s about the vessel's axis."""
        away = np.stack([self._x, self._y], axis=-1) - self.grid.middle
        turns = away[..., 0] * self._ways[..., 1] - away[..., 1] * self._ways[..., 0]
        return self.density * float((turns * self.depth * self.grid.area[:, None]).sum())

    # at the start

    def _spun(self, spin: float) -> None:
        """Let all of it turn, with the surface that this has: h = h0 + w^2 (r^2 - mean r^2) / 2 g."""
        if not spin:
            return
        grid = self.grid
        far = (np.arange(grid.rows) + 0.5) * grid.deep
        if not grid.round:
            raise ProgramError(
                f"{self.name} turns as one in a square vessel", self.name, "stir it there, or let `spin` be 0"
            )
        self.v[:] = (spin * far)[:, None]
        square = np.broadcast_to((far**2)[:, None], self.depth.shape)
        rise = (
            spin**2
            * (square - np.average(square, weights=np.broadcast_to(grid.area[:, None], square.shape)))
            / (2 * 9.81)
        )
        if (self.depth + rise).min() < 0:
            raise ProgramError(
                f"{self.name} would lie dry in the middle at {spin:g} rad/s", self.name, "let it turn more slowly"
            )
        self.depth = self.depth + rise

    def _hole(self, drain: tuple[float, float, float] | None) -> Array:
        """(I, J) sqrt(m)/s: m/s of depth that runs out, over the root of the depth."""
        if drain is None:
            return np.zeros_like(self.depth)
        x, y, radius = drain
        away = np.hypot(self._x - x, self._y - y)
        share = np.clip((radius - away) / (0.5 * self.grid.deep) + 0.5, 0.0, 1.0)
        if radius <= 0 or not share.any():
            cause = f"the drain of {self.name} at ({x:g}, {y:g}) is in no cell of its floor"
            raise ProgramError(
                cause, self.name, f"put it in the vessel, with a radius of {self.grid.deep:.2g} m or more"
            )
        area = np.broadcast_to(self.grid.area[:, None], share.shape)
        share = share * np.pi * radius**2 / (share * area).sum()
        return np.ascontiguousarray(DRAINS * np.sqrt(2 * 9.81) * share)

    def _strewn(self, count: int) -> Array:
        """(n, 2) m: places all over the liquid, evenly, by the golden angle, or a lattice of two irrational steps."""
        number, grid = np.arange(count), self.grid
        if grid.round:
            far = (grid.reach[0] * 0.94) * np.sqrt((number * 0.7548776662) % 1.0)
            turn = 2 * np.pi * ((number * 0.5698402910) % 1.0)
            return grid.middle + far[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
        share = np.column_stack([(number * 0.7548776662) % 1.0, (number * 0.5698402910) % 1.0])
        return grid.middle + 0.94 * np.array(grid.reach) * (2 * share - 1)

    # a step

    def _turning(self) -> float:
        """rad/s, times two: the mean vorticity, by the angular momentum."""
        away = (self._x - self.grid.middle[0]) ** 2 + (self._y - self.grid.middle[1]) ** 2
        inertia = self.density * float((away * self.depth * self.grid.area[:, None]).sum())
        return 2.0 * self.angular_momentum() / max(inertia, 1e-12)

    def _off(self) -> float:
        """m/s: the mean by which the flow is off its mean way round, at each distance from the middle; of a square one off rest."""
        ways = np.stack([(self.u[:-1] + self.u[1:]) / 2, self.v])
        if self.grid.round:
            ways[1] -= ways[1].mean(axis=1, keepdims=True)
        return float(
            np.sqrt(np.average((ways**2).sum(axis=0), weights=np.broadcast_to(self.grid.area[:, None], self.v.shape)))
        )

    def _carry(self, seconds: float) -> None:
        grid, marks = self.grid, self._marks
        ways = np.ascontiguousarray(np.moveaxis(self._ways, -1, 0))
        where = (grid.round, grid.middle, grid.deep, grid.turn, float(grid.wide[0]), np.array(grid.reach))
        carried(marks.places, ways, *where, 0.75 * marks.width, seconds)
        if self._drain.any():
            here = np.zeros(len(marks.places))
            read(marks.places, self._drain, *where, here)
            if (sucked := here > 0.5 * self._drain.max()).any():
                turn = 2 * np.pi * ((np.flatnonzero(sucked) * 0.618 + self.time) % 1.0)
                rim = 0.9 * np.array(grid.reach) * np.column_stack([np.cos(turn), np.sin(turn)])
                marks.put(sucked, grid.middle + rim)
        marks.moved(seconds)
        if self._dye is not None:
            fresh = np.empty_like(self._dye)
            fine = self._shown
            dyed(self._dye, fresh, *self._fine, ways, *where, fine.deep, fine.turn, float(fine.wide[0]), seconds)
            self._dye = fresh

    # what is told

    def _wall_floor(self) -> Array:
        away = self._body.places[self._body.border] - self.grid.middle
        return self.vessel.floor + self.vessel.bed(np.linalg.norm(away, axis=1)) - 2e-4

    def _told_momentum(self) -> Array:
        return np.asarray(self.mass @ self.velocities)

    def _tell(self) -> None:
        """Tell where the columns are, which carry all mass; and, ahead of them, what is drawn."""
        grid, rows = self.grid, self.density * self.grid.area[:, None]
        top = self.vessel.floor + self.bed + self.depth
        if self.time - self._drawn_at > SEEN_S - 1e-9:
            self._drawn, self._drawn_at = self._draw(top), self.time
            self.colours = self._coloured(self._counts[0])
        nodes = np.stack([self._x, self._y, top], axis=-1).reshape(-1, 3)
        outflow = self._outflow / max(self.drained, 1e-300) if self.drained else grid.middle
        below = np.array([[*outflow, self.vessel.floor - 0.05]])
        self.points = np.concatenate([self._drawn, nodes, below])
        moves = np.concatenate([self._ways, self._rises[..., None]], axis=2).reshape(-1, 3)
        none = np.zeros((len(self._drawn), 3))
        self.velocities = np.concatenate([none, moves, none[:1]])
        self.mass = np.concatenate([none[:, 0], (rows * self.depth).ravel(), [self.density * self.drained]])

    def _draw(self, top: Array) -> Array:
        """(n, 3) m: the corners of the body and of the marks."""
        grid, marks = self.grid, self._marks
        where = (grid.round, grid.middle, grid.deep, grid.turn, float(grid.wide[0]), np.array(grid.reach))
        surface, flat = np.zeros(len(self._body.places)), marks.way.reshape(-1, 2)
        high, low = np.zeros((2, len(flat)))
        for places, field, found in ((self._body.places, top, surface), (flat, top, high), (flat, self.bed, low)):
            read(places, field, *where, found)
        low += self.vessel.floor
        heights = low + np.tile(marks.depths, len(marks.way)) * (high - low)
        body = self._body.corners(surface, self._wall_floor())
        return np.concatenate([body, marks.corners(heights.reshape(-1, len(marks.places)))])

    def _coloured(self, corners: int) -> Array:
        told = np.empty((sum(self._counts) + self.depth.size + 1, 3))
        told[:] = (0.93, 0.97, 0.98)
        told[corners : sum(self._counts)] = self._hues
        if self._dye is not None:
            flat = self._dye.reshape(-1, 3)
            told[: len(flat)] = flat
            told[len(flat) : corners] = flat[self._body.border].mean(axis=0)
        return told


def _low(number: Array) -> Array:
    """Shares of the depth, evenly strewn."""
    return np.asarray(0.08 + 0.82 * ((number * 0.4656) % 1.0))
