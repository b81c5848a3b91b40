"""A gyroscope in gimbals: a heavy rotor in a ring in a ring, all three turning, on a foot."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part
from ..stands import disc_foot

Z = 0.155
RIM = [
    (0.024, -0.004),
    (0.034, -0.012),
    (0.044, -0.012),
    (0.046, -0.010),
    (0.046, 0.010),
    (0.044, 0.012),
    (0.034, 0.012),
    (0.024, 0.004),
]
HUB = [
    (0, -0.052),
    (0.003, -0.050),
    (0.003, -0.012),
    (0.010, -0.010),
    (0.010, 0.010),
    (0.003, 0.012),
    (0.003, 0.050),
    (0, 0.052),
]
SPOKES = crisp.around(crisp.box((0.05, 0.007, 0.006), 0.001).translate(x=0.016), 4)
ROTOR = crisp.together(crisp.turned(RIM), crisp.lathe(HUB), SPOKES)


def band(inner: float, wide: float):
    """A flat ring that stands upright."""
    return crisp.turned([(inner, -wide), (inner + 0.004, -wide), (inner + 0.004, wide), (inner, wide)])


PIN = crisp.cylinder(0.006, 0.016, 0.001)
INNER = crisp.together(
    band(0.052, 0.006).rotate(90, "x"), *(PIN.rotate(a, "y").translate(x) for a, x in ((90, 0.052), (-90, -0.052)))
)
OUTER = crisp.together(band(0.066, 0.006).rotate(90, "x"), PIN.translate(z=-0.084))
FOOT = disc_foot(0.13, 0.014, 0.016, Z - 0.078)
PARTS = (
    part("foot", FOOT, "iron", look="wood_ebony"),
    part(
        "outer", OUTER.translate(z=Z), "steel", "foot", Hinge("turn", (0, 0, Z), (0, 0, 1), damping=1e-5), look="chrome"
    ),
    part("inner", INNER.translate(z=Z), "brass", "outer", Hinge("tilt", (0, 0, Z), (1, 0, 0), damping=1e-5)),
    part(
        "rotor",
        ROTOR.translate(z=Z),
        "brass",
        "inner",
        Hinge("spin", (0, 0, Z), (0, 0, 1), damping=2e-6),
        hulls="convex",
    ),
)

KIT = Kit(
    "science",
    "Gyroscope in gimbals: a brass rotor that turns in two rings on a foot",
    "typical demonstration gyroscope: rotor of 9 cm, 23 cm high",
    "iron",
    PARTS,
)
