"""Soft solids under any strain: foam and rubber, which spring back, and clay or dough, which yields and keeps what it was given.

What springs back is a compressible neo-Hookean solid, tau = mu (b - 1) + lambda ln J. What yields is elastic in Hencky's strains up to
von Mises' stress, and flows beyond without a change of volume. Sources: Bonet and Wood, Nonlinear Continuum Mechanics for Finite
Element Analysis, section 6.4.3; Simo 1992, "Algorithms for static and dynamic multiplicative plasticity" (return mapping).
"""

from dataclasses import dataclass, replace

import numpy as np

from ..errors import ProgramError
from .beforehand import check_positive

WIDEST = 0.45
"""The largest Poisson's ratio."""


@dataclass(frozen=True)
class Solid:
    """What a soft solid is; `foam` and `clay` are two with usual numbers.

    Args:
        density: kg/m^3, as it lies.
        young: Pa, of small strains.
        poisson: 1, 0 to 0.45: how much it widens when it is pressed; foam 0.1, rubber 0.45.
        yields: Pa, von Mises' stress above which it keeps its new shape; None: it always springs back.
        creeps: s: how soon what is above a seventh of `yields` gives way, so that it resists a blow more than a hand that leans on it, and
            a ball soon lies still in it; 0: never.
        damping: s: its viscous stress is so many seconds times Young's modulus times twice the rate of strain.
        wall_friction: against what it touches, Coulomb's.
        down_to: 1: to how much of its thickness it is pressed; its steps are short enough for that.
    """

    density: float = 60.0
    young: float = 8e3
    poisson: float = 0.1
    yields: float | None = None
    creeps: float = 0.0
    damping: float = 5e-5
    wall_friction: float = 0.6
    down_to: float = 0.35

    def __post_init__(self) -> None:
        """Refuse what nothing can be (`ProgramError`)."""
        check_positive("a solid", density=self.density, young=self.young, yields=self.yields, down_to=self.down_to)
        if not 0 <= self.poisson <= WIDEST:
            cause = f"a solid has a Poisson's ratio, `poisson`, of {self.poisson:g}"
            raise ProgramError(cause, "worldkit.matter", f"give 0 to {WIDEST}: beyond it the cells lock")
        if not (self.down_to < 1 and min(self.creeps, self.damping, self.wall_friction) >= 0):
            cause = f"a solid creeps in {self.creeps:g} s, is damped by {self.damping:g} s, rubs by {self.wall_friction:g}, is pressed to {self.down_to:g}"
            raise ProgramError(cause, "worldkit.matter", "give 0 and more, and a `down_to` below 1")

    @property
    def lame(self) -> tuple[float, float]:
        """Lambda and mu, Pa."""
        mu = self.young / (2 * (1 + self.poisson))
        return 2 * mu * self.poisson / (1 - 2 * self.poisson), mu

    @property
    def hardest(self) -> float:
        """Pa: how stiff it is, per stretch of what it was, where it is pressed down to its least."""
        (lam, mu), least = self.lame, self.down_to
        if self.yields:
            return float((lam + 2 * mu) / least**2)
        return float(mu + (mu + lam * (1 - np.log(least))) / least**2)

    def but(self, **changed: float) -> "Solid":
        """The same but for some numbers."""
        return replace(self, **changed)


def foam(density: float = 60.0, young: float = 8e3) -> Solid:
    """A sponge, a cushion, a stress ball: it hardly widens when it is squeezed, and springs back."""
    return Solid(density, young)


def clay(density: float = 1800.0, young: float = 8e6, yields: float = 3e4) -> Solid:
    """Clay, dough, putty, wax: it keeps dents. A stiff one (Young's modulus 250 times what it yields at) hardly throws a ball back."""
    return Solid(density, young, 0.4, yields, creeps=0.003, damping=1e-5, down_to=0.6)
