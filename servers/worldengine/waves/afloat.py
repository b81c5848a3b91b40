"""The forces of water on the bodies in it, made for one step of the engine and held during it.

Added mass, drag and impact are reckoned with the velocity at the end of the step, which a body has when all else that acts on it
(its weight; what touches it, as it did in the last step) and the water have acted; so they are stable for any body, however light.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .body_of_water import ADDED, Felt, Water
from .hull_samples import cross
from .welded import Wholes

if TYPE_CHECKING:
    import mujoco

STICKY = 4.5
"""Drag at low speed, for each displaced mass: viscosity times so much over the square of the half width (Stokes), and, of what
lies in the surface, more by that over the depth to which a bobbing body drags its water along (Landau, Lifshitz, Fluid Mechanics, section 24).
"""
Array = np.ndarray


@dataclass(frozen=True)
class Met:
    """What water and bodies did to each other in one step."""

    felt: Felt
    wrench: Array
    """(n, 6) N and N m on the bodies, at their centres of mass."""
    speed: Array
    """(n, 3) m/s, of the centre of mass of each with what is welded to it."""
    moved: Array
    """(n,) kg: the mass of water that goes along."""
    down: Array
    """(L,) N: what drag and impact push the water down with, at each lump."""
    fling: Array
    """(n,) W: what an impact leaves for the spray."""
    against: Array
    """(n,) m/s: the speed of a body through the surface."""


class Afloat:
    """Some bodies in water.

    Args:
        model: the world.
        water: with the bodies as its hulls.
    """

    def __init__(self, model: "mujoco.MjModel", water: Water) -> None:
        self._model, self._water = model, water
        bodies = water.hulls.bodies
        self._wholes = Wholes.of(model, bodies)
        self._mass = self._wholes.mass
        self._inertia = np.maximum(self._wholes.inertia, 1e-12)
        self._weight = self._mass[:, None] * model.opt.gravity
        self._drag = 0.5 * water.liquid.density * water.hulls.drag * water.hulls.volume
        nu = water.liquid.viscosity / water.liquid.density
        half = water.hulls.size
        deep = np.sqrt(2 * nu / np.sqrt(water.gravity / half))
        self._sticky = water.liquid.density * water.hulls.volume * STICKY * nu / half**2
        self._bobs = half / deep
        self._reach = np.array([
            float((np.linalg.norm(hull.place[hull.owner == n], axis=1) + hull.rise[hull.owner == n]).max())
            for hull in (water.hulls,) for n in range(len(bodies))
        ])  # fmt: skip
        """(n,) m: how far each body reaches from its origin."""
        self._before: Met | None = None

    def meet(self, data: "mujoco.MjData") -> Met:
        """What the water does to the bodies as they are now; nothing of it is kept."""
        water, hulls, step = self._water, self._water.hulls, float(self._model.opt.timestep)
        density, gravity = water.liquid.density, water.gravity
        if self._dry(data):
            return self._nothing(data)
        points = hulls.at(data)
        felt = water.weigh(points)
        speed, spin, lies = self._moves(data)
        arm = points - (data.xipos[hulls.bodies] + lies)[hulls.owner]
        under = hulls.volume * felt.share_under
        lift = -density * gravity * under[:, None] * felt.slope
        lift[:, 2] += density * gravity * under
        force, torque = hulls.summed(lift), hulls.summed(cross(arm, lift))
        through = speed[hulls.owner] + cross(spin[hulls.owner], arm)
        through[:, 2] -= felt.up
        fast = np.sqrt((through**2).sum(axis=1))
        wet = hulls.summed(under)
        part = wet / hulls.whole
        bobs = 1 + self._bobs * (4 * part * (1 - part))[hulls.owner]
        rate = (self._drag * fast + self._sticky * bobs) * felt.share_under
        drag = hulls.summed(rate)
        rises = hulls.summed(under * felt.up) / np.maximum(wet, 1e-12)
        rises_dragged = hulls.summed(rate * felt.up)
        moved = ADDED * density * wet
        begun = self._before.moved if self._before else moved
        gains = np.maximum(moved - begun, 0.0) / step
        other = self._others(speed, step)
        push = other + force
        push[:, 2] += rises_dragged + gains * rises
        push += ((self._mass + moved) / step)[:, None] * speed
        after = push / ((self._mass + moved) / step + drag + gains)[:, None]
        given = self._mass[:, None] * (after - speed) / step - other
        held = wet + begun > 0
        given = np.where(held[:, None], given, 0.0)
        # What turns in water is braked, about each of its own axes, no further than to rest.
        brake = -hulls.summed(cross(arm, rate[:, None] * cross(spin[hulls.owner], arm)))
        own = data.ximat[hulls.bodies].reshape(-1, 3, 3) @ self._wholes.axes
        stop = hulls.summed(rate * (arm**2).sum(axis=1))[:, None] * step / self._inertia
        torque += np.einsum("nij,nj->ni", own, np.einsum("nji,nj->ni", own, brake) / (1 + stop))
        resist = drag * after[:, 2] - rises_dragged + gains * (after[:, 2] - rises)
        through_it = after.copy()
        through_it[:, 2] -= rises
        square = (through_it**2).sum(axis=1)
        down = -resist[hulls.owner] * under / np.maximum(wet, 1e-12)[hulls.owner]
        torque = torque * held[:, None] + cross(lies, given)  # at the body's own centre, where the engine takes it
        return Met(
            felt, np.concatenate([given, torque], axis=1), speed, moved, down,
            0.5 * gains * square, np.sqrt(square),
        )  # fmt: skip

    def _moves(self, data: "mujoco.MjData") -> "tuple[Array, Array, Array]":
        """(n, 3) m/s and rad/s: how each whole moves; (n, 3) m: from its body's own centre of mass to that of the whole."""
        from ..inputs.pushes import twist

        bodies = self._water.hulls.bodies
        moves = np.array([twist(self._model, data, int(body)) for body in bodies]).reshape(-1, 6)
        lies = np.einsum("nij,nj->ni", data.ximat[bodies].reshape(-1, 3, 3), self._wholes.middle)
        return moves[:, :3] + cross(moves[:, 3:], lies), moves[:, 3:], lies

    def _dry(self, data: "mujoco.MjData") -> bool:
        """Whether all bodies are over the highest wave, and were so before."""
        low = data.xpos[self._water.hulls.bodies, 2] - self._reach
        wet = self._before is not None and bool(self._before.moved.any())
        return not wet and bool((low > self._water.level + max(float(self._water.fields.max()), 0.0)).all())

    def _nothing(self, data: "mujoco.MjData") -> Met:
        """What water does to bodies over it."""
        hulls = self._water.hulls
        n, lumps = len(hulls.bodies), len(hulls.owner)
        speed, _, _ = self._moves(data)
        cells = np.zeros((lumps, 4), int)
        none = np.zeros(lumps)
        felt = Felt(
            cells, np.zeros((lumps, 4)), np.zeros(lumps, int), none, none, np.zeros((lumps, 3)), none, none, none
        )
        return Met(felt, np.zeros((n, 6)), speed, np.zeros(n), none, np.zeros(n), np.zeros(n))

    def keep(self, met: Met) -> None:
        """The step is over in which this acted."""
        self._before = met

    def carried(self, met: Met) -> float:
        """J: the motion of the water that goes along with bodies."""
        return float((0.5 * met.moved * (met.speed**2).sum(axis=1)).sum())

    def _others(self, speed: Array, step: float) -> Array:
        """(n, 3) N: what else acts, as in the last step; at first the weight."""
        if self._before is None:
            return self._weight.copy()
        return np.asarray(self._mass[:, None] * (speed - self._before.speed) / step - self._before.wrench[:, :3])
