"""An overshot water wheel of wood between two trestles, its chute above it."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

R, AXLE, WIDE, PADDLES = 0.42, 0.52, 0.24, 12
HOOP = crisp.turned([(R - 0.10, -0.012), (R, -0.012), (R, 0.012), (R - 0.10, 0.012)])
SPOKES = crisp.around(crisp.box((R - 0.08, 0.045, 0.022), 0.003).translate(x=(R - 0.08) / 2), 6)
SIDE = crisp.together(HOOP, SPOKES)
PADDLE = crisp.box((0.115, 0.016, WIDE), 0.002).rotate(25).translate(x=R - 0.048)
WHEEL = (
    crisp.together(
        SIDE.translate(z=WIDE / 2),
        SIDE.translate(z=-WIDE / 2),
        crisp.around(PADDLE, PADDLES),
        crisp.cylinder(0.07, 0.46, 0.006).translate(z=-0.23),
    )
    .rotate(90, "x")
    .translate(z=AXLE)
)
LEG = crisp.wire([(0.26, 0.20, 0.02), (0.02, 0.20, AXLE)], 0.055, smooth=False)
TRESTLE = crisp.together(
    LEG.mirror("x"),
    crisp.box((0.66, 0.06, 0.05), 0.004).translate(0, 0.20, 0.025),
    crisp.box((0.11, 0.05, 0.10), 0.006).translate(0, 0.20, AXLE - 0.02),
).mirror("y")
TIES = crisp.together(*(crisp.box((0.05, 0.40, 0.05), 0.004).translate(x, 0, 0.025) for x in (-0.28, 0.28)))
CHUTE = crisp.box((0.60, 0.22, 0.09), 0.003) - crisp.box((0.70, 0.18, 0.09)).translate(z=0.02)
POSTS = crisp.together(
    *(crisp.wire([(-0.56, y, 0), (-0.56, y, 1.02)], 0.05, smooth=False) for y in (-0.165, 0.165)),
    crisp.box((0.05, 0.38, 0.04), 0.004).translate(-0.56, 0, 0.97),
    crisp.box((0.30, 0.05, 0.05)).translate(-0.42, 0.2, 0.025).mirror("y"),
)

KIT = Kit(
    "machine",
    "Water wheel of wood, overshot, with its chute",
    "a garden mill: wheel of 84 cm",
    "wood",
    (
        part("trestle", crisp.together(TRESTLE, TIES, POSTS), "oak"),
        part("chute", CHUTE.translate(-0.36, 0, 1.03), "wood", "trestle", look="wood_pine", hulls=6),
        part(
            "wheel",
            WHEEL,
            "wood",
            "trestle",
            Hinge("axle", (0, 0, AXLE), (0, 1, 0), damping=0.05, frictionloss=0.1),
            look="wood_walnut",
            hulls="convex",
            triangles=8000,
        ),
    ),
)
