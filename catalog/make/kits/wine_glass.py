"""A wine glass: a thin bowl on a stem and a foot, red wine in it."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

OUTSIDE = [
    (0, 0),
    (0.036, 0),
    (0.0375, 0.0012),
    (0.030, 0.0030),
    (0.008, 0.0065),
    (0.0036, 0.014),
    (0.0034, 0.075),
    (0.0060, 0.086),
]
BOWL = [(0.022, 0.096), (0.036, 0.112), (0.0415, 0.133), (0.040, 0.160), (0.0345, 0.195), (0.0320, 0.212)]
INSIDE = [(r - 0.0014, z + 0.0004) for r, z in reversed(BOWL)] + [(0.004, 0.0895), (0, 0.0885)]
GLASS = crisp.turned(crisp.curve([*OUTSIDE, *BOWL], steps=3).tolist() + crisp.curve(INSIDE, steps=3).tolist())
WINE = crisp.lathe(
    [(0, 0.0892), (0.004, 0.0903), (0.0203, 0.0968), (0.0343, 0.1124), (0.0396, 0.1336), (0.0394, 0.140), (0, 0.140)]
)

KIT = Kit(
    "tableware",
    "Wine glass with a stem, red wine in it",
    "typical white wine glass: 21 cm high, 83 mm across",
    "glass",
    (
        part("glass", GLASS, "glass", hulls=40, triangles=9000),
        part("wine", WINE, "plastic", "glass", look="wine_red", hulls="convex", density=1000),
    ),
)
