"""Simulate water with a free surface in a container: waves, reflection at walls, what floats, falls in or sinks, and splashes.

Its surface is that of what shows it: a flex that `waters.fill` made (any shore), or a box or an upright cylinder that is only drawn,
whose upper face is the level. Small waves of any length go at their own speed (Airy; `worldengine.waves`); a steep splash is steeper
than they may be and is their shape only on the whole. Bodies are carried by Archimedes at the local surface, dragged, struck, and
push waves; drops fly from an impact and return. The container stands still and lets nothing out.
Source: Lamb, Hydrodynamics, chapters VIII and IX; Newman, Marine Hydrodynamics, chapter 6; von Karman, NACA TN 321 (1929).
"""

import math
from collections.abc import Mapping, Sequence
from copy import copy
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.naming import names

from ..recording.columns import Column
from . import Case

if TYPE_CHECKING:
    import mujoco
    import numpy as np

CONSTANTS = {
    "density": ("kg/m^3", "of the water"),
    "level": ("m", "height of the water's surface at the start"),
}
OPTIONAL = {
    "wind": ("m/s", "of a wind that has ruffled it"),
    "viscosity": ("Pa s", "of the water; 0.001 where nothing is said"),
    "tension": ("N/m", "of its surface; 0.0728 where nothing is said"),
}
MOST_CELLS, MOST_CELLS_CUT = 9_000, 1_700
"""Of a rectangle, whose waves cost little, and of any other shore."""
CELLS_A_HALF, FEWEST_CELLS = 6.0, 900
"""Cells over half the width of the smallest body, and in all, at least."""
WEIGHTY = True
HALF_M = 0.1
"""Half the width of a body, as far as the grid goes, where there is none: a pond for itself."""
LEAST_CELL = 0.0008
"""m."""
LONGEST_S = 0.01
"""The waves go on in steps of at most so long."""
RADIANS = 0.12
"""In one of which the waves that the smallest body makes turn by so much."""
DRAWN_HZ = 60.0
"""What shows it is recorded so often, 1/s."""
LOOSE_DROPS = 40
"""Drops of water that a box or a cylinder shows: they carry what they carry, and are not seen."""
AGREED_M = 1e-3
"""So far the plan's level may be from the drawn one."""
LEVEL = Column("level", (), "m", "height of the water's surface, on the mean")
HIGHEST = Column("highest", (), "m", "of its surface, as the smallest body feels it")
VOLUME = Column("volume", (), "m^3", "of the water and its drops, less that at the start")
ENERGY = Column("energy", (), "J", "of the waves, of what is displaced, and of the drops, less that at the start")
DROPS = Column("drops", (), "1", "in the air")

CASES = (
    Case(
        '<mujoco><option timestep="0.002"/><worldbody><geom name="tub" type="box" size="0.5 0.5 0.25" pos="0 0 0.25" '
        'contype="0" conaffinity="0"/><body name="log" pos="0 0 0.5"><freejoint/>'
        '<geom type="sphere" size="0.1" density="500"/></body></worldbody></mujoco>',
        bodies=("log",),
        constants={"density": 1000.0, "level": 0.5},
        seconds=0.4,
        channel="immersed",
        expected=2 / 3 * math.pi * 0.1**3,
        tolerance=1e-6,
        because="Archimedes: what is half as dense as water lies half under, and stays so",
        shown_by="tub",
    ),
    Case(
        '<mujoco><option timestep="0.002"/><worldbody><geom name="tub" type="box" size="0.5 0.5 0.25" pos="0 0 0.25" '
        'contype="0" conaffinity="0"/><body name="stone" pos="0 0 0.7"><freejoint/>'
        '<geom type="box" size="0.1 0.1 0.1" density="2500"/></body></worldbody></mujoco>',
        bodies=("stone",),
        constants={"density": 1000.0, "level": 0.5},
        seconds=0.4,
        channel="level",
        expected=0.508,
        tolerance=1e-4,
        because="what sinks lifts the level by its volume, 0.008 m^3 on 1 m^2",
        shown_by="tub",
    ),
)  # fmt: skip


