"""Vegetables of the crate, and what is eaten at the table. Metres; each lies on z = 0 or thereabouts."""

import numpy as np

from worldkit import sculpt
from worldkit.sculpt import Part, brushes

CELLS = {"cells": 56, "triangles": 5000, "hulls": "convex"}


def paint_carrot(points, normals):
    """Orange with dark rings; the tuft of its leaves is green."""
    rgb = brushes.over(
        brushes.plain(points, "#e2701d"),
        "#b9540f",
        0.5 * brushes.stripes(points[:, 0] + 0.002 * brushes.noise(points, 0.01), 0.014, 0.18),
    )
    return brushes.over(rgb, "#4c7a2c", brushes.step(-points[:, 0], 0.087, 0.002)), 0.6 + 0 * points[:, 0]


ROOT = sculpt.tube(
    [(-0.088, 0, 0.017), (-0.05, 0, 0.017), (0.02, 0.002, 0.013), (0.09, 0, 0.006)], [0.030, 0.034, 0.024, 0.006]
)
TUFT = sculpt.union(*(sculpt.tube([(-0.086, 0, 0.017), (-0.115, y, z), (-0.135, 1.8 * y, z + 0.004)], [0.008, 0.006, 0.007]) for y, z in ((-0.007, 0.020), (0, 0.027), (0.008, 0.018))))  # fmt: skip
CARROT = Part("carrot", ROOT.blend(TUFT, radius=0.003), paint=paint_carrot, density=1040, make={**CELLS, "cells": 110})


def paint_tomato(points, normals):
    """Red, paler at the shoulder, with a green star."""
    r = np.hypot(points[:, 0], points[:, 1])
    rgb = brushes.gradient(
        points[:, 2] + 0.004 * brushes.noise(points, 0.02), {0.0: "#b3160f", 0.05: "#d8321c", 0.06: "#e0612c"}
    )
    star = brushes.step(points[:, 2], 0.050, 0.001) * (
        r < 0.012 + 0.009 * np.cos(5 * np.arctan2(points[:, 1], points[:, 0]))
    )
    return brushes.over(rgb, "#4b7a2a", star), 0.22 + 0 * r


TOMATO = Part(
    "tomato",
    sculpt.revolved([(0, 0.003), (0.018, 0), (0.034, 0.022), (0.032, 0.042), (0.016, 0.058), (0.004, 0.055), (0, 0.055)], smooth=True)
    .blend(sculpt.capsule((0, 0, 0.052), (0.002, 0, 0.064), 0.006), radius=0.003),
    paint=paint_tomato, density=990, make=CELLS,
)  # fmt: skip


def paint_potato(points, normals):
    """Earth-brown skin with eyes."""
    rgb = brushes.over(brushes.plain(points, "#b58a52"), "#94693a", 0.7 * brushes.mottled(points, 0.012, seed=2))
    return brushes.over(rgb, "#5c3e20", 0.8 * brushes.spots(points, 0.018, 0.004, seed=3)), 0.9 + 0 * points[:, 0]


POTATO = Part(
    "potato", sculpt.rough(sculpt.ellipsoid((0.098, 0.066, 0.056)), height=0.003, grain=0.04, seed=5).translate(z=0.03),
    paint=paint_potato, density=1080, make=CELLS,
)  # fmt: skip


def paint_pepper(points, normals):
    """Glossy yellow; its stalk is green."""
    rgb = brushes.over(brushes.plain(points, "#e8b019"), "#d98a12", 0.5 * brushes.mottled(points, 0.03))
    return brushes.over(rgb, "#55803a", brushes.step(points[:, 0], 0.041, 0.001)), 0.18 + 0 * points[:, 0]


LOBE = sculpt.ellipsoid((0.098, 0.044, 0.044)).translate(0, 0.018, 0)
PEPPER = Part(
    "pepper",
    sculpt.radial(LOBE, 4, axis="x", radius=0.010)
    .carve(sculpt.sphere(0.024).translate(0.050, 0, 0), radius=0.010)
    .blend(sculpt.tube([(0.032, 0, 0), (0.050, 0, 0), (0.068, 0.004, 0.006)], [0.016, 0.010, 0.012]), radius=0.003)
    .translate(z=0.040),
    paint=paint_pepper, density=550, make=CELLS,
)  # fmt: skip


