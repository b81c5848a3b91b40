"""A pair of scissors lying half open: two blades on a rivet, a ring for the thumb and one for the fingers."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

OPEN, T = 13, 0.0022
OUTLINE = [
    (0.115, 0.0005),
    (0.10, 0.006),
    (0.02, 0.0095),
    (-0.012, 0.0085),
    (-0.030, 0.004),
    (-0.034, -0.005),
    (-0.008, -0.008),
    (0.02, -0.001),
    (0.115, -0.0012),
]
BLADE = crisp.slab(OUTLINE, T)
RIVET = crisp.cylinder(0.009, 2 * T + 0.0024, 0.0008).translate(z=-0.0008)


def grip(long: float, wide: float):
    """A loop of plastic round the shank, lying on the floor with the middle of its wire on the blade."""
    loop = [
        (0.0, 0.0),
        (-0.30 * long, -0.42 * wide),
        (-0.72 * long, -0.5 * wide),
        (-long, -0.05 * wide),
        (-0.75 * long, 0.42 * wide),
        (-0.30 * long, 0.36 * wide),
        (0.0, 0.0),
    ]
    ring = crisp.wire([(x, y, 0) for x, y in loop], 0.0095)
    return (
        (ring | crisp.wire([(0.022, 0.001, 0), (0.0, 0.0, 0)], 0.0095, smooth=False))
        .rotate(14)
        .translate(-0.036, -0.001, 0)
    )


ONE = grip(0.055, 0.040)
OTHER = grip(0.068, 0.048)
Z = 0.0048
LOWER, UPPER = BLADE.translate(z=Z - T), BLADE.rotate(180, "x").translate(z=Z + T)

KIT = Kit(
    "tool",
    "Scissors with plastic grips, half open",
    "typical household scissors: 21 cm long",
    "plastic",
    (
        part("lower", LOWER.rotate(OPEN) | RIVET.translate(z=Z - T), "steel", look="chrome"),
        part("lower_grip", ONE.rotate(OPEN).translate(z=Z), "plastic", "lower", look="plastic_orange"),
        part(
            "upper",
            UPPER.rotate(-OPEN),
            "steel",
            "lower",
            Hinge("rivet", (0, 0, Z), (0, 0, 1), range_deg=(-30, 26), frictionloss=0.02, damping=2e-4),
            look="chrome",
        ),
        part(
            "upper_grip", OTHER.rotate(180, "x").rotate(-OPEN).translate(z=Z), "plastic", "upper", look="plastic_orange"
        ),
    ),
)
