"""An hourglass: two bulbs of glass between discs of wood on three posts, most of its sand below."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

HIGH, BULB, NECK = 0.18, 0.034, 0.0028
HALF = [(NECK, 0), (0.007, 0.008), (0.022, 0.028), (BULB - 0.002, 0.048), (BULB, 0.062), (BULB - 0.004, 0.076)]
WALL = 0.0014
OUTER = [(r, -z) for r, z in reversed(HALF)] + HALF[1:]
INNER = [(r - WALL, z) for r, z in OUTER]
GLASS = crisp.turned([*OUTER, *reversed(INNER)]).translate(z=HIGH / 2)
SAND = crisp.lathe(
    [
        (0, -0.0755),
        (BULB - 0.0062, -0.0755),
        (BULB - 0.0018, -0.062),
        (BULB - 0.0030, -0.052),
        (0.012, -0.036),
        (0, -0.030),
    ]
).translate(z=HIGH / 2)
STREAM = crisp.cylinder(0.0014, 0.034).translate(z=HIGH / 2 - 0.032)
LEFT = crisp.lathe([(0, 0.0005), (0.0015, 0.001), (0.0050, 0.008), (0.0135, 0.019), (0, 0.013)]).translate(z=HIGH / 2)
DISC = crisp.lathe([(0, 0), (0.045, 0), (0.047, 0.002), (0.047, 0.008), (0.044, 0.012), (0, 0.012)])
POST = crisp.lathe(
    [
        (0.003, 0),
        (0.003, 0.010),
        (0.0055, 0.03),
        (0.0035, 0.05),
        (0.005, HIGH / 2),
        (0.0035, HIGH - 0.05),
        (0.0055, HIGH - 0.03),
        (0.003, HIGH - 0.01),
        (0.003, HIGH),
    ]
)
FRAME = crisp.together(
    DISC, DISC.rotate(180, "x").translate(z=HIGH), crisp.around(POST.translate(x=0.040), 3).rotate(60)
)

KIT = Kit(
    "science",
    "Hourglass with sand, three wooden posts between two discs",
    "typical sand glass of some minutes: 18 cm high",
    "wood",
    (
        part("frame", FRAME, "wood", look="wood_walnut"),
        part("glass", GLASS, "glass", "frame"),
        part(
            "sand", crisp.together(SAND, STREAM), "stone", "frame", look="plastic_orange", hulls="convex", density=1500
        ),
        part("sand_left", LEFT, "stone", "frame", look="plastic_orange", hulls="convex", density=1500),
    ),
)
