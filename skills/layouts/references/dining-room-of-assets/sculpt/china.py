"""Porcelain, earthenware and the small things of a laid table. Metres; each stands on z = 0."""

from worldkit.sculpt import Part, brushes, crisp

BELLY = [(0.045, 0.0), (0.060, 0.012), (0.077, 0.040), (0.080, 0.062), (0.070, 0.092), (0.046, 0.114), (0.020, 0.124)]
KNOB = [(0.007, 0.130), (0.006, 0.135), (0.0115, 0.143), (0.010, 0.151), (0.001, 0.154)]
POT = crisp.lathe([(0, 0), *crisp.curve(BELLY, steps=4).tolist(), *crisp.curve(KNOB, steps=3).tolist()])
SPOUT = crisp.wire(
    [(0.055, 0, 0.040), (0.092, 0, 0.050), (0.110, 0, 0.084), (0.135, 0, 0.112)], 0.040, scales=[1.05, 0.75, 0.5, 0.4]
)
LOOP = [
    (-0.060, 0, 0.095),
    (-0.098, 0, 0.100),
    (-0.124, 0, 0.084),
    (-0.122, 0, 0.056),
    (-0.098, 0, 0.034),
    (-0.066, 0, 0.034),
]


def paint_pot(points, normals):
    """White glaze with two blue lines and a seam under the lid."""
    z = points[:, 2]
    rgb = brushes.plain(points, "#f1efe8")
    for at in (0.100, 0.018):
        rgb = brushes.over(rgb, "#2f4f8f", brushes.step(z, at, 0.0005) * (1 - brushes.step(z, at + 0.004, 0.0005)))
    seam = brushes.step(z, 0.1135, 0.0003) * (1 - brushes.step(z, 0.1147, 0.0003))
    return brushes.over(rgb, "#8a8478", 0.8 * seam), 0.12 + 0 * z


TEAPOT = Part(
    "teapot", crisp.together(POT, SPOUT, crisp.wire(LOOP, 0.013)), paint=paint_pot, density=900,
    make={"hulls": 8, "triangles": 9000},
)  # fmt: skip

CUP_BODY = crisp.turned(
    [(0, 0.004), (0.022, 0.004), (0.024, 0.002), (0.027, 0.004), (0.036, 0.022), (0.042, 0.062), (0.0395, 0.062),
     (0.0335, 0.023), (0.024, 0.010), (0, 0.009)]
)  # fmt: skip
TEA = crisp.lathe([(0, 0.0085), (0.024, 0.0095), (0.0335, 0.0228), (0.0376, 0.048), (0, 0.048)])
SAUCER = crisp.turned(
    [(0, 0), (0.036, 0), (0.040, 0.0015), (0.068, 0.013), (0.072, 0.016), (0.070, 0.0172), (0.045, 0.0068), (0.030, 0.0055),
     (0, 0.0055)]
)  # fmt: skip
EAR = crisp.wire(
    [(-0.037, 0, 0.052), (-0.056, 0, 0.054), (-0.064, 0, 0.040), (-0.054, 0, 0.024), (-0.034, 0, 0.022)], 0.007
)


def paint_cup(points, normals):
    """White with a blue rim; the tea in it is brown."""
    z, r = points[:, 2], (points[:, 0] ** 2 + points[:, 1] ** 2) ** 0.5
    rgb = brushes.over(brushes.plain(points, "#f1efe8"), "#2f4f8f", brushes.step(z, 0.0645, 0.0003))
    rgb = brushes.over(rgb, "#2f4f8f", brushes.step(r, 0.068, 0.0005) * (1 - brushes.step(z, 0.02, 0.001)))
    tea = (abs(z - 0.0512) < 0.0008) * (r < 0.0375)
    return brushes.over(rgb, "#6a2d0c", tea), 0.12 + 0 * z


