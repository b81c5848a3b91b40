"""What an author tells of a skin: the gas inside, and what its wall is of."""

from dataclasses import dataclass

import numpy as np

Array = np.ndarray
GAS = 8.314462618
"""J/(mol K)."""


@dataclass(frozen=True)
class Gas:
    """What is inside.

    Where `pressure` is None, the gas begins as the skin balances it: at the outside's where that is unstretched.
    """

    warm: float = 293.15
    """K, at the start."""
    around: float = 293.15
    """K, of the surroundings."""
    takes: float = 1.0
    """s, after which a share 1 / e of the difference is left."""
    pressure: float | None = None
    """Pa, when it is closed."""
    outside: float = 101325.0
    """Pa."""
    closes: float = 0.0
    """s, until which it is open; never closed: `math.inf`."""
    liquid: float = 0.0
    """m^3 of what is inside that keeps its volume."""
    wet: bool = False
    """Saturated with steam, as over hot water: its pressure (Magnus) is part of that at closing, and goes as it condenses."""

    hole: float = 0.0
    """m, diameter of a hole, by which it leaves as through an orifice; 0: it has none."""
    hole_at: int = 0
    """The point of the skin that the hole is at; the jet pushes the triangles around it inwards."""
    discharge: float = 0.6
    """Of the hole: that of a sharp edge (ISO 5167); about 1 of a rounded one."""

    def temperature(self, time: float) -> float:
        """K."""
        return self.around + (self.warm - self.around) * float(np.exp(-time / self.takes))

    def steam(self, time: float) -> float:
        """Pa of it, saturated."""
        celsius = self.temperature(time) - 273.15
        return 610.94 * float(np.exp(17.625 * celsius / (celsius + 243.04))) if self.wet else 0.0


@dataclass(frozen=True)
class Wall:
    """What the skin is of."""

    young: float
    """Pa; for rubber three times the shear modulus."""
    thickness: "float | Array"
    """m, or (f,) m of each triangle, unstretched."""
    density: float
    """kg/m^3."""
    poisson: float = 0.4
    """Of plastic; rubber keeps its volume."""
    rubber: bool = False
    """Neo-Hookean; else Saint-Venant, for what stretches little and bends."""
    stretched: float = 1.0
    """How many times its unstretched size it has at the start."""
    yields: float | None = None
    """Strain at the surface beyond which a bend stays, as a crease; None for never."""
    damping: float = 0.0
    """s: a strain that changes by 1 / s adds this times its stress."""
    friction: float = 0.4
    """Coulomb's, against every body."""
    hard: float = 1e7
    """Pa for each m that it is pressed into a body; a light body wants less."""
    air: float = 0.0
    """1/s: drag of the still air, a share of the momentum; what it takes goes to `world`."""
