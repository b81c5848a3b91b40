"""What furnishes the room beside the furniture of boxes. Metres; each stands on z = 0."""

import numpy as np

from worldkit import sculpt
from worldkit.sculpt import Part, brushes, crisp

VASE_LINE = [
    (0.001, 0),
    (0.040, 0),
    (0.046, 0.006),
    (0.066, 0.060),
    (0.060, 0.120),
    (0.030, 0.170),
    (0.028, 0.185),
    (0.040, 0.205),
]
VASE = crisp.lathe([*crisp.curve(VASE_LINE, steps=4).tolist(), (0.001, 0.203)])
HEADS = [(0.055, 0.010, 0.330), (-0.040, 0.045, 0.345), (-0.030, -0.055, 0.320), (0.020, 0.060, 0.385), (0.000, -0.010, 0.400), (0.050, -0.055, 0.360), (-0.070, 0.000, 0.375)]  # fmt: skip
STEMS = sculpt.union(*(sculpt.tube([(0.2 * x, 0.2 * y, 0.19), (0.6 * x, 0.6 * y, 0.19 + 0.5 * (z - 0.19)), (x, y, z)], [0.007, 0.006, 0.006]) for x, y, z in HEADS))  # fmt: skip
BLADE = sculpt.ellipsoid((0.012, 0.040, 0.100))
LEAVES = sculpt.union(
    *(BLADE.rotate(48, "y").translate(0.055, 0, 0.245).rotate(angle) for angle in (20, 95, 150, 215, 290, 335))
)
BLOOM = sculpt.union(sculpt.ellipsoid((0.052, 0.052, 0.040)), sculpt.radial(sculpt.ellipsoid((0.034, 0.028, 0.030)).translate(0.022, 0, -0.002), 6), radius=0.004)  # fmt: skip
BLOOMS = sculpt.union(*(BLOOM.rotate(17 * k, "z").translate(*head) for k, head in enumerate(HEADS)))


def paint_blooms(points, normals):
    """Roses, coral to cream from one to the next, darker in their folds."""
    heads = np.array(HEADS)
    nearest = np.argmin(((points[:, None, :] - heads[None]) ** 2).sum(axis=2), axis=1)
    tones = np.array([[0.85, 0.42, 0.36], [0.93, 0.72, 0.56], [0.80, 0.30, 0.32], [0.95, 0.83, 0.70], [0.87, 0.48, 0.40], [0.92, 0.66, 0.58], [0.83, 0.36, 0.34]])  # fmt: skip
    rgb = tones[nearest] * (0.82 + 0.18 * brushes.mottled(points, 0.010))[:, None]
    return rgb, 0.8 + 0 * points[:, 0]


VASE_OF_ROSES = (
    Part("vase", VASE, look="ceramic_blue", density=1300, make={"hulls": 4, "triangles": 5000}),
    Part("green", STEMS | LEAVES, parent="vase", look="leaf_green", density=60, make={"cells": 110, "hulls": "convex", "triangles": 7000}),
    Part("blooms", BLOOMS, parent="vase", paint=paint_blooms, density=40, make={"cells": 120, "hulls": "convex", "triangles": 9000}),
)  # fmt: skip

CASE = crisp.slab(
    [(-0.150, 0), (0.150, 0), (0.150, 0.020), (0.130, 0.024), (0.110, 0.060), (0.095, 0.150), (0.060, 0.190), (0, 0.205), (-0.060, 0.190),
     (-0.095, 0.150), (-0.110, 0.060), (-0.130, 0.024), (-0.150, 0.020)], 0.085, bevel=0.003,
).rotate(90, "x").rotate(90, "z").translate(x=-0.0425)  # fmt: skip
RIM = crisp.turned([(0.066, 0), (0.072, 0), (0.072, 0.008), (0.066, 0.008)]).rotate(90, "y").translate(x=0.042, z=0.115)


def paint_clock(points, normals):
    """A walnut case, a brass rim, a white face at ten past ten."""
    y, z = points[:, 1], points[:, 2] - 0.115
    front = (points[:, 0] > 0.0415) * (np.hypot(y, z) < 0.066)
    grain = brushes.stripes(points[:, 1] + 0.004 * brushes.noise(points, 0.03), 0.006, 0.4, 0.5)
    rgb = brushes.over(brushes.plain(points, "#5d3a22"), "#48291a", 0.7 * grain)
    rgb = brushes.over(rgb, "#c39a3c", brushes.step(points[:, 0], 0.0428, 0.0002))
    rgb = brushes.over(rgb, "#f4efe2", front)
    rgb = brushes.over(
        rgb, "#222222", front * brushes.dial(points, 12, 0.104, 0.124, 0.004, centre=(0, 0, 0.115), axis="x")
    )
    for angle, length, width in (
        (150, 0.036, 0.0030),
        (30, 0.052, 0.0020),
    ):  # as who looks at it sees them: y runs to the right from +x
        a, b = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        along, across = y * a + z * b, z * a - y * b
        rgb = brushes.over(rgb, "#1a1a1a", front * (along > -0.008) * (along < length) * (abs(across) < width))
    return rgb, 0.35 + 0 * y


