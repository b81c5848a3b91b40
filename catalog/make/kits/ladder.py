"""A stepladder of aluminium: five treads, a support that folds, a platform."""

import math

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

HIGH, LEAN, TREADS = 1.12, 15.0, 5
OUT = HIGH * math.tan(math.radians(LEAN))


def leg(x: float, wide: float):
    """A rail on each side, from the floor to the top."""
    rail = crisp.sweep(
        [(-0.011, -0.026), (0.011, -0.026), (0.011, 0.026), (-0.011, 0.026)],
        [(x, wide, 0.03), (0, wide - 0.07, HIGH)],
        smooth=False,
    )
    shoe = crisp.box((0.062, 0.034, 0.045), 0.004).translate(x - 0.003, wide - 0.001, 0.0225)
    return rail.mirror("y"), shoe.mirror("y")


def tread(number: int):
    """A step, level, between the rails of the front."""
    share = (number + 1) / (TREADS + 1)
    return crisp.box((0.085, 2 * (0.23 - 0.07 * share) + 0.01, 0.022), 0.003).translate(
        OUT * (1 - share), 0, HIGH * share
    )


FRONT, SHOES = leg(OUT, 0.23)
BACK, BACK_SHOES = leg(-OUT * 0.9, 0.21)
BARS = crisp.together(
    *(
        crisp.box((0.022, 2 * (0.21 - 0.07 * s), 0.022), 0.002).translate(-0.9 * OUT * (1 - s), 0, HIGH * s)
        for s in (0.2, 0.5, 0.8)
    )
)
TOP = crisp.box((0.20, 0.40, 0.030), 0.006).translate(0.02, 0, HIGH + 0.012)

KIT = Kit(
    "tool",
    "Stepladder of aluminium with five treads",
    "typical household stepladder: 1.1 m to its platform",
    "rubber",
    (
        part("front", crisp.together(FRONT, *map(tread, range(TREADS))), "aluminium", hulls=24, density=900),
        part("front_shoes", SHOES, "rubber", "front"),
        part("platform", TOP, "plastic", "front", look="plastic_orange", hulls="convex"),
        part(
            "back",
            BACK | BARS,
            "aluminium",
            "front",
            Hinge("fold", (0, 0, HIGH), (0, 1, 0), range_deg=(-28, 0), frictionloss=4.0, damping=0.2),
            density=900,
        ),
        part("back_shoes", BACK_SHOES, "rubber", "back"),
    ),
)
