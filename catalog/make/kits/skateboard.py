"""A skateboard: a deck of maple with grip on top, two trucks, four wheels that turn."""

from worldkit.joints import Hinge
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

R, BASE, TRACK, DECK = 0.026, 0.36, 0.082, 0.086
LINE = [
    (-0.395, 0, 0.048),
    (-0.33, 0, 0.018),
    (-0.26, 0, 0.001),
    (-0.15, 0, 0),
    (0, 0, 0),
    (0.15, 0, 0),
    (0.26, 0, 0.001),
    (0.33, 0, 0.018),
    (0.395, 0, 0.048),
]
WIDE = [0.45, 0.93, 1.0, 1.0, 1.0, 1.0, 1.0, 0.93, 0.45]
BOARD = crisp.sweep([(-0.1, -0.0055), (0.1, -0.0055), (0.1, 0.0055), (-0.1, 0.0055)], LINE, scales=WIDE) & crisp.box(
    (0.79, 0.3, 0.3)
).translate(z=0.0)
ENDS = crisp.cylinder(0.20, 0.4).translate(z=-0.2)
SHAPE = crisp.together(ENDS.translate(x=0.29), ENDS.translate(x=-0.29), crisp.box((0.58, 0.20, 0.4)))


def paint(points, normals):
    """Black grip above, red below, the plies at the edge."""
    rgb = brushes.over(brushes.plain(points, "#c9a26b"), "#262628", normals[:, 2] > 0.6)
    rgb = brushes.over(rgb, "#b3202a", normals[:, 2] < -0.6)
    return rgb, 0.75


TRUCK = crisp.together(
    crisp.box((0.085, 0.055, 0.010), 0.002).translate(z=DECK - 0.0125),
    crisp.lathe([(0.020, 0), (0.012, 0.034)]).translate(z=0.042),
    crisp.box((0.028, 0.13, 0.016), 0.003).translate(z=R + 0.008),
    crisp.cylinder(0.008, 2 * TRACK + 0.044).translate(z=-TRACK - 0.022).rotate(90, "x").translate(z=R),
)
TYRE = crisp.lathe(
    [(0.018, -0.016), (R - 0.002, -0.015), (R, -0.011), (R, 0.011), (R - 0.002, 0.015), (0.018, 0.016)]
).rotate(90, "x")


def wheel(x: float, y: float):
    """A wheel on its axle; its bearing holds it where the floor is level."""
    name = f"wheel_{'front' if x > 0 else 'back'}_{'left' if y > 0 else 'right'}"
    return part(
        name,
        TYRE.translate(x, y, R),
        "rubber",
        "trucks",
        Hinge(f"{name}_axle", (x, y, R), (0, 1, 0), damping=2e-5, frictionloss=2.5e-3),
        look="plastic_white",
        hulls="convex",
    )


KIT = Kit(
    "sport",
    "Skateboard with four wheels",
    "typical street deck: 79 x 20 cm, wheels of 52 mm",
    "wood",
    (
        part("deck", BOARD.translate(z=DECK) & SHAPE, "wood", paint=paint, hulls=5),
        part(
            "trucks",
            crisp.together(TRUCK.translate(x=BASE / 2), TRUCK.translate(x=-BASE / 2)),
            "aluminium",
            "deck",
            hulls=8,
        ),
        *(wheel(x, y) for x in (-BASE / 2, BASE / 2) for y in (-TRACK, TRACK)),
    ),
)