MANTEL_CLOCK = Part(
    "mantel_clock",
    CASE | RIM,
    paint=paint_clock,
    density=500,
    make={"hulls": "convex", "triangles": 5000, "texels": 768},
)

MOULD = [(0, 0), (0.030, 0), (0.030, 0.008), (0.018, 0.022), (0.006, 0.026), (0, 0.020)]
BOARD = crisp.box((0.012, 0.86, 0.62)).translate(x=0.006, z=0.31)
FRAME = crisp.together(
    BOARD, *(crisp.box((0.030, 0.90, 0.045), 0.006).translate(x=0.015, z=z) for z in (0.0225, 0.5975)),
    *(crisp.box((0.030, 0.045, 0.62), 0.006).translate(x=0.015, y=y, z=0.31) for y in (-0.4275, 0.4275)),
)  # fmt: skip


def paint_picture(points, normals):
    """A landscape at evening in a gilt frame: hills behind hills, a lake, a low sun."""
    y, z = points[:, 1], points[:, 2]
    inside = (abs(y) < 0.405) * (z > 0.045) * (z < 0.575)
    rgb = brushes.gradient(z, {0.05: "#e8a455", 0.32: "#f4c988", 0.45: "#9fb3bf", 0.58: "#5f7f9f"})
    rgb = brushes.over(rgb, "#fff1c4", np.hypot(y + 0.14, z - 0.36) < 0.045)
    for level, swell, wave, tone in (
        (0.33, 0.050, 9.0, "#7d8aa0"),
        (0.27, 0.040, 13.0, "#5d7458"),
        (0.14, 0.025, 7.0, "#3d5236"),
    ):
        rgb = brushes.over(rgb, tone, z < level + swell * np.sin(wave * y + 40 * level) + 0.012 * np.sin(31 * y))
    rgb = brushes.over(rgb, "#c9b27c", (z < 0.20) * (z > 0.15) * (abs(y - 0.08) < 0.22 - 2.5 * abs(z - 0.175)))
    gilt = brushes.over(brushes.plain(points, "#b48a3c"), "#8a6526", 0.6 * brushes.mottled(points, 0.02))
    return np.where(inside[:, None], rgb, gilt), 0.5 + 0 * y


PICTURE = Part(
    "picture", FRAME, paint=paint_picture, density=500, make={"hulls": "convex", "triangles": 4000, "texels": 1024}
)

PLANTER = crisp.turned(
    [
        (0, 0),
        (0.125, 0),
        (0.130, 0.008),
        (0.160, 0.260),
        (0.172, 0.262),
        (0.172, 0.300),
        (0.150, 0.300),
        (0.146, 0.270),
        (0, 0.270),
    ]
)
TRUNK = [sculpt.tube([(0.02 * np.cos(a), 0.02 * np.sin(a), 0.26), (0.10 * np.cos(a), 0.10 * np.sin(a), 0.26 + 0.5 * h), (0.20 * np.cos(a), 0.20 * np.sin(a), 0.26 + h)], [0.016, 0.012, 0.010]) for a, h in ((0.3, 0.62), (1.2, 0.80), (2.1, 0.55), (3.0, 0.74), (3.9, 0.60), (4.8, 0.86), (5.6, 0.66))]  # fmt: skip
PAD = sculpt.ellipsoid((0.34, 0.17, 0.012))
PADS = [PAD.rotate(30, "y").translate(0.13, 0, -0.065).rotate(float(np.degrees(a)), "z").translate(0.20 * float(np.cos(a)), 0.20 * float(np.sin(a)), 0.26 + h) for a, h in ((0.3, 0.62), (1.2, 0.80), (2.1, 0.55), (3.0, 0.74), (3.9, 0.60), (4.8, 0.86), (5.6, 0.66))]  # fmt: skip


def paint_leaves(points, normals):
    """Deep green with a lighter mottling."""
    return brushes.over(
        brushes.plain(points, "#2c5a2c"), "#5c8a44", 0.6 * brushes.mottled(points, 0.05)
    ), 0.45 + 0 * points[:, 0]


