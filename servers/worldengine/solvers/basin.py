"""Simulate water in a basin with upright walls: it carries what floats, rises by what sinks into it, and may be let in.

Archimedes: a body is pushed up by the weight of the water that it displaces, at the middle of each of its geoms. The level
is where water and displaced volume together fill the basin:

    area (level - floor) = volume + sum of immersed volumes at that level
    F = density g V up - density V damping v

Spheres and ellipsoids are cut exactly; boxes, cylinders and capsules count as much immersed as their height is, which is
exact while they stand upright or lie level. No waves, no current, nothing that rights a leaning body.
Source: Archimedes, On Floating Bodies, I.5; the volume of an ellipsoid's cap is t^2 (3 - 2 t) of the whole at the share t
of its height.
"""

import math
from collections.abc import Mapping, Sequence
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
    "area": ("m^2", "of the basin's floor"),
    "floor": ("m", "height of the basin's floor"),
    "volume": ("m^3", "of the water at the start"),
    "inflow": ("m^3/s", "of water that is let in; negative where it runs out"),
    "damping": ("1/s", "drag on what moves through it, for each kilogram of displaced water"),
}
LEVEL = Column("level", (), "m", "height of the water's surface")
VOLUME = Column("volume", (), "m^3", "of the water")
NEWTON_STEPS = 30
"""More steps than ever needed, as the level's equation is smooth and rises everywhere."""
ROUND, FLAT = (2, 4), (3, 5, 6)
"""mjtGeom: sphere, ellipsoid; capsule, cylinder, box."""


CASES = (
    Case(
        '<mujoco><option timestep="0.002"/><worldbody><body name="log" pos="0 0 0.5"><freejoint/>'
        '<geom type="sphere" size="0.1" density="500"/></body></worldbody></mujoco>',
        bodies=("log",),
        constants={"density": 1000.0, "area": 1.0, "floor": 0.0, "volume": 0.5, "inflow": 0.0, "damping": 4.0},
        seconds=8.0,
        channel="immersed",
        expected=2 / 3 * math.pi * 0.1**3,
        tolerance=5e-6,
        because="Archimedes: what is half as dense as water floats half under",
    ),
    Case(
        '<mujoco><option timestep="0.002"/><worldbody><body name="stone" pos="0 0 0.5"><freejoint/>'
        '<geom type="box" size="0.1 0.1 0.1" density="2500"/></body></worldbody></mujoco>',
        bodies=("stone",),
        constants={"density": 1000.0, "area": 1.0, "floor": 0.0, "volume": 0.5, "inflow": 0.1, "damping": 4.0},
        seconds=1.0,
        channel="level",
        expected=0.608,
        tolerance=1e-4,
        because="what sinks lifts the level by its volume, 0.008 m^3 on 1 m^2, and the inflow by 0.1 m a second",
    ),
)