def paint_onion(points, normals):
    """Copper skin with fine lines from root to neck."""
    turn = np.arctan2(points[:, 1], points[:, 0])
    lines = brushes.stripes(turn + 0.05 * brushes.noise(points, 0.03), 2 * np.pi / 26, 0.22)
    rgb = brushes.gradient(points[:, 2], {0.0: "#a8642a", 0.05: "#c27f3b", 0.075: "#d8b077"})
    return brushes.over(rgb, "#8a4a1e", 0.6 * lines), 0.4 + 0 * turn


ONION = Part(
    "onion",
    sculpt.revolved([(0, 0.002), (0.010, 0), (0.034, 0.020), (0.037, 0.034), (0.022, 0.056), (0.007, 0.068), (0.005, 0.086), (0, 0.088)], smooth=True),
    paint=paint_onion, density=960, make=CELLS,
)  # fmt: skip


def paint_cucumber(points, normals):
    """Dark green with paler lines along it."""
    turn = np.arctan2(points[:, 1], points[:, 2] - 0.022)
    rgb = brushes.over(brushes.plain(points, "#2f5a26"), "#5f8b3a", 0.45 * brushes.stripes(turn, 2 * np.pi / 12, 0.25))
    return brushes.over(rgb, "#8fae57", brushes.step(points[:, 0], 0.125, 0.02)), 0.35 + 0 * turn


BAR = sculpt.box((0.29, 0.036, 0.0445)).translate(0, 0.002, 0.0225)
"""What it collides as: on the many corners of its rough skin it would rock for seconds."""

CUCUMBER = Part(
    "cucumber",
    sculpt.rough(sculpt.tube([(-0.145, 0, 0.022), (-0.06, 0.004, 0.022), (0.06, 0.004, 0.022), (0.145, 0, 0.022)], [0.026, 0.044, 0.044, 0.026]), height=0.0008, grain=0.008, seed=2),
    paint=paint_cucumber, density=980, make={**CELLS, "cells": 80, "hulls": [BAR]},
)  # fmt: skip


def paint_cabbage(points, normals):
    """Pale green, the ribs of the outer leaves lighter, darker towards the outside."""
    turn = np.arctan2(points[:, 1], points[:, 0])
    rgb = brushes.over(brushes.plain(points, "#7fa657"), "#a9c47c", 0.7 * brushes.mottled(points, 0.04, seed=6))
    ribs = brushes.net(points, 0.045, 0.004, seed=5)
    return brushes.over(rgb, "#d9e6bd", 0.75 * ribs), 0.55 + 0 * turn


HEAD = sculpt.rough(sculpt.ellipsoid((0.160, 0.160, 0.140)), height=0.004, grain=0.05, seed=9)
WRAP = sculpt.ellipsoid((0.176, 0.168, 0.152)).shell(0.006) - sculpt.half_space((-0.4, 0.2, -1.0), -0.012)
WRAP_2 = sculpt.ellipsoid((0.170, 0.178, 0.150)).shell(0.006) - sculpt.half_space((0.5, -0.3, -1.0), -0.020)
CABBAGE = Part(
    "cabbage",
    sculpt.union(HEAD, WRAP, WRAP_2, radius=0.003).translate(z=0.076),
    paint=paint_cabbage,
    density=600,
    make={**CELLS, "cells": 72},
)


