"""A watering can: a can half covered, a long spout with a rose, a handle over it."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

R, HIGH = 0.092, 0.19
CAN = crisp.turned(
    [
        (0, 0),
        (R, 0),
        (R + 0.002, 0.003),
        (R, 0.006),
        (R, HIGH - 0.006),
        (R + 0.003, HIGH - 0.003),
        (R, HIGH),
        (R - 0.002, HIGH - 0.004),
        (R - 0.002, 0.003),
        (0, 0.003),
    ]
)
COVER = crisp.slab([(R * x, R * y) for x, y in crisp.ring(2.0, 48) if x > -1e-9], 0.003).translate(z=HIGH - 0.008)
INSIDE = crisp.cylinder(2 * R - 0.003, HIGH).translate(z=0.0015)
SPOUT = (
    crisp.wire(
        [(0.075, 0, 0.040), (0.15, 0, 0.075), (0.225, 0, 0.150), (0.285, 0, 0.215)], 0.030, scales=[1.3, 1.0, 0.8, 0.7]
    )
    - INSIDE
)
ROSE = (
    crisp.lathe([(0, -0.004), (0.010, -0.004), (0.012, 0), (0.030, 0.030), (0.031, 0.034), (0.028, 0.038), (0, 0.040)])
    .rotate(44, "y")
    .translate(0.287, 0, 0.217)
)
HANDLE = (
    crisp.wire(
        [
            (0.035, 0, HIGH - 0.006),
            (0.005, 0, HIGH + 0.060),
            (-0.060, 0, HIGH + 0.070),
            (-0.125, 0, 0.205),
            (-0.135, 0, 0.13),
            (-0.088, 0, 0.075),
        ],
        0.014,
    )
    - INSIDE
)
BRACE = crisp.wire([(0.085, 0, HIGH - 0.012), (0.232, 0, 0.163)], 0.007, smooth=False)

KIT = Kit(
    "garden",
    "Watering can with a long spout and a rose",
    "typical can of five litres: 19 cm high, half a metre long",
    "steel",
    (
        part(
            "can",
            crisp.together(CAN, COVER, SPOUT, HANDLE, BRACE),
            "steel",
            look="paint_green",
            hulls=32,
            triangles=9000,
        ),
        part("rose", ROSE, "brass", "can", hulls="convex", density=3000),
    ),
)
