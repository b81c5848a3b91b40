"""A stoneware bowl: speckled cream inside, a blue-green glaze that breaks brown at the rim."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support

RADIUS, HEIGHT, FLOOR = 0.080, 0.070, 0.010  # m
INNER = [(0, FLOOR), (0.020, FLOOR + 0.0006), (0.040, 0.0165), (0.058, 0.0305), (0.069, 0.0470), (0.0755, 0.0665)]
OUTER = [(0.0795, 0.0665), (0.0730, 0.0450), (0.0620, 0.0265), (0.0460, 0.0125), (0.0355, 0.0075)]


def make() -> Recipe:
    """The bowl, hollow: its collision wall is two rings of convex sectors around a floor."""
    inner, outer = shapes.curve(INNER, 26), shapes.curve(OUTER, 22)
    lip = shapes.arc((0.0775, 0.0675), 0.0025, 150, 10, 8)
    foot = np.array(
        [
            (0.0345, 0.0050),
            (0.0340, 0.0010),
            (0.0332, 0.0),
            (0.0295, 0.0),
            (0.0287, 0.0010),
            (0.0280, 0.0035),
            (0, 0.0040),
        ]
    )
    profile = np.concatenate([inner, lip, outer, foot])[::-1]
    profile[[0, -1], 0] = 0
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))]
    rings = [
        [(0.0300, 0.0035), (0.0200, FLOOR), (0.0400, 0.0165), (0.0510, 0.0155)],
        [(0.0400, 0.0165), (0.0510, 0.0155), (0.0580, 0.0305), (0.0655, 0.0305)],
        [(0.0580, 0.0305), (0.0655, 0.0305), (0.0690, 0.0470), (0.0742, 0.0470)],
        [(0.0690, 0.0470), (0.0742, 0.0470), (0.0765, 0.0698), (0.0795, 0.0685)],
    ]
    return Recipe(
        key="bowl",
        category="tableware",
        description="Cereal bowl, glazed stoneware, hollow",
        metric_height=HEIGHT,
        metric_height_source="typical cereal bowl, 16 cm across and 7 cm high",
        mass=0.40,
        mass_source="typical 16 cm stoneware bowl: 0.35 to 0.45 kg",
        contact={"friction": 0.4, "restitution": 0.3},
        contact_source="glazed ceramic: friction 0.3 to 0.45; restitution of a dull click, conservative",
        parts=[Part("bowl", shapes.lathe(profile, 72), "glaze", density=2200, crease_deg=50)],
        materials={"glaze": {"texture": "glaze.png", "specular": 0.5, "shininess": 0.6, "roughness": 0.25}},
        recolour=("glaze",),
        textures={"glaze.png": _glaze(profile, along / along[-1])},
        texture_levels={"glaze.png": 86},
        collision=[
            hulls.cylinder(2 * 0.034, 0, 0.0065),
            hulls.cylinder(2 * 0.024, 0.003, FLOOR),
            *[piece for ring in rings for piece in hulls.sectors(np.array(ring), 16)],
        ],
        supports=[Support("inside", FLOOR, (0.05, 0.05), shape="ellipse", default=True)],
    )


def _glaze(profile: np.ndarray, v: np.ndarray) -> np.ndarray:
    height, width = 512, 512
    row = 1 - (np.arange(height) + 0.5) / height
    rim = int(np.argmax(profile[:, 1]))
    from_rim = np.where(row < v[rim], v[rim] - row, row - v[rim])[:, None]
    outside = np.broadcast_to((row < v[rim])[:, None], (height, width))
    run = texture.noise((height, width), 21, slope=1.5, stretch=(1, 3))
    fine = texture.noise((height, width), 22, slope=0.7)
    teal = texture.ramp(0.5 + 0.13 * run + 0.05 * fine - 0.4 * (from_rim - 0.25), ["#123f4a", "#1f6a70", "#3f9490"])
    cream = texture.ramp(0.75 + 0.05 * fine + 0.06 * run, ["#c7b594", "#efe6d2"])
    depth = np.clip((from_rim - 0.12) / 0.38, 0, 1)
    cream = cream * (1 - 0.14 * depth**1.5)[..., None]
    speck = texture.edge(2.75 - texture.noise((height, width), 23, slope=0.25), 0.5)
    cream = texture.blend(cream, "#6b4a2c", 0.75 * speck)
    picture = np.where(outside[..., None], teal, cream)
    foot = texture.edge(row[:, None] - 0.155 + 0.006 * run, 0.01)
    picture = texture.blend(
        picture, np.broadcast_to(texture.colour("#b08b66"), picture.shape) + 0.02 * fine[..., None], foot * outside
    )
    return texture.blend(picture, "#7a4524", 0.9 * texture.edge(from_rim - 0.016 - 0.004 * run, 0.02))
