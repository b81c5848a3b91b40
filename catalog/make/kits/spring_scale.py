"""A spring scale hanging from a stand: a case with a scale in newtons, and a hook on a slide that its spring holds."""

from worldkit.joints import Slide
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part
from ..stands import gallows

HANG, AT = 0.44, 0.09
CASE = crisp.box((0.016, 0.040, 0.190), 0.003).translate(0.0, AT, HANG - 0.155)
RING = crisp.torus(0.055, 0.0035).rotate(90, "y").translate(0, AT, HANG - 0.020) | crisp.wire(
    [(0, AT, HANG - 0.046), (0, AT, HANG - 0.064)], 0.008, smooth=False
)
ROD = crisp.cylinder(0.005, 0.05).translate(0, AT, HANG - 0.295)
CROOK = crisp.wire(
    [
        (0, AT, HANG - 0.285),
        (0, AT, HANG - 0.305),
        (0, AT + 0.011, HANG - 0.314),
        (0, AT + 0.013, HANG - 0.326),
        (0, AT, HANG - 0.338),
        (0, AT - 0.012, HANG - 0.330),
    ],
    0.0035,
)
POINTER = crisp.box((0.003, 0.022, 0.003), 0.0008).translate(0.0095, AT, HANG - 0.095)
STEM = crisp.box((0.0035, 0.004, 0.16)).translate(0.0, AT, HANG - 0.175)


def paint(points, normals):
    """A white plate with a scale from 0 to 10 N, long ticks at each newton."""
    y, z = points[:, 1] - AT, HANG - 0.095 - points[:, 2]
    front = normals[:, 0] > 0.5
    rgb = brushes.over(
        brushes.plain(points, "#d8a51c"),
        "#f6f3e8",
        front & (abs(y) < 0.016) & (abs(points[:, 2] - HANG + 0.155) < 0.087),
    )
    inside = front & (z > -0.001) & (z < 0.121)
    fine = brushes.stripes(z, 0.006, 0.16) * (inside & (y > 0.004) & (y < 0.012))
    bold = brushes.stripes(z - 0.0, 0.012, 0.12) * (inside & (y > 0.002) & (y < 0.015))
    rgb = brushes.over(rgb, "#151515", fine + bold)
    for number in (0, 5, 10):
        words = brushes.label(
            points,
            str(number),
            centre=(0.008, AT - 0.009, HANG - 0.095 - 0.012 * number),
            width=0.005 + 0.004 * (number > 9),
            facing="+x",
            normals=normals,
        )
        rgb = brushes.over(rgb, "#b01818", words)
    return brushes.over(
        rgb,
        "#151515",
        brushes.label(points, "N", centre=(0.008, AT, HANG - 0.078), width=0.009, facing="+x", normals=normals),
    ), 0.4


KIT = Kit(
    "science",
    "Spring scale (newton meter) with a hook, hanging from a stand, 0 to 10 N",
    "typical school newton meter: case of 19 cm",
    "iron",
    (
        part("stand", gallows(HANG, 2 * AT, 0.14, 0.012), "iron", look="paint_grey"),
        part("ring", RING, "steel", "stand"),
        part("case", CASE, "plastic", "ring", paint=paint, hulls="convex"),
        part("hook", crisp.together(ROD, CROOK, STEM, POINTER), "steel", "case",
             Slide("spring", axis=(0, 0, -1), range_m=(0.0, 0.12), stiffness=83.0, damping=0.3), look="chrome"),
    ),
)  # fmt: skip
