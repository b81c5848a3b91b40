"""A bell jar: a dome of glass with a knob over a turned base, which can be lifted off."""

from worldkit.joints import Slide
from worldkit.sculpt import crisp

from ..kit import Kit, part

WALL = [
    (0.088, 0.0),
    (0.092, 0.0),
    (0.088, 0.006),
    (0.088, 0.16),
    (0.080, 0.205),
    (0.055, 0.238),
    (0.020, 0.252),
    (0.0, 0.254),
]
INSIDE = [(0.0, 0.2505), (0.019, 0.2485), (0.0535, 0.235), (0.0775, 0.203), (0.085, 0.16), (0.085, 0.0)]
KNOB = crisp.lathe(
    [(0.007, 0), (0.006, 0.008), (0.013, 0.016), (0.016, 0.026), (0.012, 0.036), (0, 0.040)], smooth=True
).translate(z=0.251)
DOME = crisp.turned([*WALL, *INSIDE]) | KNOB
BASE = crisp.lathe(
    [
        (0, 0),
        (0.105, 0),
        (0.110, 0.004),
        (0.110, 0.012),
        (0.100, 0.020),
        (0.095, 0.020),
        (0.095, 0.017),
        (0.084, 0.017),
        (0.084, 0.024),
        (0, 0.024),
    ]
)

KIT = Kit(
    "science",
    "Bell jar of glass with a knob, on a wooden base",
    "typical bell jar: 18 cm across, 31 cm high",
    "wood",
    (
        part("base", BASE, "wood", look="wood_walnut", hulls="convex"),
        part(
            "dome",
            DOME.translate(z=0.0178),
            "glass",
            "base",
            Slide("lift", axis=(0, 0, 1), range_m=(0.0, 0.4), damping=2.0),
            hulls=16,
        ),
    ),
)