PLANT = (
    Part("pot", PLANTER, look="ceramic_terracotta", density=1900, make={"hulls": "convex", "triangles": 4000}),
    Part("soil", crisp.cylinder(0.286, 0.02).translate(z=0.262), parent="pot", look="soil", density=1200, make={"hulls": "convex"}),
    Part("leaves", sculpt.union(*TRUNK, *PADS), parent="pot", paint=paint_leaves, density=200, make={"cells": 150, "hulls": "convex", "triangles": 14000}),
)  # fmt: skip


def paint_rug(points, normals):
    """A Persian-looking rug: borders in bands, a lattice of lozenges, a medallion, fringes."""
    x, y = points[:, 0], points[:, 1]
    edge = np.minimum(1.45 - abs(x), 1.10 - abs(y))
    rgb = brushes.plain(points, "#7a2326")
    lattice = (np.abs(np.mod(x / 0.24, 1) - 0.5) + np.abs(np.mod(y / 0.24, 1) - 0.5)) < 0.16
    rgb = brushes.over(rgb, "#c9a66b", lattice * 0.8)
    medal = abs(x) / 0.75 + abs(y) / 0.55
    for most, tone in ((1.0, "#22304f"), (0.86, "#b98a4e"), (0.78, "#7a2326"), (0.5, "#22304f"), (0.3, "#d8c08c")):
        rgb = brushes.over(rgb, tone, medal < most)
    for near, tone in ((0.30, "#d8c08c"), (0.28, "#22304f"), (0.10, "#d8c08c"), (0.085, "#7a2326"), (0.03, "#e3d6b4")):
        rgb = brushes.over(rgb, tone, edge < near)
    teeth = (edge < 0.26) * (edge > 0.12) * ((np.mod((x + y) / 0.12, 1) < 0.5) ^ (np.mod((x - y) / 0.12, 1) < 0.5))
    rgb = brushes.over(rgb, "#a8713c", 0.9 * teeth)
    return brushes.over(rgb, "#000000", 0.12 * brushes.mottled(points, 0.01)), 1.0 + 0 * x


RUG = Part(
    "rug",
    crisp.box((2.90, 2.20, 0.010), 0.003).translate(z=0.005),
    paint=paint_rug,
    density=300,
    make={"hulls": "convex", "texels": 1024},
)

SHADE = crisp.turned([(0.225, 0), (0.230, 0), (0.120, 0.20), (0.020, 0.235), (0.020, 0.229), (0.116, 0.195)])
PENDANT = (
    Part("shade", SHADE, look="#2f4a3e", density=2700, make={"hulls": "convex", "triangles": 5000}),
    Part("bulb", crisp.ball(0.085).translate(z=0.075), parent="shade", look="lamp_warm", density=500, make={"hulls": "convex"}),
    Part("cord", crisp.cylinder(0.010, 0.62).translate(z=0.225), parent="shade", look="rubber_black", density=900, make={"hulls": "convex"}),
    Part("rose", crisp.cylinder(0.10, 0.03, 0.006).translate(z=0.84), parent="shade", look="brass", density=900, make={"hulls": "convex"}),
)  # fmt: skip


def paint_basket(points, normals):
    """Woven willow: courses that go over and under."""
    turn = np.arctan2(points[:, 1], points[:, 0])
    course = np.floor(points[:, 2] / 0.009)
    weave = (np.mod(turn * 14 / np.pi + course, 2) < 1) * 1.0
    rgb = brushes.over(brushes.plain(points, "#b98a4e"), "#8c6230", 0.65 * weave)
    return brushes.over(rgb, "#5a3c1c", 0.8 * brushes.stripes(points[:, 2], 0.009, 0.16)), 0.85 + 0 * turn


BASKET = Part(
    "basket",
    crisp.turned([(0, 0), (0.095, 0), (0.100, 0.004), (0.125, 0.085), (0.129, 0.092), (0.122, 0.094), (0.117, 0.086), (0.093, 0.010), (0, 0.010)]),
    paint=paint_basket, density=400, make={"hulls": 40, "triangles": 8000},
)  # fmt: skip

BREAD_BOARD = Part(
    "bread_board",
    (crisp.slab([(-0.17, -0.065), (0.11, -0.065), (0.13, -0.045), (0.17, -0.020), (0.17, 0.020), (0.13, 0.045), (0.11, 0.065), (-0.17, 0.065)], 0.016, bevel=0.003)
     - crisp.cylinder(0.016, 0.05).translate(x=0.152, z=-0.01)),
    look="wood_maple", density=700, make={"hulls": "convex", "triangles": 3000},
)  # fmt: skip

TRAY = Part(
    "tray",
    crisp.box((0.30, 0.44, 0.040), 0.004).translate(z=0.020) - crisp.box((0.28, 0.42, 0.06)).translate(z=0.040),
    look="wood_walnut", density=650, make={"hulls": 12, "triangles": 3000},
)  # fmt: skip