TEACUP = Part(
    "teacup", crisp.together(SAUCER, (CUP_BODY | TEA | EAR).translate(z=0.0032)), paint=paint_cup, density=1500,
    make={"hulls": 6, "triangles": 8000},
)  # fmt: skip

TUREEN_BODY = crisp.lathe(
    [
        (0, 0),
        (0.062, 0),
        (0.066, 0.006),
        (0.05, 0.016),
        *crisp.curve(
            [
                (0.056, 0.022),
                (0.095, 0.045),
                (0.118, 0.085),
                (0.112, 0.112),
                (0.114, 0.116),
                (0.085, 0.14),
                (0.04, 0.156),
            ],
            steps=4,
        ).tolist(),
        (0.01, 0.16),
        (0.008, 0.166),
        (0.016, 0.176),
        (0.013, 0.188),
        (0, 0.191),
    ]
)
GRIPS = crisp.wire(
    [(0.100, -0.030, 0.095), (0.136, -0.022, 0.104), (0.136, 0.022, 0.104), (0.100, 0.030, 0.095)], 0.014
)


def paint_tureen(points, normals):
    """Cream glaze, green garland, gold knob and rim."""
    z = points[:, 2]
    rgb = brushes.plain(points, "#efe7d2")
    garland = (
        brushes.spots(points, 0.016, 0.012, seed=4)
        * brushes.step(z, 0.058, 0.002)
        * (1 - brushes.step(z, 0.092, 0.002))
    )
    rgb = brushes.over(rgb, "#5d7d46", garland)
    rgb = brushes.over(rgb, "#c39a3c", brushes.step(z, 0.112, 0.0005) * (1 - brushes.step(z, 0.118, 0.0005)))
    return brushes.over(rgb, "#c39a3c", brushes.step(z, 0.163, 0.001)), 0.14 + 0 * z


TUREEN = Part(
    "tureen", crisp.together(TUREEN_BODY, GRIPS, GRIPS.rotate(180)), paint=paint_tureen, density=900,
    make={"hulls": 8, "triangles": 9000},
)  # fmt: skip

SALT = crisp.lathe(
    [(0, 0), (0.021, 0), (0.022, 0.002), (0.0165, 0.052), (0.0175, 0.054), (0.0175, 0.066), (0.010, 0.075), (0, 0.077)]
)


def paint_salt(points, normals):
    """White salt behind glass; a steel cap with holes."""
    z = points[:, 2]
    rgb = brushes.over(brushes.plain(points, "#c9d3d4"), "#fbfbf8", 1 - brushes.step(z, 0.034, 0.001))
    cap = brushes.step(z, 0.0535, 0.0003)
    rgb = brushes.over(rgb, "#a8abad", cap)
    return brushes.over(
        rgb, "#222222", brushes.spots(points, 0.005, 0.0022, seed=2) * brushes.step(z, 0.072, 0.0005)
    ), 0.15 + 0 * z


SALT_SHAKER = Part("salt_shaker", SALT, paint=paint_salt, density=1800, make={"hulls": "convex", "triangles": 4000})

PEPPER_MILL = Part(
    "pepper_mill",
    crisp.lathe(
        [(0, 0), (0.027, 0), (0.028, 0.004), (0.026, 0.014), (0.022, 0.02), *crisp.curve([(0.022, 0.022), (0.025, 0.05), (0.017, 0.095), (0.022, 0.128)], steps=4).tolist(), (0.0225, 0.131), (0.014, 0.133), (0.014, 0.136), *crisp.curve([(0.02, 0.138), (0.027, 0.156), (0.021, 0.178), (0.007, 0.186)], steps=4).tolist(), (0.005, 0.19), (0.007, 0.197), (0, 0.201)]
    ),
    look="wood_walnut", density=700, make={"hulls": "convex", "triangles": 5000},
)  # fmt: skip

