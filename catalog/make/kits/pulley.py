"""A pulley on a stand: its wheel turns, a rope lies in the groove and holds a weight on each side."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part
from ..stands import gallows

R, AXLE, ROPE = 0.05, 0.36, 0.005
GROOVE = [
    (0.006, -0.008),
    (R + 0.008, -0.008),
    (R + 0.008, -0.006),
    (R, -0.0015),
    (R, 0.0015),
    (R + 0.008, 0.006),
    (R + 0.008, 0.008),
    (0.006, 0.008),
]
HOLES = crisp.around(crisp.cylinder(0.019, 0.04).translate(0.029, 0, -0.02), 5)
WHEEL = (crisp.turned(GROOVE) - HOLES).rotate(90, "y").translate(z=AXLE)
FRAME = crisp.together(
    gallows(0.46, 0.24, 0.14, 0.014).translate(y=-0.12),
    crisp.box((0.14, 0.42, 0.014), 0.003).translate(y=-0.07, z=0.007),
    *(crisp.box((0.003, 0.02, 0.12), 0.001).translate(x, 0, AXLE + 0.045) for x in (-0.013, 0.013)),
    crisp.box((0.03, 0.024, 0.014), 0.002).translate(z=AXLE + 0.106),
    crisp.cylinder(0.009, 0.05, 0.001).translate(z=-0.025).rotate(90, "y").translate(z=AXLE),
)
TOP = [
    (0, y, AXLE + z)
    for y, z in (
        (-0.0525, -0.17),
        (-0.0525, 0),
        (-0.037, 0.037),
        (0, 0.0525),
        (0.037, 0.037),
        (0.0525, 0),
        (0.0525, -0.12),
    )
]
WEIGHT = crisp.together(
    crisp.cylinder(0.036, 0.05, 0.003),
    crisp.cylinder(0.010, 0.064, 0.002),
    crisp.torus(0.016, 0.004).rotate(90, "y").translate(z=0.07),
).translate(z=-0.074)

KIT = Kit(
    "science",
    "Pulley on a stand, a rope over its wheel with a weight on each side",
    "typical school demonstration: 10 cm wheel on a half-metre stand",
    "iron",
    (
        part("frame", FRAME, "iron", look="paint_blue"),
        part("wheel", WHEEL, "wood", "frame", Hinge("axle", (0, 0, AXLE), (1, 0, 0), damping=2e-4), hulls="convex"),
        part("rope", crisp.wire(TOP, ROPE), "fabric", "frame", look="fabric_linen"),
        part("left", WEIGHT.translate(0, -0.0525, AXLE - 0.165), "brass", "rope", hulls="convex"),
        part("right", WEIGHT.translate(0, 0.0525, AXLE - 0.115), "brass", "rope", hulls="convex"),
    ),
)