class Pool:
    """The water at work."""

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        bodies: Sequence[int],
        constants: Mapping[str, float],
        shown_by: str,
    ) -> None:
        import mujoco
        import numpy as np

        from ..waves.afloat import Afloat
        from ..waves.body_of_water import Liquid, Water
        from ..waves.hull_samples import Hulls
        from ..waves.spray import Spray

        told = {"viscosity": 1.0e-3, "tension": 0.0728, "wind": 0.0, **constants}
        gravity = -float(model.opt.gravity[2])
        if min(told["density"], told["viscosity"], gravity) <= 0 or min(told["tension"], told["wind"]) < 0:
            cause = "water needs a density, a viscosity and a gravity downwards, and no negative tension or wind"
            raise ProgramError(cause, "interventions", "correct its constants")
        if np.abs(model.opt.gravity[:2]).max() > 1e-9:
            raise ProgramError(
                "water lies level, and gravity is aslant here", "interventions", "let gravity be along -z"
            )
        data = copy(data)  # a world that begins may not know yet where its bodies are
        for stage in (mujoco.mj_kinematics, mujoco.mj_comPos, mujoco.mj_comVel):
            stage(model, data)
        hulls = Hulls(model, bodies)
        outline, level, floor, self._drawn = _shape(model, data, shown_by)
        if abs(level - told["level"]) > AGREED_M:
            cause = f"the plan says the water's level is at {told['level']:g} m, and {shown_by} shows it at {level:g} m"
            raise ProgramError(cause, "interventions", "say the same in both")
        grid = _grid(outline, float(hulls.size.min(initial=HALF_M)))
        depth = _depth(model, data, grid, level, floor, bodies)
        self.water = Water(
            grid, level, depth, Liquid(told["density"], told["viscosity"], told["tension"]), hulls, gravity
        )
        if told["wind"] > 0:
            self.water.ruffle(told["wind"], seed=7)
        self._afloat = Afloat(model, self.water)
        self.spray = Spray(self.water, self._drawn.beads if self._drawn else LOOSE_DROPS)
        if self._drawn:
            self._drawn.over(grid)
        step = float(model.opt.timestep)
        k = 1.0 / max(float(self.water.layers[0]), 1e-6)
        wanted = min(LONGEST_S, RADIANS / float(self.water.airy.frequency(np.array([k]))[0]))
        self._every, self._step, self._since = max(1, round(wanted / step)), step, 0
        self.every = max(1, round(1.0 / (DRAWN_HZ * step)))
        """Steps from one record of what shows it to the next."""
        immersed = Column("immersed", (len(bodies),), "m^3", "of each of its bodies, under water")
        columns = (LEVEL, HIGHEST, VOLUME, ENERGY, DROPS, *([immersed] if bodies else []))
        self.channels = {column: np.zeros(column.shape) for column in columns}
        self._place = data.xipos[list(bodies)].copy()
        self._down = np.zeros(len(hulls.owner))
        self._met = self._afloat.meet(data)
        self.water.begin(self._met.felt)
        self._tell(first=True)

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """The forces (n, 6) on the bodies as they are now."""
        self._place = data.xipos[self.water.hulls.bodies].copy()
        self._met = self._afloat.meet(data)
        self._tell()
        return self._met.wrench

    def advance(self, step_s: float) -> None:
        """Let drops fly, and waves go on each time that some steps are over."""
        met, hulls = self._met, self.water.hulls
        self._down += met.down * step_s
        wet = hulls.summed(hulls.volume * met.felt.share_under)
        for body, half in enumerate(self._halves):
            self.spray.fling(
                body, float(met.fling[body]) * step_s, self._place[body, :2], half, met.speed[body],
                float(met.against[body]), float(wet[body] / hulls.whole[body]),
            )  # fmt: skip
        self._afloat.keep(met)
        self.spray.advance(step_s)
        self._since += 1
        if self._since == self._every:
            self.water.push(met.felt, self._down)
            self._down[:] = 0.0
            self.water.advance(met.felt, self._since * step_s)
            self._since = 0

    @property
    def _halves(self) -> "list[float]":
        hulls = self.water.hulls
        return [float(hulls.size[hulls.owner == body].max()) for body in range(len(hulls.bodies))]

    def points(self) -> "np.ndarray | None":
        """(n, 3) m: the corners of the flex that shows it, as they are now; None where a geom does."""
        import numpy as np

        if self._drawn is None:
            return None
        under = self._place[0] if len(self._place) else np.zeros(3)
        idle = np.array([*under[:2], self.water.level - 0.3 * self.water.depth])
        found = self._drawn.points(self.water.surface(), self.spray.place, self.spray.radius, idle)
        return np.asarray(np.round(found, 6))  # what is finer than that nobody sees, and it fills the disk

    def _tell(self, first: bool = False) -> None:
        """Bring the channels up to date."""
        import numpy as np

        water, met = self.water, self._met
        flying = float(self.spray.volumes.sum())
        drops = 0.5 * (self.spray.volumes * (self.spray.speed**2).sum(axis=1)).sum() + water.gravity * float(
            (self.spray.volumes * (self.spray.place[:, 2] - water.level)).sum()
        )
        energy = water.energy(met.felt) + self._afloat.carried(met) + water.liquid.density * float(drops)
        if first:
            self._energy = energy
        values = (
            water.level + water.swell / water.grid.area,
            water.level + float(water.fields[0].max()),
            water.swell - water.laid - water.waiting + flying + self.spray.spilt,
            energy - self._energy,
            float((self.spray.radius > 0).sum()),
            water.hulls.summed(water.hulls.volume * met.felt.share_under),
        )
        for array, value in zip(self.channels.values(), values, strict=False):  # of no bodies, nothing is told of them
            array[...] = np.asarray(value)


