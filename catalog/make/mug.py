"""A stoneware mug, hollow, its handle on the +Y side (the right hand of someone facing its front)."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import Surface

RADIUS, HEIGHT, WALL, FLOOR = 0.041, 0.095, 0.0042, 0.007  # m


def make() -> Recipe:
    """The mug: wall and floor in one lathe, a swept handle sunk into the wall."""
    inner = RADIUS - WALL
    rise = np.concatenate(
        [
            [(0, FLOOR)],
            shapes.arc((inner - 0.008, FLOOR + 0.008), 0.008, -90, 0, 8),
            np.column_stack([np.full(5, inner), np.linspace(0.02, 0.088, 5)]),
            shapes.arc((RADIUS - WALL / 2, HEIGHT - WALL / 2), WALL / 2, 180, 0, 9),
            np.column_stack([np.full(6, RADIUS), np.linspace(0.088, 0.012, 6)]),
            shapes.arc((RADIUS - 0.006, 0.0075), 0.006, 0, -60, 7),
            [(0.0355, 0.0010), (0.0345, 0.0), (0.0315, 0.0), (0.0305, 0.0010), (0.0300, 0.0025), (0, 0.0028)],
        ]
    )
    profile = rise[::-1]
    profile[[0, -1], 0] = 0
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))]
    handle = _handle()
    return Recipe(
        key="mug",
        category="tableware",
        description="Coffee mug, glazed stoneware, hollow, with a handle",
        metric_height=HEIGHT,
        metric_height_source="typical 330 ml mug: 9.5 cm high, 8.2 cm across",
        mass=0.34,
        mass_source="typical 330 ml stoneware mug: 0.3 to 0.4 kg",
        contact={"friction": 0.4, "restitution": 0.25},
        contact_source="glazed ceramic: friction 0.3 to 0.45; restitution of a dull click, conservative",
        parts=[
            Part("cup", shapes.lathe(profile, 64), "glaze", density=2200, crease_deg=50),
            Part("handle", handle, "handle", density=2200, crease_deg=60),
        ],
        materials={
            "glaze": {"texture": "glaze.png", "specular": 0.55, "shininess": 0.7, "roughness": 0.2},
            "handle": {"rgba": [0.76, 0.275, 0.19, 1.0], "specular": 0.55, "shininess": 0.7, "roughness": 0.2},
        },
        recolour=("glaze", "handle"),
        textures={"glaze.png": _glaze(profile, along / along[-1])},
        texture_levels={"glaze.png": 128},
        collision=[
            hulls.cylinder(2 * 0.0352, 0, 0.003),
            hulls.cylinder(2 * (RADIUS - 0.001), 0.003, FLOOR),
            *hulls.wall(2 * inner, WALL, FLOOR - 0.003, HEIGHT, 20),
            *hulls.decomposed(handle, threshold=0.08),
        ],
        supports=[Support("inside", FLOOR, (2 * inner - 0.014, 2 * inner - 0.014), shape="ellipse", default=True)],
    )


def _handle() -> Surface:
    path = shapes.curve(
        [
            (0.0385, 0.079),
            (0.050, 0.0805),
            (0.0635, 0.0745),
            (0.0695, 0.058),
            (0.0660, 0.040),
            (0.0540, 0.0265),
            (0.0390, 0.0225),
        ],
        28,
    )
    points = np.column_stack([np.zeros(len(path)), path])
    widen = np.interp(np.linspace(0, 1, len(path)), [0, 0.14, 0.5, 0.86, 1], [1.3, 1.0, 0.92, 0.95, 1.25])
    section = shapes.arc((0, 0), 1.0, 0, 360, 17)[:-1] * [0.0068, 0.0044]
    return shapes.sweep(points, section, side=(-1, 0, 0), scale=widen)


def _glaze(profile: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Terracotta red outside over a bare clay foot, warm white inside."""
    height, width = 512, 256
    row = 1 - (np.arange(height) + 0.5) / height
    rim = v[int(np.argmax(profile[:, 1]))]
    z = np.interp(row, v, profile[:, 1])[:, None]
    outside = np.broadcast_to((row < rim)[:, None], (height, width))
    tone = texture.noise((height, width), 31, slope=1.2)
    red = texture.ramp(0.5 + 0.09 * tone, ["#a93a25", "#c4472f", "#d4583c"])
    white = texture.ramp(0.6 + 0.06 * tone, ["#d9cfbd", "#f3ecdf"]) * (0.80 + 0.20 * np.clip(z / 0.07, 0, 1))[..., None]
    picture = np.where(outside[..., None], red, white)
    clay = texture.ramp(0.5 + 0.12 * texture.noise((height, width), 32, slope=0.6), ["#a58566", "#c9aa86"])
    picture = texture.blend(picture, clay, texture.edge(z - 0.0125 + 0.0004 * tone, 0.001) * outside)
    return texture.blend(picture, "#8a5a3a", 0.55 * texture.edge(HEIGHT - 0.0012 - z, 0.001))
