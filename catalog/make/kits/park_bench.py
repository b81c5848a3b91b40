"""A park bench: slats of wood on two feet of cast iron, with arm rests; it looks along +x."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

APART, LONG = 1.24, 1.50
"""Between the feet, and the slats, m."""
FOOT = crisp.together(
    crisp.wire([(0.215, 0, 0.0), (0.200, 0, 0.20), (0.215, 0, 0.415)], 0.042, scales=[1.25, 0.9, 1.0]),
    crisp.wire([(-0.235, 0, 0.0), (-0.185, 0, 0.20), (-0.165, 0, 0.40), (-0.195, 0, 0.60), (-0.270, 0, 0.835)], 0.042,
               scales=[1.25, 0.95, 1.0, 0.95, 0.8]),
    crisp.wire([(0.215, 0, 0.412), (0.02, 0, 0.395), (-0.168, 0, 0.400)], 0.040),
    crisp.wire([(0.212, 0, 0.415), (0.235, 0, 0.54), (0.205, 0, 0.625), (0.02, 0, 0.640), (-0.200, 0, 0.625)], 0.034),
    crisp.wire([(-0.205, 0, 0.16), (0.0, 0, 0.205), (0.200, 0, 0.16)], 0.026),
    crisp.box((0.085, 0.055, 0.016), 0.004).translate(x=0.215, z=0.008),
    crisp.box((0.085, 0.055, 0.016), 0.004).translate(x=-0.235, z=0.008),
)  # fmt: skip
FEET = crisp.together(FOOT.translate(y=APART / 2), FOOT.translate(y=-APART / 2)).cut((0, 0, -1), 0.0)
SLAT = crisp.box((0.068, LONG, 0.026), 0.005)
SEAT = crisp.together(
    *(SLAT.translate(x, 0, 0.4265 + 0.001 * k * k) for k, x in enumerate((-0.095, -0.015, 0.065, 0.145, 0.222)))
)
BACK = crisp.together(
    *(
        crisp.box((0.026, LONG, 0.068), 0.005).rotate(-17.5, "y").translate(x + 0.026, 0, z)
        for x, z in ((-0.1835, 0.525), (-0.2085, 0.608), (-0.2335, 0.690), (-0.2590, 0.772))
    )
)

KIT = Kit(
    "furniture",
    "Park bench with slats of wood on feet of cast iron",
    "typical bench for three: 1.5 m long, seat 44 cm and back 84 cm high",
    "wood",
    (
        part("feet", FEET, "iron", look="iron_cast", hulls=40, triangles=9000),
        part("seat", SEAT, "wood", "feet", look="wood_oak", hulls=5),
        part("back", BACK, "wood", "feet", look="wood_oak", hulls=4),
    ),
)