def start(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    bodies: Sequence[int],
    constants: Mapping[str, float],
    shown_by: str = "",
) -> Pool:
    """Start the water at rest, or ruffled by the wind."""
    return Pool(model, data, bodies, constants, shown_by)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """Raise the geom that shows the water so that its upper face is at the mean level."""
    half = model.geom_size[geom, 2] if model.geom_type[geom] == 6 else model.geom_size[geom, 1]
    data.geom_xpos[geom, 2] = float(channels["level"]) - half


def _shape(model: "mujoco.MjModel", data: "mujoco.MjData", shown_by: str) -> "tuple[np.ndarray, float, float, Any]":
    """(outline (P, 2) m, level, floor, m, the flex that shows it or None)."""
    import numpy as np

    from ..waves.shown_water import ShownWater

    flexes, geoms = names(model, "flex", model.nflex), names(model, "geom", model.ngeom)
    if shown_by in flexes:
        drawn = ShownWater(model, flexes.index(shown_by))
        return drawn.outline, drawn.level, drawn.floor, drawn
    geom = geoms.index(shown_by) if shown_by in geoms else -1
    if geom < 0 or model.geom_type[geom] not in (5, 6) or abs(data.geom_xmat[geom, 8]) < 1 - 1e-9:
        cause = f"the water is shown by {shown_by!r}, which is no flex, no level box and no upright cylinder"
        raise ProgramError(cause, "interventions", "show it by what waters.fill makes (skill media)")
    size, at = model.geom_size[geom], data.geom_xpos[geom]
    turn = data.geom_xmat[geom].reshape(3, 3)[:2, :2]
    if model.geom_type[geom] == 6:
        outline, half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size[:2], size[2]
    else:
        angle = 2 * np.pi * np.arange(96) / 96
        outline, half = size[0] * np.column_stack([np.cos(angle), np.sin(angle)]), size[1]
    return outline @ turn.T + at[:2], float(at[2] + half), float(at[2] - half), None


def _grid(outline: "np.ndarray", half: float) -> Any:
    """The cells of the surface, as fine as the smallest body asks for, whose half width is `half`, m, or as many as there may be."""
    from worldkit.polygons import area

    from ..waves.wet_grid import WetGrid, rectangle

    most = MOST_CELLS if rectangle(outline) else MOST_CELLS_CUT
    wanted = max(LEAST_CELL, half / CELLS_A_HALF)
    return WetGrid(outline, min(max(wanted, math.sqrt(area(outline) / most)), math.sqrt(area(outline) / FEWEST_CELLS)))


def _depth(
    model: "mujoco.MjModel", data: "mujoco.MjData", grid: Any, level: float, floor: float, bodies: Sequence[int]
) -> float:
    """The mean depth, m: by rays downwards at some cells, on what stands still; that of what shows it where they meet nothing."""
    import mujoco
    import numpy as np

    which, found = np.zeros(1, np.int32), []
    for x, y in grid.middle[:: max(1, grid.size // 300)]:
        way = mujoco.mj_ray(model, data, np.array([x, y, level]), np.array([0, 0, -1.0]), None, True, -1, which)
        solid = way > 0 and (model.geom_contype[which[0]] or model.geom_conaffinity[which[0]])
        if solid and model.geom_bodyid[which[0]] not in bodies:
            found.append(way)
    return float(np.mean(found)) if found else level - floor