class Basin:
    """The water, at work on some bodies."""

    def __init__(
        self, model: "mujoco.MjModel", data: "mujoco.MjData", bodies: Sequence[int], constants: Mapping[str, float]
    ) -> None:
        import numpy as np

        self._model, self._bodies = model, np.array(bodies)
        self._density, self._area, self._floor, self._water, self._inflow, self._damping = (
            constants[name] for name in CONSTANTS
        )
        if min(self._density, self._area) <= 0 or min(self._water, self._damping) < 0:
            raise ProgramError(
                "a basin needs a positive density and area, and no negative volume or damping",
                "interventions",
                "correct its constants",
            )
        solid = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
        self._geoms = np.flatnonzero(np.isin(model.geom_bodyid, self._bodies) & solid)
        kinds = model.geom_type[self._geoms]
        if (odd := ~np.isin(kinds, (*ROUND, *FLAT))).any():
            name = names(model, "geom", model.ngeom)[int(self._geoms[odd][0])]
            raise ProgramError(
                f"the basin cannot tell how much of {name!r} is under water",
                "interventions",
                "use primitives for what floats",
            )
        self._round = np.isin(kinds, ROUND)
        order = {int(body): at for at, body in enumerate(bodies)}
        self._owner = np.array([order[int(body)] for body in model.geom_bodyid[self._geoms]], np.intp)
        self._size = np.where((kinds == 2)[:, None], model.geom_size[self._geoms][:, :1], model.geom_size[self._geoms])
        self._whole = np.array([_volume(int(k), s) for k, s in zip(kinds, self._size, strict=True)])
        self._kinds = kinds
        self._level = self._floor + self._water / self._area
        immersed = Column("immersed", (len(bodies),), "m^3", "of each of its bodies, under water")
        self.channels = {LEVEL: np.zeros(()), VOLUME: np.zeros(()), immersed: np.zeros(len(bodies))}
        self._immersed = self.channels[immersed]

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """Compute the level, the volumes under water, and the forces (n, 6) that they give."""
        import numpy as np

        from ..inputs.pushes import twist

        place = data.geom_xpos[self._geoms]
        turn = data.geom_xmat[self._geoms].reshape(-1, 3, 3)[:, 2]
        reach = self._reach(turn)
        self._level = self._surface(place[:, 2], reach)
        under = self._under(self._level, place[:, 2], reach)[0]
        self._immersed[:] = np.bincount(self._owner, under, minlength=len(self._bodies))
        self.channels[LEVEL][...] = self._level
        self.channels[VOLUME][...] = self._water
        wrench = np.zeros((len(self._bodies), 6))
        lift = -self._density * self._model.opt.gravity * under[:, None]
        arm = place - data.xipos[self._bodies][self._owner]
        turning = np.cross(arm, lift)
        for axis in range(3):
            wrench[:, axis] = np.bincount(self._owner, lift[:, axis], minlength=len(self._bodies))
            wrench[:, 3 + axis] = np.bincount(self._owner, turning[:, axis], minlength=len(self._bodies))
        speed = np.array([twist(self._model, data, int(body))[:3] for body in self._bodies])
        wrench[:, :3] -= self._density * self._damping * self._immersed[:, None] * speed
        return wrench

    def advance(self, step_s: float) -> None:
        """Let water in, or out while there is some."""
        self._water = max(0.0, self._water + self._inflow * step_s)

    def _surface(self, height: "np.ndarray", reach: "np.ndarray") -> float:
        """The level at which water and displaced volume fill the basin, m."""
        low = self._floor + self._water / self._area
        high = low + float(self._whole.sum()) / self._area
        level = min(max(self._level, low), high)
        for _ in range(NEWTON_STEPS):
            volume, width = self._under(level, height, reach)
            missing = self._water + float(volume.sum()) - self._area * (level - self._floor)
            low, high = (level, high) if missing > 0 else (low, level)
            step = missing / max(self._area - float(width.sum()), 1e-3 * self._area)
            if abs(step) < 1e-15:
                break
            level = level + step if low < level + step < high else (low + high) / 2
        return level

    def _under(self, level: float, height: "np.ndarray", reach: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":
        """(volume of each geom under water, m^3; its growth with the level, m^2)."""
        import numpy as np

        share = np.clip((level - height + reach) / (2 * reach), 0.0, 1.0)
        whole = np.where(self._round, share * share * (3 - 2 * share), share)
        growth = np.where(self._round, 6 * share * (1 - share), (share > 0) & (share < 1))
        return self._whole * whole, self._whole * growth / (2 * reach)

    def _reach(self, turn: "np.ndarray") -> "np.ndarray":
        """Half the height of each geom in its orientation, m; `turn` is the vertical row of that."""
        import numpy as np

        along, size, kinds = np.abs(turn), self._size, self._kinds
        found = np.sqrt((turn**2 * size**2).sum(axis=1))  # sphere, ellipsoid
        found = np.where(kinds == 3, size[:, 0] + size[:, 1] * along[:, 2], found)
        across = np.sqrt(np.clip(1 - along[:, 2] ** 2, 0, 1))
        found = np.where(kinds == 5, size[:, 1] * along[:, 2] + size[:, 0] * across, found)
        return np.where(kinds == 6, (along * size).sum(axis=1), found)


def start(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    bodies: Sequence[int],
    constants: Mapping[str, float],
    shown_by: str = "",
) -> Basin:
    """Start the water at rest."""
    return Basin(model, data, bodies, constants)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """Raise the box that shows the water so that its upper face is at the level."""
    data.geom_xpos[geom, 2] = float(channels["level"]) - model.geom_size[geom, 2]


def _volume(kind: int, size: "np.ndarray") -> float:
    """The volume of one primitive, m^3."""
    x, y, z = map(float, size)
    return {
        2: 4 / 3 * math.pi * x**3,
        3: math.pi * x**2 * (4 / 3 * x + 2 * y),
        4: 4 / 3 * math.pi * x * y * z,
        5: 2 * math.pi * x**2 * y,
        6: 8 * x * y * z,
    }[kind]
