"""Things of glass and what stands beside them. Metres; each stands on z = 0."""

from worldkit.sculpt import Part, brushes, crisp

WINE_GLASS = Part(
    "wine_glass",
    crisp.turned(
        [(0, 0), (0.034, 0), (0.0355, 0.0012), (0.028, 0.003), (0.008, 0.007), (0.0038, 0.016), (0.0036, 0.078), *crisp.curve([(0.006, 0.088), (0.022, 0.098), (0.0345, 0.114), (0.038, 0.136), (0.036, 0.165), (0.0325, 0.192)], steps=3).tolist(), *crisp.curve([(0.0311, 0.192), (0.0345, 0.165), (0.0364, 0.136), (0.033, 0.1148), (0.0208, 0.0998), (0.004, 0.0915)], steps=3).tolist(), (0, 0.0905)]
    ),
    look="glass_clear", density=2500, make={"hulls": "convex", "triangles": 9000},
)  # fmt: skip

BOTTLE_LINE = [(0, 0), (0.034, 0), (0.037, 0.004), (0.0375, 0.190)]
SHOULDER = [(0.0375, 0.192), (0.033, 0.215), (0.020, 0.234), (0.0150, 0.252), (0.0145, 0.290)]
BOTTLE = crisp.lathe(
    [
        *BOTTLE_LINE,
        *crisp.curve(SHOULDER, steps=4).tolist(),
        (0.0162, 0.291),
        (0.0162, 0.300),
        (0.0140, 0.304),
        (0, 0.304),
    ]
)


def paint_bottle(points, normals):
    """Dark green glass, a cream label with a red band and letters, a red capsule."""
    rgb = brushes.plain(points, "#1d3320")
    label = brushes.step(points[:, 2], 0.055, 0.001) * (1 - brushes.step(points[:, 2], 0.135, 0.001))
    rgb = brushes.over(rgb, "#efe4c8", label)
    band = brushes.step(points[:, 2], 0.118, 0.001) * (1 - brushes.step(points[:, 2], 0.127, 0.001))
    rgb = brushes.over(rgb, "#8c2a25", band)
    for facing in ("+x", "-x", "+y", "-y"):
        words = brushes.label(points, "ROSSO", centre=(0, 0, 0.092), width=0.045, facing=facing, normals=normals)
        rgb = brushes.over(rgb, "#3a2018", words)
    cap = brushes.step(points[:, 2], 0.258, 0.001)
    return brushes.over(rgb, "#7a1f22", cap), 0.08 + 0.5 * label + 0.25 * cap


WINE_BOTTLE = Part("wine_bottle", BOTTLE, paint=paint_bottle, density=2500, make={"hulls": 6, "triangles": 7000})

PITCHER = Part(
    "carafe",
    crisp.turned(
        crisp.curve(
            [(0.001, 0), (0.045, 0), (0.062, 0.012), (0.068, 0.05), (0.056, 0.10), (0.032, 0.15), (0.028, 0.19), (0.040, 0.235)],
            steps=4,
        ).tolist()
        + crisp.curve(
            [(0.0378, 0.235), (0.0258, 0.19), (0.0298, 0.15), (0.0535, 0.10), (0.0655, 0.05), (0.059, 0.0145), (0.042, 0.005),
             (0.001, 0.005)], steps=4,
        ).tolist()
    ),
    look="glass_blue", density=2500, make={"hulls": "convex", "triangles": 9000},
)  # fmt: skip

JAR = crisp.lathe(
    [(0, 0), (0.030, 0), (0.034, 0.004), (0.034, 0.070), (0.030, 0.078), (0.030, 0.080)]
) | crisp.cylinder(0.066, 0.016, 0.002).translate(z=0.079)


def paint_jar(points, normals):
    """Strawberry jam behind glass, a label, a gold lid."""
    rgb = brushes.gradient(points[:, 2] + 0.004 * brushes.noise(points, 0.012), {0.0: "#5e0f14", 0.06: "#9c1f22"})
    label = brushes.step(points[:, 2], 0.022, 0.001) * (1 - brushes.step(points[:, 2], 0.058, 0.001))
    rgb = brushes.over(rgb, "#f4ecd8", label)
    for facing in ("+x", "-x", "+y", "-y"):
        words = brushes.label(points, "JAM", centre=(0, 0, 0.040), width=0.030, facing=facing, normals=normals)
        rgb = brushes.over(rgb, "#a02a2c", words)
    lid = brushes.step(points[:, 2], 0.0798, 0.0004)
    return brushes.over(rgb, "#c9a24a", lid), 0.12 + 0.5 * label + 0.2 * lid


JAM_JAR = Part("jam_jar", JAR, paint=paint_jar, density=1400, make={"hulls": "convex", "triangles": 5000})
