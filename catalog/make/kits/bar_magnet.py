"""A bar magnet, red to its north and blue to its south, with the letters."""

from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part

LONG, WIDE, HIGH = 0.15, 0.026, 0.016


def paint(points, normals):
    """Two halves and two letters on the upper side and the front."""
    rgb = brushes.over(brushes.plain(points, "#1f4fb4"), "#c8231e", brushes.step(points[:, 1], 0.0, 0.0004))
    for y, letter in ((0.058, "N"), (-0.058, "S")):
        rgb = brushes.over(
            rgb,
            "#ffffff",
            brushes.label(points, letter, centre=(0, y, HIGH), width=0.014, facing="+z", normals=normals),
        )
        rgb = brushes.over(
            rgb,
            "#ffffff",
            brushes.label(points, letter, centre=(0, y, HIGH / 2), width=0.010, facing="+x", normals=normals),
        )
    return rgb, 0.3


KIT = Kit(
    "science",
    "Bar magnet, north pole red, south pole blue",
    "typical school magnet: 150 x 26 x 16 mm, Alnico",
    "iron",
    (part("magnet", crisp.box((WIDE, LONG, HIGH), 0.0015).translate(z=HIGH / 2), "iron", paint=paint, hulls="convex"),),
)
