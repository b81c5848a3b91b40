"""A frying pan of cast iron with a long wooden handle."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

OUTSIDE = [(0.098, 0.0), (0.104, 0.003), (0.122, 0.036), (0.1265, 0.043), (0.126, 0.046)]
INSIDE = [(0.1225, 0.0455), (0.118, 0.036), (0.101, 0.007), (0.095, 0.0045)]
PAN = crisp.turned(
    [(0, 0), *crisp.curve(OUTSIDE, steps=3).tolist(), *crisp.curve(INSIDE, steps=3).tolist(), (0, 0.0045)]
)
SPRUNG = crisp.wire([(0.118, 0, 0.036), (0.150, 0, 0.046), (0.200, 0, 0.060)], 0.017, scales=[1.15, 0.9, 0.75])
ROOM = crisp.lathe([(0.095, 0.0045), (0.101, 0.007), (0.121, 0.045), (0.123, 0.06)])
GRIP = crisp.wire(
    [(0.196, 0, 0.0589), (0.250, 0, 0.0740), (0.310, 0, 0.0885), (0.345, 0, 0.0945)],
    0.026,
    scales=[0.78, 1.0, 1.08, 0.85],
)
HOLE = crisp.cylinder(0.008, 0.06).translate(0.330, 0, 0.065)

KIT = Kit(
    "kitchen",
    "Frying pan of cast iron with a wooden handle",
    "typical pan of 25 cm across, its handle 22 cm long",
    "iron",
    (
        part("pan", crisp.together(PAN, SPRUNG - ROOM), "iron", look="iron_cast", hulls=32, triangles=9000),
        part("grip", GRIP - HOLE, "wood", "pan", look="wood_walnut", hulls=3),
    ),
)
