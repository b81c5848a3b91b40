"""A red balloon with its knot, on a stick in a round foot."""

from worldkit.sculpt import crisp

from ..kit import Kit, part
from ..stands import disc_foot

SKIN = [
    (0, 0.006),
    (0.006, 0.008),
    (0.030, 0.035),
    (0.075, 0.090),
    (0.106, 0.155),
    (0.115, 0.205),
    (0.104, 0.255),
    (0.070, 0.294),
    (0.030, 0.311),
    (0, 0.314),
]
KNOT = crisp.lathe([(0, -0.012), (0.010, -0.012), (0.0045, -0.002), (0.0065, 0.003), (0.004, 0.010), (0, 0.010)])
BALLOON = crisp.lathe(SKIN, smooth=True) | KNOT
AIR = 3.5  # kg/m^3: a skin of 0.2 mm over 0.16 m^2 weighs 30 g, spread over 9 l; the air in it floats in air

KIT = Kit(
    "party",
    "Red balloon, tied, on a stick with a foot",
    "party balloon of 11 inches, blown to 23 cm",
    "wood",
    (
        part("foot", disc_foot(0.14, 0.012, 0.006, 0.30), "wood", look="plastic_white"),
        part("balloon", BALLOON.translate(z=0.30), "rubber", "foot", look="plastic_red", hulls="convex", density=AIR),
    ),
)
