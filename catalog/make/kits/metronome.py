"""A metronome: a pyramid of wood with an open front, a rod that swings over its scale, a weight on the rod."""

from worldkit.joints import Hinge, Slide
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

LOW, TOP, HIGH, PIVOT = 0.060, 0.026, 0.215, 0.045


def square(half: float, z: float):
    """A section of the pyramid."""
    return [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]


BODY = crisp.loft([square(LOW, 0.012), square(TOP, HIGH)]) | crisp.loft(
    [square(0.066, 0), square(0.066, 0.010), square(0.062, 0.014)]
)
BODY |= crisp.box((0.046, 0.046, 0.010), 0.002).translate(z=HIGH + 0.004)
CUT = crisp.box((0.05, 0.060, 0.17)).rotate(-9.5, "y").translate(x=0.0575, z=0.12)
FACE = crisp.box((0.003, 0.055, 0.136), 0.0008).rotate(-9.5, "y").translate(x=0.0322, z=0.12)
ROD = crisp.wire([(0.052, 0, PIVOT - 0.02), (0.026, 0, 0.212)], 0.003, smooth=False)
ALONG = (0.026 - 0.052, 0.0, 0.212 - (PIVOT - 0.02))
HUB = crisp.cylinder(0.012, 0.012, 0.002).rotate(90, "y").translate(x=0.042, z=PIVOT)
BOB = (
    crisp.slab([(-0.010, -0.010), (0.010, -0.010), (0.013, 0.010), (-0.013, 0.010)], 0.006, bevel=0.0015)
    .rotate(90, "x")
    .rotate(90, "z")
    .translate(x=0.036, z=0.16)
)


def paint(points, normals):
    """A scale of tempi: ticks to both sides of the middle."""
    y, z = points[:, 1], points[:, 2]
    rgb = brushes.plain(points, "#f3ead0")
    ticks = brushes.stripes(z, 0.008, 0.14) * (abs(y) > 0.006) * (abs(y) < 0.018) * (z > 0.06) * (z < 0.2)
    return brushes.over(rgb, "#20160c", ticks), 0.5


KIT = Kit(
    "music",
    "Wooden metronome with a swinging rod and a sliding weight",
    "typical pyramid metronome: 22 cm high",
    "wood",
    (
        part("body", BODY - CUT, "wood", look="wood_walnut"),
        part("scale", FACE, "plastic", "body", paint=paint, hulls="convex"),
        part(
            "rod",
            ROD | HUB,
            "steel",
            "body",
            Hinge("beat", (0.04, 0, PIVOT), (1, 0, 0), range_deg=(-28, 28), stiffness=0.085, damping=1e-4),
            look="chrome",
        ),
        part(
            "weight",
            BOB,
            "brass",
            "rod",
            Slide("tempo", axis=ALONG, range_m=(-0.07, 0.03), frictionloss=1.0, damping=100.0),
            hulls="convex",
        ),
    ),
)
