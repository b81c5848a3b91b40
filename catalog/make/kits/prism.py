"""An equilateral prism of glass, upright on a round foot of wood."""

import math

from worldkit.sculpt import crisp

from ..kit import Kit, part

SIDE, LENGTH, FOOT = 0.050, 0.090, 0.012
HIGH = SIDE * math.sqrt(3) / 2
BAR = crisp.slab([(-HIGH / 3, -SIDE / 2), (2 * HIGH / 3, 0), (-HIGH / 3, SIDE / 2)], LENGTH, bevel=0.0012).rotate(25)
BASE = crisp.slab(crisp.ring(0.076, 36), FOOT, bevel=0.002)

KIT = Kit(
    "science",
    "Glass prism, equilateral, for splitting light into its colours, upright on a wooden foot",
    "typical optics prism: 50 mm sides, 90 to 150 mm long",
    "wood",
    (
        part("foot", BASE, "wood", look="wood_ebony", hulls="convex"),
        part("bar", BAR.translate(z=FOOT), "glass", "foot", look="glass_blue", hulls="convex"),
    ),
)
