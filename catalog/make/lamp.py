"""A table lamp: glazed gourd base on a brass foot, linen shade lit from inside."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe
from .surface import Surface

HEIGHT = 0.52  # m
SHADE_LOW, SHADE_HIGH, R_LOW, R_HIGH = 0.285, 0.495, 0.160, 0.112  # m
GOURD = [
    (0.052, 0.018),
    (0.070, 0.034),
    (0.083, 0.070),
    (0.080, 0.110),
    (0.058, 0.150),
    (0.036, 0.180),
    (0.031, 0.205),
    (0.036, 0.228),
    (0.033, 0.244),
    (0.018, 0.252),
]


def make() -> Recipe:
    """The lamp; the shade is a thin open ring, so things can fall through it."""
    foot = np.array(
        [
            (0, 0),
            (0.076, 0.0),
            (0.0785, 0.0015),
            (0.079, 0.004),
            (0.078, 0.0075),
            (0.074, 0.0105),
            (0.060, 0.0130),
            (0.056, 0.0150),
            (0.054, 0.0180),
            (0.0, 0.0185),
        ]
    )
    body = np.concatenate([[(0, 0.017)], shapes.curve(GOURD, 40), [(0, 0.2525)]])
    neck = np.array(
        [
            (0, 0.251),
            (0.0165, 0.251),
            (0.017, 0.2535),
            (0.0155, 0.256),
            (0.009, 0.258),
            (0.0075, 0.262),
            (0.0075, 0.288),
            (0.0125, 0.291),
            (0.0150, 0.295),
            (0.0150, 0.325),
            (0.0135, 0.329),
            (0, 0.330),
        ]
    )
    bulb = np.concatenate(
        [
            [(0, 0.328)],
            shapes.curve(
                [(0.012, 0.329), (0.014, 0.342), (0.024, 0.365), (0.030, 0.388), (0.025, 0.410), (0.012, 0.420)], 16
            ),
            [(0, 0.4215)],
        ]
    )
    rod = np.array(
        [
            (0, 0.42),
            (0.002, 0.42),
            (0.002, 0.488),
            (0.0065, 0.489),
            (0.0075, 0.492),
            (0.0065, 0.495),
            (0.004, 0.497),
            (0.0035, 0.500),
            (0.0085, 0.506),
            (0.0095, 0.511),
            (0.0075, 0.517),
            (0.003, 0.5196),
            (0, HEIGHT),
        ]
    )
    spokes = [
        shapes.sweep(
            np.array(
                [
                    (0.003 * np.cos(a), 0.003 * np.sin(a), 0.486),
                    ((R_HIGH - 0.001) * np.cos(a), (R_HIGH - 0.001) * np.sin(a), 0.490),
                ]
            ),
            shapes.arc((0, 0), 0.0016, 0, 360, 9)[:-1],
            side=(0, 0, 1),
        )
        for a in np.radians([90, 210, 330])
    ]
    slope = (R_HIGH - R_LOW) / (SHADE_HIGH - SHADE_LOW)
    band = np.array(
        [(R_LOW - 0.004, SHADE_LOW), (R_LOW, SHADE_LOW), (R_HIGH, SHADE_HIGH), (R_HIGH - 0.004, SHADE_HIGH)]
    )
    brass = {"rgba": [0.80, 0.62, 0.32, 1.0], "specular": 0.9, "shininess": 0.65, "metallic": 1.0, "roughness": 0.25}
    assert slope < 0
    return Recipe(
        key="lamp",
        category="lighting",
        description="Table lamp, glazed ceramic base and linen shade, switched on",
        metric_height=HEIGHT,
        metric_height_source="typical bedside or table lamp: 45 to 60 cm high",
        mass=2.1,
        mass_source="typical ceramic table lamp of this height: 1.8 to 2.5 kg",
        contact={"friction": 0.4, "restitution": 0.2},
        contact_source="felted foot and glazed ceramic: friction 0.3 to 0.5; restitution conservative",
        parts=[
            Part("foot", shapes.lathe(foot, 56), "brass", density=2200, crease_deg=50),
            Part("body", shapes.lathe(body, 56, v=body[:, 1] / 0.26), "glaze", density=900, crease_deg=60),
            Part("neck", shapes.lathe(neck, 24), "brass", density=2500, crease_deg=35),
            Part("rod", shapes.lathe(rod, 20), "brass", density=2500, crease_deg=35),
            *[Part(f"spoke_{k}", spoke, "brass", density=2500) for k, spoke in enumerate(spokes)],
            Part("bulb", shapes.lathe(bulb, 24), "bulb", density=150, crease_deg=60),
            Part("shade", _shade(), "linen", density=500, crease_deg=40),
        ],
        materials={
            "brass": brass,
            "glaze": {"texture": "glaze.png", "specular": 0.7, "shininess": 0.8, "roughness": 0.12},
            "bulb": {"rgba": [1.0, 0.95, 0.82, 1.0], "emission": 0.9, "specular": 0.1, "shininess": 0.1},
            "linen": {"texture": "linen.png", "emission": 0.42, "specular": 0.0, "shininess": 0.0, "roughness": 0.95},
        },
        recolour=("glaze",),
        textures={"glaze.png": _glaze(), "linen.png": _linen()},
        texture_levels={"glaze.png": 86, "linen.png": 64},
        collision=[
            hulls.cylinder(2 * 0.078, 0.0, 0.018),
            *[_slice(a, b, n) for n, (a, b) in enumerate(((1, 4), (4, 6), (6, 10)))],
            hulls.cylinder(2 * 0.015, 0.25, 0.330),
            hulls.cylinder(2 * 0.028, 0.34, 0.42),
            hulls.cylinder(2 * 0.009, 0.42, HEIGHT),
            *hulls.sectors(band, 20),
        ],
    )


def _slice(first: int, last: int, number: int) -> hulls.Hull:
    points = [(0.052, 0.018), *GOURD[first - 1 : last]] if number == 0 else GOURD[first - 1 : last]
    ring = np.radians(np.arange(20) * 18.0)
    rows = [(r * np.cos(a), r * np.sin(a), z) for r, z in points for a in ring]
    return hulls.Hull(shapes.hull(np.array(rows)))


def _shade() -> Surface:
    """A thin conical band with rolled rims, outside and inside."""
    t, rim = 0.0016, 0.0028
    low = shapes.arc((R_LOW - t / 2, SHADE_LOW + rim), rim, 200, 360, 7)
    high = shapes.arc((R_HIGH - t / 2, SHADE_HIGH - rim), rim, 0, 180, 7)
    wall = np.column_stack([np.linspace(R_LOW, R_HIGH, 14), np.linspace(SHADE_LOW + 0.008, SHADE_HIGH - 0.008, 14)])
    inner = wall[::-1] - (t, 0)
    profile = np.concatenate([low, wall, high, inner])
    closed = np.concatenate([profile, profile[:1]])
    v = (closed[:, 1] - SHADE_LOW) / (SHADE_HIGH - SHADE_LOW)
    band = shapes.lathe(closed, 72, repeat=3, v=v)
    weld = len(band.vertices) - 72  # the last ring repeats the first
    return Surface(
        band.vertices[:weld], np.where(band.faces >= weld, band.faces - weld, band.faces), band.uv, band.uv_faces
    )


def _glaze() -> np.ndarray:
    """Celadon pooling darker towards the foot and breaking paler at the shoulder."""
    shape = (320, 320)
    v = 1 - (np.arange(shape[0])[:, None] + 0.5) / shape[0]
    run = texture.noise(shape, 81, slope=1.5, stretch=(1, 3))
    fine = texture.noise(shape, 82, slope=0.8)
    return texture.ramp(0.34 + 0.42 * v + 0.08 * run + 0.03 * fine, ["#1d4a52", "#2f6f73", "#5d9c94", "#9cc4b4"])


def _linen() -> np.ndarray:
    """Linen glowing most where the bulb is, dim at both hems."""
    size = 256
    v = 1 - (np.arange(size)[:, None] + 0.5) / size
    glow = 0.58 + 0.42 * np.exp(-(((v - 0.46) / 0.36) ** 2))
    cloth = texture.weave(size, 83, 40, ["#d9c49a", "#f0dfba", "#fff3d6"])
    warm = np.stack([glow**0.5, glow**0.85, glow**1.5], axis=-1)
    picture = cloth * warm
    hem = texture.edge(np.minimum(v, 1 - v) - 0.032, 0.006)
    return texture.blend(
        picture, np.broadcast_to(texture.colour("#c9a468"), picture.shape) * 0.9, np.broadcast_to(hem, (size, size))
    )
