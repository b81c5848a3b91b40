"""A pendulum: a brass bob on a thin rod, hung from a stand on a hinge."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part
from ..stands import gallows

HANG, LOW, AT = 0.46, 0.10, 0.12
ROD = crisp.wire([(0, AT, LOW), (0, AT, HANG - 0.002)], 0.0022, smooth=False)
BOB = crisp.ball(0.044) | crisp.cylinder(0.008, 0.012, 0.001).translate(z=0.017)
EYE = crisp.torus(0.014, 0.003).rotate(90, "x").translate(0, AT, HANG - 0.004)

KIT = Kit(
    "science",
    "Pendulum: a brass bob swinging from a stand",
    "typical school demonstration: half a metre high, bob of 44 mm",
    "iron",
    (
        part("stand", gallows(HANG, 2 * AT, 0.16, 0.012), "iron", look="paint_grey"),
        part("rod", ROD | EYE, "steel", "stand", Hinge("swing", (0, AT, HANG), (1, 0, 0), damping=2e-5)),
        part("bob", BOB.translate(0, AT, LOW), "brass", "rod", hulls="convex"),
    ),
)
