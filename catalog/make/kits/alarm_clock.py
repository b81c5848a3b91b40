"""An alarm clock with two bells: a dial with numbers, hands that turn, three short feet."""

import math

from worldkit.joints import Hinge
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

R, Z, DEEP = 0.050, 0.068, 0.045
CASE = (
    crisp.turned(
        [
            (0.0, -DEEP / 2),
            (R - 0.006, -DEEP / 2),
            (R, -DEEP / 2 + 0.006),
            (R, DEEP / 2 - 0.003),
            (R - 0.002, DEEP / 2),
            (R - 0.006, DEEP / 2),
            (R - 0.006, DEEP / 2 - 0.005),
            (0.0, DEEP / 2 - 0.005),
        ]
    )
    .rotate(90, "y")
    .translate(z=Z)
)
FEET = crisp.together(
    *(
        crisp.wire([(x, y * 0.6, Z - 0.040), (x, y, 0.006)], 0.008, smooth=False)
        | crisp.ball(0.012).translate(x, y, 0.006)
        for x, y in ((0.010, -0.034), (0.010, 0.034), (-0.018, 0.0))
    )
)
BELL = crisp.lathe(
    [(0, 0.019), (0.012, 0.017), (0.021, 0.010), (0.025, 0.0), (0.0235, 0.0), (0.019, 0.009), (0, 0.016)]
)
STEM = crisp.cylinder(0.005, 0.05).translate(z=-0.034)
BELLS = (BELL | STEM | crisp.ball(0.007).translate(z=0.020)).translate(z=R + 0.020).rotate(38, "x").translate(z=Z)
BOW = crisp.wire(
    [
        (0, -0.024, Z + R + 0.016),
        (0, -0.016, Z + R + 0.034),
        (0, 0, Z + R + 0.040),
        (0, 0.016, Z + R + 0.034),
        (0, 0.024, Z + R + 0.016),
    ],
    0.004,
)
STRIKER = crisp.wire([(0, 0, Z + R - 0.004), (0, 0, Z + R + 0.016)], 0.003, smooth=False) | crisp.box(
    (0.006, 0.022, 0.008), 0.0015
).translate(z=Z + R + 0.018)
FACE = crisp.cylinder(2 * R - 0.0122, 0.001).rotate(90, "y").translate(x=DEEP / 2 - 0.0052, z=Z)


def paint(points, normals):
    """Minutes, hours, and the numbers from 1 to 12."""
    at = (0, 0, Z)
    rgb = brushes.over(brushes.plain(points, "#f8f4e6"), "#222222", brushes.dial(points, 60, 0.078, 0.084, 0.0006, at))
    rgb = brushes.over(rgb, "#111111", brushes.dial(points, 12, 0.075, 0.084, 0.0016, at))
    for hour in range(1, 13):
        turn = math.radians(30 * hour)
        centre = (DEEP / 2, 0.031 * math.sin(turn), Z + 0.031 * math.cos(turn))
        rgb = brushes.over(
            rgb,
            "#111111",
            brushes.label(
                points, str(hour), centre=centre, width=0.006 + 0.0045 * (hour > 9), facing="+x", normals=normals
            ),
        )
    return rgb, 0.5


def hand(length: float, wide: float, x: float, deg: float):
    """A pointed hand from the middle of the dial, turned clockwise by so many degrees from noon."""
    outline = [
        (-0.010, -wide / 3),
        (0.3 * length, -wide / 2),
        (length, 0),
        (0.3 * length, wide / 2),
        (-0.010, wide / 3),
    ]
    return crisp.slab(outline, 0.0008).rotate(-90, "y").rotate(-deg, "x").translate(x, 0, Z) | crisp.cylinder(
        0.005, 0.0012
    ).rotate(90, "y").translate(x - 0.0008, 0, Z)


PLATE = DEEP / 2 - 0.0042
KIT = Kit(
    "household",
    "Alarm clock with two bells and a round dial, at ten past ten",
    "typical twin-bell clock: 10 cm across, 16 cm high",
    "plastic",
    (
        part("case", CASE | FEET, "plastic", look="paint_red", hulls=12),
        part("face", FACE, "paper", "case", paint=paint, hulls="convex"),
        part("bells", BELLS.mirror("y") | BOW | STRIKER, "brass", "case", look="chrome"),
        part("hours", hand(0.022, 0.005, PLATE + 0.001, 305), "steel", "face", Hinge("hour", (PLATE, 0, Z), (-1, 0, 0), frictionloss=2e-3, damping=1e-5), look="steel_dark", hulls="convex"),
        part("minutes", hand(0.034, 0.0035, PLATE + 0.0022, 60), "steel", "face", Hinge("minute", (PLATE, 0, Z), (-1, 0, 0), frictionloss=2e-3, damping=1e-5), look="steel_dark", hulls="convex"),
    ),
)  # fmt: skip
