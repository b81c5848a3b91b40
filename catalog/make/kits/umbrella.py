"""An open umbrella lying on two tips of its canopy and the end of its crook."""

import math

from worldkit.sculpt import crisp

from ..kit import Kit, part

RIBS, R, RISE, LONG = 8, 0.50, 0.17, 0.86
DOME = [(0.0, 0.0), (0.14, -0.010), (0.28, -0.045), (0.40, -0.100), (R, -RISE)]


def gore(rise: float):
    """The canopy as a solid: rows of places along the ribs, drawn in between them as cloth is, lowered by `rise`."""
    rows = []
    for r, z in crisp.curve(DOME, steps=3):
        ring = []
        for k in range(4 * RIBS):
            turn, between = math.pi * k / (2 * RIBS), abs((k % 4) - 2) / 2  # 1 on a rib, 0 in the middle of a gore
            far = max(r, 0.002) * (1 - 0.09 * (1 - between) ** 1.0 * (r / R) ** 2)
            ring.append((far * math.cos(turn), far * math.sin(turn), z - rise - 0.012 * (1 - between) * r / R))
        rows.append(ring)
    return rows


CANOPY = crisp.loft([*gore(0.0), *reversed(gore(0.004))])
SHAFT = crisp.wire([(0, 0, 0.055), (0, 0, -LONG + 0.08)], 0.010, smooth=False)
STRUTS = crisp.around(crisp.wire([(0.004, 0, -0.34), (0.27, 0, -0.048)], 0.004, smooth=False), RIBS) | crisp.cylinder(
    0.022, 0.04, 0.002
).translate(z=-0.36)
CROOK = crisp.wire(
    [
        (0, 0, -LONG + 0.20),
        (0, 0, -LONG + 0.05),
        (-0.012, 0, -LONG + 0.015),
        (-0.045, 0, -LONG),
        (-0.078, 0, -LONG + 0.015),
        (-0.09, 0, -LONG + 0.05),
    ],
    0.020,
)
TIP = math.cos(math.pi / RIBS) * R  # two tips lie side by side
LEAN = math.degrees(math.atan2(LONG + 0.010 - RISE, TIP))


def lying(solid):
    """Turned so that two tips and the crook's end lie on one level."""
    return solid.rotate(180 / RIBS).rotate(LEAN, "y").rotate(115)


KIT = Kit(
    "household",
    "Open umbrella with a crook handle, lying",
    "typical umbrella: 1 m across, 90 cm long",
    "fabric",
    (
        part("shaft", lying(SHAFT | STRUTS), "steel", look="titanium", density=2700),
        part("canopy", lying(CANOPY), "fabric", "shaft", look="fabric_red", hulls=24),
        part("handle", lying(CROOK), "wood", "shaft", look="wood_walnut", hulls=6),
    ),
)
