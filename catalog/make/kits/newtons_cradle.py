"""Newton's cradle: five steel balls in a row, each on two threads between two rails."""

from worldkit import sculpt
from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

BALL, HANG, LOW, WIDE = 0.022, 0.145, 0.05, 0.055
COUNT, GAP = 5, 0.00005
RAIL = [(-0.07, WIDE, 0.012), (-0.07, WIDE, HANG - 0.012), (-0.066, WIDE, HANG - 0.003), (-0.058, WIDE, HANG)]
RAIL += [(-x, y, z) for x, y, z in reversed(RAIL)]
FRAME = crisp.wire(RAIL, 0.006, smooth=False).mirror("y")
BASE = crisp.box((0.17, 0.14, 0.018), 0.003).translate(z=0.009)


def ball(number: int):
    """One ball with its threads, which touch nothing."""
    x = (number - (COUNT - 1) / 2) * (BALL + GAP)
    thread = crisp.wire([(x, 0, LOW + 0.009), (x, WIDE, HANG)], 0.0009, smooth=False).mirror("y")
    solid = crisp.together(crisp.ball(BALL).translate(x, 0, LOW), thread)
    joint = Hinge(f"thread_{number + 1}", (x, 0, HANG), (0, 1, 0), damping=2e-6)
    touches = [sculpt.sphere(BALL).translate(x, 0, LOW)]
    return part(
        f"ball_{number + 1}",
        solid,
        "steel",
        "base",
        joint,
        look="chrome",
        hulls=touches,
        restitution=0.95,
        triangles=3000,
    )


KIT = Kit(
    "science",
    "Newton's cradle: five steel balls hanging in a row from a frame",
    "typical desk cradle: 17 cm long, balls of 22 mm",
    "wood",
    (
        part("base", BASE, "wood", look="wood_ebony", hulls="convex"),
        part("frame", FRAME, "steel", "base", look="chrome"),
        *map(ball, range(COUNT)),
    ),
)
