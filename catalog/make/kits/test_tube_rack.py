"""A rack of wood with five test tubes of glass, each of which can be drawn out, coloured liquids in four."""

from worldkit.joints import Slide
from worldkit.sculpt import crisp

from ..kit import Kit, part

PITCH, LONG, FLOOR = 0.034, 0.19, 0.016
AT = [(k - 2) * PITCH for k in range(5)]
HOLES = crisp.together(*(crisp.cylinder(0.0185, 0.02).translate(0, y, 0.072) for y in AT))
PLATE = crisp.box((0.052, LONG, 0.010), 0.0015)
RACK = (
    crisp.together(
        PLATE.translate(z=0.005),
        PLATE.translate(z=0.082),
        *(crisp.box((0.052, 0.010, 0.100), 0.0015).translate(0, y, 0.05) for y in (-LONG / 2, LONG / 2)),
    )
    - HOLES
)
CUP = [(0.0, 0.0), (0.004, 0.0007), (0.0072, 0.0038), (0.008, 0.008)]
TUBE = crisp.turned(
    [
        *CUP,
        (0.008, 0.138),
        (0.0098, 0.140),
        (0.0098, 0.1415),
        (0.0068, 0.1415),
        (0.0068, 0.008),
        (0.006, 0.0045),
        (0.0035, 0.0022),
        (0.0, 0.0016),
    ]
)
COLOURS = ("wine_red", "plastic_blue", "honey", "plastic_green")


def liquid(height: float):
    """What stands in a tube up to a height, m."""
    return crisp.lathe(
        [(0, 0.0018), (0.0034, 0.0025), (0.0058, 0.0048), (0.0066, 0.0085), (0.0066, height), (0, height)]
    )


def tube(number: int):
    """A tube that slides up out of its hole, and its liquid."""
    y, name = AT[number], f"tube_{number + 1}"
    glass = part(
        name,
        TUBE.translate(0, y, 0.010),
        "glass",
        "rack",
        Slide(f"draw_{number + 1}", axis=(0, 0, 1), range_m=(0, 0.2), damping=0.5),
        hulls="convex",
    )
    if number == 4:
        return (glass,)
    made = liquid(0.05 + 0.018 * (number % 3)).translate(0, y, 0.010)
    return (
        glass,
        part(f"liquid_{number + 1}", made, "plastic", name, look=COLOURS[number], hulls="convex", density=1000),
    )


KIT = Kit(
    "science",
    "Test tube rack of wood with five glass tubes, coloured liquids in four of them",
    "tubes of 16 x 140 mm, rack of 20 cm",
    "wood",
    (part("rack", RACK, "wood", look="wood_pine"), *(one for number in range(5) for one in tube(number))),
)
