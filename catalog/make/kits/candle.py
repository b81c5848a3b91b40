"""A candle of wax, alight, in a brass holder with a ring for a finger."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

DISH = [
    (0, 0),
    (0.052, 0),
    (0.060, 0.010),
    (0.058, 0.012),
    (0.049, 0.004),
    (0.017, 0.004),
    (0.0165, 0.028),
    (0.0125, 0.028),
    (0.0125, 0.006),
    (0, 0.006),
]
HOLDER = crisp.lathe(DISH) | crisp.torus(0.036, 0.006).rotate(90, "x").translate(0.070, 0, 0.018)
WAX = crisp.lathe(
    [(0.012, 0), (0.012, 0.118), (0.0112, 0.1215), (0.008, 0.120), (0.003, 0.1185), (0, 0.118)]
).translate(z=0.006)
DRIP = crisp.wire(
    [(0.0112, 0.004, 0.125), (0.0118, 0.0045, 0.11), (0.0118, 0.0045, 0.092)], 0.005, scales=[0.6, 0.8, 1.1]
)
WICK = crisp.wire([(0, 0, 0.122), (0, 0, 0.130), (0.0015, 0, 0.136)], 0.0022)
FLAME = crisp.lathe(
    [(0, 0), (0.0035, 0.002), (0.0065, 0.010), (0.0062, 0.018), (0.0040, 0.030), (0.0015, 0.042), (0, 0.048)],
    smooth=True,
)

KIT = Kit(
    "lighting",
    "Burning candle in a brass chamberstick with a finger ring",
    "household candle of 24 mm, a holder 12 cm across",
    "brass",
    (
        part("holder", HOLDER, "brass"),
        part("candle", WAX | DRIP, "wax", "holder", hulls="convex"),
        part("wick", WICK, "fabric", "candle", look="rubber_black", hulls="convex"),
        part("flame", FLAME.translate(z=0.130), "foam", "candle", look="lamp_warm", hulls="convex", density=1.0),
    ),
)