def paint_loaf(points, normals):
    """Brown crust, pale where it was slashed, dusted with flour."""
    z = points[:, 2]
    rgb = brushes.gradient(z + 0.010 * brushes.noise(points, 0.03), {0.0: "#8c5222", 0.05: "#b8752f", 0.09: "#9a5a22"})
    slash = brushes.stripes(points[:, 0] + 0.5 * points[:, 1], 0.062, 0.26, 0.2) * brushes.step(z, 0.068, 0.006)
    rgb = brushes.over(rgb, "#e6c288", 0.9 * slash)
    return brushes.over(
        rgb, "#f2e6cf", 0.35 * brushes.mottled(points, 0.008, seed=4) * brushes.step(z, 0.05, 0.02)
    ), 0.9 + 0 * z


CRUST = sculpt.ellipsoid((0.270, 0.120, 0.150)) - sculpt.half_space((0, 0, 1), -0.030)
CUTS = sculpt.linear(sculpt.capsule((-0.012, -0.030, 0.078), (0.012, 0.030, 0.078), 0.014), 4, (0.055, 0, 0)).translate(
    x=-0.083
)
LOAF = Part(
    "loaf", sculpt.rough(CRUST, height=0.002, grain=0.03, seed=2).carve(CUTS, radius=0.006).translate(z=0.031),
    paint=paint_loaf, density=280, make={**CELLS, "cells": 80},
)  # fmt: skip


def paint_cake(points, normals):
    """Chocolate below, cream on top, cherries."""
    z, r = points[:, 2], np.hypot(points[:, 0], points[:, 1])
    drip = 0.048 + 0.010 * np.cos(11 * np.arctan2(points[:, 1], points[:, 0]))
    rgb = brushes.over(brushes.plain(points, "#5b3420"), "#d8b98b", brushes.stripes(z, 0.030, 0.14))
    rgb = brushes.over(rgb, "#f6efe2", brushes.step(z - drip, 0.0, 0.002))
    return brushes.over(rgb, "#b01626", brushes.step(z, 0.083, 0.001) * (r > 0.05)), 0.55 + 0 * z


CHERRY = sculpt.sphere(0.022).translate(0.078, 0, 0.087)
CAKE = Part(
    "cake",
    sculpt.cylinder(0.210, 0.080, rounded=0.008).translate(z=0.040) | sculpt.radial(CHERRY, 8),
    paint=paint_cake, density=500, make={**CELLS, "cells": 90, "triangles": 8000},
)  # fmt: skip


def paint_cheese(points, normals):
    """Yellow, with a red rind on its round back."""
    r = np.hypot(points[:, 0] + 0.07, points[:, 1])
    return brushes.over(brushes.plain(points, "#f0c650"), "#b93a1e", brushes.step(r, 0.1575, 0.0006)), 0.5 + 0 * r


WHEEL = sculpt.cylinder(0.320, 0.060, rounded=0.003).translate(x=-0.07, z=0.030)
SECTOR = sculpt.extruded([(-0.07, 0), (0.14, -0.085), (0.14, 0.085)], 0.2)
HOLES = sculpt.union(*(sculpt.sphere(d).translate(x, y, z) for x, y, z, d in ((0.0, 0.030, 0.04, 0.020), (0.04, -0.046, 0.03, 0.024), (0.03, 0.01, 0.062, 0.024), (0.062, -0.02, 0.060, 0.016), (0.05, 0.047, 0.022, 0.018), (-0.01, -0.024, 0.018, 0.016))))  # fmt: skip
CHEESE = Part(
    "cheese", (WHEEL & SECTOR).carve(HOLES, radius=0.002), paint=paint_cheese, density=1080, make={**CELLS, "cells": 90}
)


def paint_lemon(points, normals):
    """Yellow peel with pores."""
    rgb = brushes.over(brushes.plain(points, "#f0cf2c"), "#d9ad14", 0.6 * brushes.spots(points, 0.003, 0.0014, seed=8))
    return rgb, 0.35 + 0 * points[:, 0]


LEMON = Part(
    "lemon", sculpt.round_cone((-0.022, 0, 0), (0.018, 0, 0), 0.046, 0.048).blend(sculpt.capsule((-0.045, 0, 0), (0.042, 0, 0), 0.012), radius=0.018).translate(z=0.025),
    paint=paint_lemon, density=950, make=CELLS,
)  # fmt: skip
