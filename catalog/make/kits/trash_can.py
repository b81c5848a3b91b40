"""A trash can of ribbed, galvanised steel with two handles and a lid that lifts off."""

from math import cos, pi, sin

from worldkit.joints import Slide
from worldkit.sculpt import crisp

from ..kit import Kit, part

LOW, TOP, HIGH, RIBS = 0.205, 0.245, 0.62, 36
"""Radii at the bottom and the rim, and the height, m."""


def outline(r: float) -> list[tuple[float, float]]:
    """A ribbed circle about so wide."""
    turns = (2 * pi * k / (6 * RIBS) for k in range(6 * RIBS))
    return [((r + 0.0035 * cos(RIBS * a)) * cos(a), (r + 0.0035 * cos(RIBS * a)) * sin(a)) for a in turns]


RIBBED = crisp.loft([[(x, y, z) for x, y in outline(LOW + (TOP - LOW) * z / HIGH)] for z in (0.03, HIGH - 0.05)])
ENDS = crisp.together(
    crisp.lathe([(LOW + 0.006, 0), (LOW + 0.009, 0.004), (LOW + 0.009, 0.030), (LOW + 0.004, 0.034)]),
    crisp.lathe([(TOP - 0.004, HIGH - 0.054), (TOP + 0.005, HIGH - 0.050), (TOP + 0.006, HIGH - 0.010), (TOP + 0.009, HIGH - 0.006), (TOP + 0.006, HIGH)]),
)  # fmt: skip
ROOM = crisp.lathe([(LOW - 0.006, 0.006), (TOP - 0.006, HIGH - 0.02), (TOP - 0.004, HIGH + 0.01)])
GRIP = crisp.wire(
    [(0.216, -0.065, 0.455), (0.262, -0.065, 0.440), (0.266, -0.045, 0.405), (0.266, 0.045, 0.405), (0.262, 0.065, 0.440), (0.216, 0.065, 0.455)],
    0.010,
)  # fmt: skip
CAN = crisp.together(RIBBED, ENDS, GRIP, GRIP.rotate(180, "z")) - ROOM
DOME = [(0.256, 0), (0.256, 0.030), (0.240, 0.046), (0.150, 0.078), (0.060, 0.092), (0, 0.094)]
LID = (crisp.lathe(DOME) - crisp.lathe([(r - 0.003 if r > 0.003 else 0, z - 0.003) for r, z in DOME])).translate(
    z=HIGH - 0.024
)
RING = crisp.together(
    *(crisp.torus(2 * r, 0.008).translate(z=z + HIGH - 0.024) for r, z in ((0.150, 0.0775), (0.245, 0.041)))
)
KNOB = crisp.wire([(0, -0.055, 0.660), (0, -0.050, 0.715), (0, 0, 0.728), (0, 0.050, 0.715), (0, 0.055, 0.660)], 0.013)
KNOB = KNOB - crisp.lathe([(r, z) for r, z in DOME]).translate(z=HIGH - 0.025)

KIT = Kit(
    "street",
    "Trash can of ribbed steel with two handles and a lid that lifts off",
    "typical dustbin of 90 litres: 51 cm across, 73 cm high",
    "steel",
    (
        part("can", CAN, "steel", hulls=40, triangles=12000, density=1000),
        part("lid", crisp.together(LID, RING, KNOB), "steel", "can", Slide("lid", axis=(0, 0, 1), range_m=(0, 0.3), damping=2.0), hulls=24, triangles=8000, density=1500),
    ),
)  # fmt: skip
