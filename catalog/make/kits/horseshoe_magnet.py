"""A horseshoe magnet, red with bare poles, lying flat, its keeper across them."""

import math

from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

BEND, LEG = 0.036, 0.062
ARC = [(-BEND * math.sin(a), BEND * math.cos(a), 0.0) for a in (k * math.pi / 12 for k in range(13))]
LINE = [(LEG, BEND, 0.0), (LEG / 2, BEND, 0.0), *ARC, (LEG / 2, -BEND, 0.0), (LEG, -BEND, 0.0)]
SHOE = crisp.sweep(
    [
        (-0.011, -0.008),
        (-0.0095, -0.0095),
        (0.0095, -0.0095),
        (0.011, -0.008),
        (0.011, 0.008),
        (0.0095, 0.0095),
        (-0.0095, 0.0095),
        (-0.011, 0.008),
    ],
    LINE,
)
KEEPER = crisp.box((0.012, 0.098, 0.019), 0.0015).translate(LEG + 0.0064, 0, 0.0095)


def paint(points, normals):
    """Red, the poles bare steel, with their letters."""
    rgb = brushes.over(brushes.plain(points, "#c3201b"), "#b9bcc0", brushes.step(points[:, 0], LEG - 0.022, 0.0004))
    for y, letter in ((BEND, "N"), (-BEND, "S")):
        rgb = brushes.over(
            rgb,
            "#222222",
            brushes.label(points, letter, centre=(LEG - 0.011, y, 0.019), width=0.012, facing="+z", normals=normals),
        )
    return rgb, 0.3


KIT = Kit(
    "science",
    "Horseshoe magnet, red with bare poles and an iron keeper",
    "typical school magnet: 11 cm long, poles 7 cm apart",
    "iron",
    (
        part("magnet", SHOE.translate(z=0.0095), "iron", paint=paint),
        part("keeper", KEEPER, "iron", "magnet", look="titanium", hulls="convex"),
    ),
)
