"""A seesaw: a plank with two seats and handles on a trestle, turning on a bar."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

LONG, AXLE = 2.6, 0.50
PLANK = crisp.box((LONG, 0.22, 0.045), 0.006).translate(z=AXLE + 0.045)
HANDLE = crisp.wire(
    [(0, -0.10, 0.0), (0, -0.10, 0.20), (0, -0.06, 0.25), (0, 0.06, 0.25), (0, 0.10, 0.20), (0, 0.10, 0.0)], 0.028
)
HANDLES = crisp.together(*(HANDLE.translate(x, 0, AXLE + 0.06) for x in (-0.80, 0.80)))
SEATS = crisp.together(*(crisp.box((0.30, 0.26, 0.03), 0.008).translate(x, 0, AXLE + 0.081) for x in (-1.10, 1.10)))
LEG = crisp.wire([(0, 0.17, AXLE), (0.30, 0.24, 0.02)], 0.05, smooth=False)
TRESTLE = crisp.together(
    LEG.mirror("x").mirror("y"),
    crisp.wire([(0, -0.20, AXLE), (0, 0.20, AXLE)], 0.05, smooth=False),
    *(crisp.box((0.72, 0.06, 0.03), 0.006).translate(0, y, 0.015) for y in (-0.24, 0.24)),
    crisp.box((0.06, 0.48, 0.03), 0.006).translate(z=0.015),
)

KIT = Kit(
    "playground",
    "Seesaw: a plank on a pivot with handles",
    "typical playground seesaw: plank of 2.6 m, half a metre high",
    "wood",
    (
        part("trestle", TRESTLE, "steel", look="paint_green"),
        part(
            "plank",
            PLANK,
            "pine",
            "trestle",
            Hinge("tilt", (0, 0, AXLE), (0, 1, 0), range_deg=(-20, 20), damping=3.0, frictionloss=6.0),
            hulls="convex",
        ),
        part("seats", SEATS, "wood", "plank", look="paint_red"),
        part("handles", HANDLES, "steel", "plank", look="paint_blue", density=1500),
    ),
)