HOLDER = crisp.lathe(
    [(0, 0), (0.050, 0), (0.052, 0.004), (0.040, 0.012), (0.014, 0.020), (0.010, 0.034), (0.015, 0.046), (0.008, 0.060),
     (0.008, 0.110), (0.016, 0.122), (0.009, 0.134), (0.018, 0.146), (0.030, 0.152), (0.030, 0.155), (0.015, 0.156),
     (0.015, 0.176), (0, 0.176)]
)  # fmt: skip
TAPER = crisp.lathe(
    [(0, 0.170), (0.0112, 0.170), (0.0105, 0.330), (0.0085, 0.336), (0.002, 0.335), (0.0012, 0.347), (0, 0.347)]
)
FLAME = crisp.lathe(
    [(0, 0.342), (0.0035, 0.344), (0.0065, 0.352), (0.0062, 0.360), (0.0040, 0.372), (0.0015, 0.384), (0, 0.390)],
    smooth=True,
)
CANDLESTICK = (
    Part("stick", HOLDER, look="brass", density=4200, make={"hulls": 4, "triangles": 7000}),
    Part("taper", TAPER, parent="stick", look="wax", density=900, make={"hulls": "convex", "triangles": 2500}),
    Part("flame", FLAME, parent="stick", look="lamp_warm", density=10, make={"hulls": "convex", "triangles": 1500}),
)

LAYER = crisp.box((0.125, 0.105, 0.004), 0.0018)
NAPKIN_FOLDS = crisp.together(
    LAYER.translate(z=0.002), crisp.box((0.122, 0.102, 0.004), 0.0018).translate(0.001, 0.0012, 0.0050),
    crisp.slab([(-0.060, -0.050), (0.060, -0.050), (0.060, 0.020), (0.020, 0.050), (-0.060, 0.050)], 0.0045, 0.0018).translate(z=0.0062),
)  # fmt: skip


def paint_napkin(points, normals):
    """Wine-red linen with a cream hem and its weave."""
    weave = 0.5 * brushes.stripes(points[:, 0], 0.0016) + 0.5 * brushes.stripes(points[:, 1], 0.0016)
    rgb = brushes.over(brushes.plain(points, "#8d2b33"), "#a24149", 0.6 * weave)
    hem = brushes.step(abs(points[:, 0]), 0.052, 0.0005) * (1 - brushes.step(abs(points[:, 0]), 0.055, 0.0005))
    return brushes.over(rgb, "#ead9b5", hem), 0.95 + 0 * points[:, 0]


NAPKIN = Part("napkin", NAPKIN_FOLDS, paint=paint_napkin, density=400, make={"hulls": "convex", "triangles": 3000})

CAKE_STAND = Part(
    "cake_stand",
    crisp.turned(
        [(0, 0), (0.060, 0), (0.062, 0.004), (0.040, 0.012), (0.016, 0.026), (0.013, 0.050), (0.022, 0.078), (0.060, 0.090),
         (0.140, 0.096), (0.146, 0.104), (0.142, 0.106), (0.136, 0.100), (0, 0.100)]
    ),
    look="ceramic_white", density=2300, make={"hulls": 24, "triangles": 7000},
)  # fmt: skip

SUGAR = crisp.lathe(
    [
        (0, 0),
        (0.026, 0),
        (0.028, 0.003),
        *crisp.curve(
            [(0.03, 0.005), (0.046, 0.025), (0.044, 0.052), (0.036, 0.062), (0.038, 0.065), (0.022, 0.076)], steps=4
        ).tolist(),
        (0.005, 0.08),
        (0.004, 0.084),
        (0.009, 0.091),
        (0, 0.096),
    ]
)
SUGAR_BOWL = Part(
    "sugar_bowl",
    crisp.together(SUGAR, *(crisp.torus(0.034, 0.008).rotate(90, "x").translate(s * 0.050, 0, 0.038) for s in (-1, 1))),
    paint=paint_pot, density=1100, make={"hulls": "convex", "triangles": 6000},
)  # fmt: skip
