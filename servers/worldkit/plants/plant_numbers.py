"""The numbers of a plant, and what follows from them: its limbs, the names of its bodies and joints, its mass, its size."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import pi
from numbers import Integral, Real
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .branching import Limb

MOST_LEAVES, MOST_BODIES = 4000, 120
LONG_M = (0.02, 120.0)
"""The shortest that has limbs of more than micrometres, the tallest tree that stands."""
WHOLE = {"leaves": (0, MOST_LEAVES), "seed": (0, 2**63), "parts": (1, MOST_BODIES), "twigs": (1, MOST_BODIES)}
RANGES = {
    "diameter_m": (2e-4, 20.0),
    "leaf_m": (1e-3, 5.0),
    "modulus_pa": (1e5, 1e12),
    "wood_kg_m3": (10.0, 5000.0),
    "damping_s": (1e-6, 100.0),
    "rises_deg": (-90.0, 90.0),
}
"""Of what is told, the least and the most: beyond, nothing grows that could be simulated."""
LIGHTEST_KG = 2e-4
"""A limb's wood weighs no less."""
FILLED = 0.62
"""Area of a leaf as a share of its length times its width."""
SLENDER = 0.55
"""Width of a leaf as a share of its length."""
LEAF_KG_M2 = 0.16
"""Of a fresh leaf; broad leaves of the temperate zone weigh 0.12 to 0.2 kg/m^2."""
SEEN = 0.5
"""The mean area that a leaf turns towards the wind, as a share of its own."""


@dataclass(frozen=True)
class Plant:
    """What all plants have; a kind adds how it branches."""

    height_m: float = 0.0
    """Of what stands; a bough has a length."""
    length_m: float = 0.0
    """Of a bough from its root to its tip."""
    diameter_m: float = 0.03
    """Of the stem at its root; towards the tip it becomes a fifth of it."""
    leaves: int = 400
    leaf_m: float = 0.075
    """Length of a leaf."""
    modulus_pa: float = 6.0e9
    """Young's modulus of the wood: green wood has 5 to 10 GPa."""
    wood_kg_m3: float = 800.0
    damping_s: float = 0.03
    """How long the wood's own damping remembers: moment per angular speed over the stiffness."""
    seed: int = 1

    word = "plant"

    def __post_init__(self) -> None:
        own = "length_m" if self.word == "bough" else "height_m"
        for name, (low, high) in WHOLE.items():
            value = getattr(self, name, low)
            if not isinstance(value, Integral) or isinstance(value, bool) or not low <= int(value) <= high:
                raise ValueError(f"a {self.word} has a whole number of {name} from {low} to {high}, not {value}")
        for name, (least, most) in {own: LONG_M, **RANGES}.items():
            value = getattr(self, name, least)
            if not isinstance(value, Real) or not least <= float(value) <= most:
                raise ValueError(f"a {self.word}'s {name} is a number from {least:g} to {most:g}, not {value}")
        if self.diameter_m > 0.2 * self.long_m:
            raise ValueError(
                f"a {self.word} of {self.long_m:g} m cannot be {self.diameter_m:g} m thick: give it a diameter_m under a fifth of it"
            )

    @property
    def long_m(self) -> float:
        """How far it reaches from its root, m."""
        return self.length_m or self.height_m

    @cached_property
    def limbs(self) -> "tuple[Limb, ...]":
        """Its parts that bend, each after the one that it grows on."""
        return _limbs(self)

    @property
    def leaf_area_m2(self) -> float:
        """Of one leaf."""
        return FILLED * SLENDER * self.leaf_m**2

    def bodies(self, name: str) -> tuple[str, ...]:
        """The bodies that it is made of, the root first."""
        own = ((limb, f"{name}_{limb.name}") for limb in self.limbs)
        return (name, *(body for limb, one in own for body in ((one, f"{one}_leaves") if limb.leaves else (one,))))

    def joints(self, name: str) -> dict[str, str]:
        """Its joints, each with its kind; the root is held."""
        return {f"{name}_{limb.name}_{way}": "hinge" for limb in self.limbs for way in ("side", "up")}

    def actuators(self, _name: str) -> tuple[str, ...]:
        """It has none."""
        return ()

    def wood_kg(self, limb: "Limb") -> float:
        """Of the wood of a limb."""
        return max(self.wood_kg_m3 * pi / 4 * limb.mean_m**2 * limb.long_m, LIGHTEST_KG)

    def leaves_kg(self, limb: "Limb") -> float:
        """Of the leaves on a limb."""
        return LEAF_KG_M2 * self.leaf_area_m2 * len(limb.leaves)

    @property
    def mass_kg(self) -> float:
        """Of wood and leaves."""
        return sum(self.wood_kg(limb) + self.leaves_kg(limb) for limb in self.limbs)

    @property
    def box(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """The lowest and the highest corner around it, its root at the origin, m."""
        points = [(0.0, 0.0, 0.0), *(end for limb in self.limbs for end in (limb.tip, *limb.leaf_tips))]
        low, high = (tuple(pick(p[k] for p in points) for k in range(3)) for pick in (min, max))
        return low, high  # type: ignore[return-value]

    @property
    def extents(self) -> tuple[float, float, float]:
        """Full extents of the box around it, m."""
        low, high = self.box
        return (high[0] - low[0], high[1] - low[1], high[2] - low[2])

    @property
    def middle(self) -> tuple[float, float, float]:
        """Of the box around it, from its root, m."""
        low, high = self.box
        return ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2)


@dataclass(frozen=True)
class Bough(Plant):
    """A bough whose root is held, growing along x: what hangs into a picture, or is fixed to a trunk."""

    length_m: float = 1.6
    rises_deg: float = 12.0
    """How steeply it leaves its root; it bends down to level on its way."""
    parts: int = 6
    twigs: int = 12

    word = "bough"


@dataclass(frozen=True)
class Tree(Plant):
    """A young tree: a trunk that stands, boughs around it."""

    height_m: float = 4.0
    diameter_m: float = 0.09
    leaves: int = 1500
    leaf_m: float = 0.11
    parts: int = 4
    twigs: int = 28

    word = "tree"


@dataclass(frozen=True)
class Bush(Plant):
    """Several thin stems from one root."""

    height_m: float = 1.0
    diameter_m: float = 0.018
    leaves: int = 700
    leaf_m: float = 0.06
    parts: int = 7
    twigs: int = 21

    word = "bush"


@lru_cache(maxsize=32)
def _limbs(plant: Plant) -> "tuple[Limb, ...]":
    from .branching import grown

    found = grown(plant)
    if len(found) > MOST_BODIES:
        raise ValueError(f"a {plant.word} of {len(found)} limbs is too much to simulate: at most {MOST_BODIES}")
    return found
