"""A catapult on four wheels: a throwing arm with a bowl on a twisted rope, and a bar that stops it."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

W, AXLE, R = 0.11, 0.10, 0.07
RAIL = crisp.box((0.56, 0.04, 0.06), 0.004)
POST = crisp.box((0.04, 0.04, 0.30), 0.004)
STRUT = crisp.wire([(-0.22, 0, 0.13), (0.06, 0, 0.36)], 0.030, smooth=False)
BARS = crisp.together(
    *(crisp.box((0.04, 2 * W, 0.04), 0.004).translate(x, 0, z) for x, z in ((-0.25, AXLE), (0.25, AXLE), (0.08, 0.395)))
)
FRAME = crisp.together(
    *(RAIL.translate(0, y, AXLE) | POST.translate(0.08, y, AXLE + 0.16) | STRUT.translate(0, y, 0) for y in (-W, W)),
    BARS,
    *(crisp.wire([(x, -0.165, R), (x, 0.165, R)], 0.022, smooth=False) for x in (-0.2, 0.2)),
)
ROPE = crisp.wire([(0.0, -W, 0.135), (0.0, W, 0.135)], 0.034, smooth=False)
ARM = crisp.wire([(0.0, 0, 0.135), (-0.30, 0, 0.42)], 0.026, smooth=False)
BOWL = (
    crisp.turned([(0, 0), (0.03, 0.004), (0.055, 0.03), (0.050, 0.03), (0.028, 0.010), (0, 0.006)])
    .rotate(-20, "y")
    .translate(-0.300, 0, 0.413)
)
TYRE = crisp.cylinder(2 * R, 0.03, 0.003) - crisp.around(crisp.cylinder(0.032, 0.1).translate(0.042, 0, -0.03), 6)
WHEEL = (TYRE | crisp.cylinder(0.035, 0.044, 0.004).translate(z=-0.007)).translate(z=-0.015).rotate(90, "x")


def wheel(x: float, y: float):
    """A wheel on its axle, with friction that keeps it where it is left."""
    name = f"wheel_{'front' if x > 0 else 'back'}_{'left' if y > 0 else 'right'}"
    return part(
        name,
        WHEEL.translate(x, y, R),
        "wood",
        "frame",
        Hinge(f"{name}_axle", (x, y, R), (0, 1, 0), damping=0.01, frictionloss=0.08),
        look="wood_walnut",
        hulls="convex",
    )


KIT = Kit(
    "siege",
    "Catapult on four wheels with a throwing arm and a cup",
    "a model at one to six of a Roman onager: 65 cm long",
    "wood",
    (
        part("frame", FRAME, "oak"),
        part("rope", ROPE, "fabric", "frame", look="fabric_linen", hulls="convex"),
        part(
            "arm",
            ARM | BOWL,
            "wood",
            "frame",
            Hinge("throw", (0, 0, 0.135), (0, 1, 0), range_deg=(-8, 60), damping=0.02, frictionloss=2.0),
            look="wood_walnut",
            hulls=12,
        ),
        *(wheel(x, y) for x in (-0.2, 0.2) for y in (-0.15, 0.15)),
    ),
)
