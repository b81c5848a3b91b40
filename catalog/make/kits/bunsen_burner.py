"""A Bunsen burner: a heavy foot, a barrel with an air collar that turns, a gas nozzle, a blue flame."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

FOOT = crisp.lathe(
    [(0, 0), (0.042, 0), (0.044, 0.003), (0.044, 0.007), (0.036, 0.012), (0.014, 0.020), (0.010, 0.030), (0, 0.030)]
)
NOZZLE = (
    crisp.lathe(
        [(0.0045, 0), (0.0045, 0.03), (0.006, 0.032), (0.0045, 0.036), (0.006, 0.040), (0.0045, 0.044), (0.0040, 0.055)]
    )
    .rotate(90, "y")
    .translate(x=0.006, z=0.028)
)
BARREL = crisp.turned(
    [(0.0045, 0.0), (0.0068, 0.0), (0.0068, 0.098), (0.0078, 0.100), (0.0078, 0.106), (0.0052, 0.106), (0.0052, 0.0)]
).translate(z=0.03)
HOLES = crisp.cylinder(0.008, 0.06).translate(z=-0.03).rotate(90, "y")
COLLAR = crisp.turned([(0.0072, 0), (0.0105, 0), (0.0105, 0.020), (0.0072, 0.020)]) - HOLES.translate(z=0.010)
OUTER = crisp.lathe(
    [(0, 0), (0.0065, 0.001), (0.0085, 0.014), (0.0075, 0.035), (0.0035, 0.062), (0, 0.078)], smooth=True
)

KIT = Kit(
    "science",
    "Bunsen burner with an air collar, burning with a blue flame",
    "typical laboratory burner: 14 cm high, foot of 9 cm",
    "iron",
    (
        part("foot", FOOT, "iron", look="steel_dark", hulls="convex"),
        part("nozzle", NOZZLE, "brass", "foot", hulls="convex"),
        part("barrel", BARREL, "brass", "foot", hulls="convex"),
        part(
            "collar",
            COLLAR.translate(z=0.040),
            "brass",
            "barrel",
            Hinge("air", (0, 0, 0.05), (0, 0, 1), frictionloss=0.003, damping=1e-4),
            look="chrome",
            hulls="convex",
        ),
        part("flame", OUTER.translate(z=0.134), "foam", "barrel", look="screen_blue", hulls="convex", density=1.0),
    ),
)
