"""A windmill: a white tower with a cap, a door and windows, four lattice sails that turn."""

from worldkit.joints import Hinge
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

HUB, FRONT, SAIL = 0.335, 0.128, 0.24
TOWER = crisp.loft(
    [
        [(r * x, r * y, z) for x, y in crisp.ring(2.0, 8)]
        for r, z in ((0.125, 0.0), (0.125, 0.02), (0.110, 0.05), (0.075, 0.30))
    ]
)
CAP = crisp.lathe(
    [(0, 0), (0.090, 0), (0.090, 0.008), (0.078, 0.016), (0.070, 0.045), (0.045, 0.078), (0, 0.092)]
).translate(z=0.298)
SHAFT = crisp.wire([(0.03, 0, HUB), (FRONT, 0, HUB)], 0.024, smooth=False)
STOCK = crisp.box((0.009, 0.012, SAIL), 0.002).translate(0, 0, SAIL / 2)
BARS = [crisp.box((0.005, 0.056, 0.005)).translate(0, 0.024, 0.055 + 0.020 * k) for k in range(10)]
EDGES = [crisp.box((0.005, 0.005, 0.186)).translate(0, y, 0.145) for y in (0.024, 0.050)]
BLADE = crisp.together(STOCK, *BARS, *EDGES)
SAILS = (
    (crisp.around(BLADE, 4, "x") | crisp.cylinder(0.036, 0.024, 0.004).translate(z=-0.012).rotate(90, "y"))
    .rotate(20, "x")
    .translate(FRONT, 0, HUB)
)


def paint(points, normals):
    """White walls over a course of stone, a door and two windows to the front."""
    x, y, z = points.T
    rgb = brushes.over(brushes.plain(points, "#efeadd"), "#8a8378", z < 0.05)
    rgb = brushes.over(rgb, "#6b3a1e", (x > 0) & (abs(y) < 0.026) & (z < 0.085) & (z > 0.003))
    for height in (0.15, 0.23):
        rgb = brushes.over(rgb, "#ffffff", (x > 0) & (abs(y) < 0.018) & (abs(z - height) < 0.021))
        pane = (x > 0) & (abs(y) < 0.014) & (abs(z - height) < 0.017) & (abs(y) > 0.0015) & (abs(z - height) > 0.0015)
        rgb = brushes.over(rgb, "#27415a", pane)
    return rgb, 0.8


KIT = Kit(
    "building",
    "Windmill with a white tower and four lattice sails that turn",
    "a model of a tower mill at one to forty: 39 cm to its cap",
    "wood",
    (
        part("tower", TOWER, "wood", paint=paint, hulls="convex"),
        part("cap", CAP | SHAFT, "wood", "tower", look="wood_walnut"),
        part(
            "sails",
            SAILS,
            "wood",
            "cap",
            Hinge("axle", (FRONT, 0, HUB), (1, 0, 0), damping=2e-4, frictionloss=5e-4),
            look="wood_cherry",
            hulls="convex",
        ),
    ),
)
