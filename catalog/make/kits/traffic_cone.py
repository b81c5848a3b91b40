"""A traffic cone: orange, with two white bands, on a square foot of black rubber, hollow and open at the top."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

HIGH, BELOW, ABOVE, WALL = 0.70, 0.135, 0.026, 0.004
"""Height, and the radii where the cone leaves its foot and at its top, m."""
FROM = 0.035


def radius(z: float) -> float:
    """Of the cone at a height, m."""
    return BELOW + (ABOVE - BELOW) * (z - FROM) / (HIGH - FROM)


def ring(low: float, high: float, out: float = 0.0) -> crisp.Solid:
    """The cone's skin between two heights, so much further out, m."""
    return crisp.turned(
        [
            (radius(low) + out, low),
            (radius(high) + out, high),
            (radius(high) - WALL, high),
            (radius(low) - WALL, low),
        ]
    )


FOOT = (
    crisp.slab([(-0.19, -0.15), (-0.15, -0.19), (0.15, -0.19), (0.19, -0.15), (0.19, 0.15), (0.15, 0.19), (-0.15, 0.19), (-0.19, 0.15)], 0.030, 0.006)
    | crisp.cylinder(2 * BELOW + 0.03, FROM + 0.004, 0.004)
) - crisp.cylinder(2 * (BELOW - WALL), 0.2).translate(z=-0.05)  # fmt: skip
CONE = crisp.together(
    ring(FROM - 0.002, HIGH - 0.004), crisp.torus(2 * (ABOVE + 0.003), 0.010).translate(z=HIGH - 0.005)
)
BANDS = crisp.together(ring(0.30, 0.42, 0.0012), ring(0.50, 0.59, 0.0012))

KIT = Kit(
    "street",
    "Traffic cone, orange with two white bands, on a black foot",
    "typical cone of 70 cm on a foot of 38 cm",
    "rubber",
    (
        part("foot", FOOT, "rubber", look="rubber_black", hulls=12),
        part("cone", CONE, "plastic", "foot", look="plastic_orange", hulls=24, triangles=8000),
        part("bands", BANDS, "plastic", "cone", look="plastic_white", hulls=16),
    ),
)
