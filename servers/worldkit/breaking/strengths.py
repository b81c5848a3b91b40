"""What things that break are made of."""

from typing import NamedTuple


class Brittle(NamedTuple):
    """A material that breaks without bending for good."""

    strength_pa: float
    """The tension at which it breaks, Pa: in bending where that is what is measured (modulus of rupture)."""
    density: float
    """kg/m^3."""
    look: str
    friction: float
    source: str


MATERIALS = {
    "glass": Brittle(45e6, 2500.0, "glass_clear", 0.4, "EN 572-1, float glass: 45 MPa characteristic bending strength"),
    "tempered_glass": Brittle(120e6, 2500.0, "glass_clear", 0.4, "EN 12150-1: 120 MPa"),
    "porcelain": Brittle(60e6, 2400.0, "ceramic_white", 0.4, "IEC 60672-3, C 110 unglazed: 50 MPa and more"),
    "earthenware": Brittle(15e6, 1900.0, "ceramic_terracotta", 0.5, "handbooks on clay ware, porous body: 10 to 20 MPa in bending"),
    "brick": Brittle(5e6, 1900.0, "brick", 0.6, "masonry handbooks, modulus of rupture of clay brick: 3 to 8 MPa"),
    "ice": Brittle(1.7e6, 917.0, "ice", 0.05, "Petrovic 2003, Review of mechanical properties of ice and snow: 1.73 MPa in bending at -10 C"),
    "chalk": Brittle(3e6, 1400.0, "#f2f0ea", 0.5, "gypsum of blackboard chalk, three-point bending: 2 to 4 MPa"),
    "dry_twig": Brittle(50e6, 550.0, "bark", 0.5, "Wood Handbook (FPL-GTR-282), modulus of rupture of softwoods: 45 to 80 MPa green to dry"),
    "chocolate": Brittle(1.5e6, 1300.0, "#3d2216", 0.5, "three-point bending of dark chocolate at 20 C: 1 to 3 MPa; measure yours"),
}  # fmt: skip
"""By name; a plan states the number that it relies on among its `constants`."""


def material(name: str) -> Brittle:
    """A material by its name.

    Raises:
        ValueError: there is none; the message lists those that are.
    """
    if name not in MATERIALS:
        raise ValueError(f"no breakable material is called {name!r}; known: {', '.join(MATERIALS)}; or give a Brittle")
    return MATERIALS[name]
