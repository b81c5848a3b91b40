"""A desk lamp: a foot, two arms on hinges with friction, a shade that tilts, its bulb alight."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

FOOT, ELBOW, WRIST = (-0.10, 0, 0.042), (-0.19, 0, 0.32), (0.045, 0, 0.475)


def arm(start, end):
    """Two rods side by side, a bolt across each end."""
    rods = crisp.wire([start, end], 0.008, smooth=False).translate(y=0.012).mirror("y")
    bolts = crisp.cylinder(0.014, 0.042, 0.002).translate(z=-0.021).rotate(90, "x")
    return crisp.together(rods, bolts.translate(*start), bolts.translate(*end))


BASE = crisp.lathe(
    [(0, 0), (0.088, 0), (0.090, 0.003), (0.090, 0.012), (0.082, 0.020), (0.02, 0.024), (0, 0.024)]
).translate(x=-0.06) | crisp.box((0.022, 0.014, 0.045), 0.003).translate(-0.10, 0, 0.035)
SHELL = [
    (0.016, 0.070),
    (0.022, 0.066),
    (0.030, 0.030),
    (0.066, -0.045),
    (0.0675, -0.045),
    (0.0675, -0.043),
    (0.033, 0.032),
    (0.025, 0.070),
    (0.016, 0.082),
]
SHADE = (crisp.turned(SHELL) | crisp.cylinder(0.040, 0.024, 0.003).translate(z=0.064)).rotate(-24, "y")
STEM = crisp.wire([WRIST, (0.105, 0, 0.478)], 0.012, smooth=False)
AT = (0.118, 0, 0.418)
BULB = (crisp.ball(0.052).translate(z=-0.012) | crisp.cylinder(0.026, 0.06).translate(z=0.0)).rotate(-24, "y")

KIT = Kit(
    "lighting",
    "Desk lamp with two jointed arms, alight",
    "typical architect's lamp: half a metre high",
    "steel",
    (
        part("base", BASE, "steel", look="paint_red"),
        part(
            "lower_arm",
            arm(FOOT, ELBOW),
            "aluminium",
            "base",
            Hinge("shoulder", FOOT, (0, 1, 0), range_deg=(-40, 60), frictionloss=2.5, damping=0.02),
            look="chrome",
        ),
        part(
            "upper_arm",
            arm(ELBOW, WRIST),
            "aluminium",
            "lower_arm",
            Hinge("elbow", ELBOW, (0, 1, 0), range_deg=(-70, 50), frictionloss=2.0, damping=0.02),
            look="chrome",
        ),
        part(
            "shade",
            SHADE.translate(*AT) | STEM,
            "steel",
            "upper_arm",
            Hinge("wrist", WRIST, (0, 1, 0), range_deg=(-50, 60), frictionloss=0.8, damping=0.01),
            look="paint_red",
            hulls=20,
            density=3000,
        ),
        part("bulb", BULB.translate(*AT), "glass", "shade", look="lamp_warm", hulls="convex", density=300),
    ),
)
