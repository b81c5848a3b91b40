"""A porcelain dinner plate with a coloured band on its rim."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support

RADIUS, HEIGHT, WELL = 0.135, 0.026, 0.086  # m; WELL: radius of the flat middle
FLOOR = 0.0075  # m, height of the eating surface


def make() -> Recipe:
    """The plate: foot ring, flat well, steep shoulder, gently rising rim."""
    upper = shapes.curve(
        [
            (0, FLOOR),
            (0.05, FLOOR),
            (WELL, FLOOR + 0.0003),
            (0.097, 0.0115),
            (0.103, 0.0165),
            (0.118, 0.0215),
            (0.131, 0.0245),
        ],
        34,
    )
    lip = shapes.arc((0.1326, 0.0236), 0.0024, 60, -60, 6)
    lower = shapes.curve(
        [(0.131, 0.0212), (0.118, 0.0178), (0.106, 0.0130), (0.098, 0.0065), (0.088, 0.0034), (0.084, 0.0022)], 16
    )
    foot = np.array(
        [
            (0.0835, 0.0006),
            (0.0828, 0.0),
            (0.0802, 0.0),
            (0.0795, 0.0006),
            (0.0788, 0.0030),
            (0.06, 0.0034),
            (0, 0.0034),
        ]
    )
    profile = np.concatenate([upper, lip, lower, foot])[::-1]
    profile[[0, -1], 0] = 0
    plate = shapes.lathe(profile * [RADIUS / 0.135, 1], 72)
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))]
    return Recipe(
        key="plate",
        category="tableware",
        description="Dinner plate, white porcelain with a blue band",
        metric_height=HEIGHT,
        metric_height_source="typical dinner plate, 27 cm across and 2.5 cm high",
        mass=0.62,
        mass_source="typical 27 cm porcelain dinner plate: 0.55 to 0.75 kg",
        contact={"friction": 0.35, "restitution": 0.3},
        contact_source="glazed ceramic on wood or ceramic: friction 0.3 to 0.4; restitution of a dull click, conservative",
        parts=[Part("plate", plate, "glaze", density=2400, crease_deg=50)],
        materials={"glaze": {"texture": "glaze.png", "specular": 0.6, "shininess": 0.75, "roughness": 0.15}},
        recolour=("glaze",),
        textures={"glaze.png": _glaze(profile, along / along[-1])},
        collision=[
            hulls.cylinder(2 * 0.083, 0, FLOOR),
            *hulls.sectors(np.array([(0.082, 0.0025), (WELL, FLOOR), (0.100, 0.0065), (0.104, 0.0165)]), 16),
            *hulls.sectors(np.array([(0.101, 0.0090), (0.104, 0.0165), (0.1325, 0.0254), (0.1345, 0.0225)]), 16),
        ],
        supports=[Support("well", FLOOR, (2 * WELL, 2 * WELL), shape="ellipse", default=True)],
    )


def _glaze(profile: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Bands by the radius and side that each row of the picture lands on."""
    height, width = 512, 64
    row = 1 - (np.arange(height) + 0.5) / height
    radius = np.interp(row, v, profile[:, 0])
    upper = row > v[np.argmax(profile[:, 0])]
    shade = 0.955 - 0.05 * np.exp(-(((radius - 0.093) / 0.006) ** 2)) * upper
    picture = np.broadcast_to(shade[:, None, None] * np.array([1.0, 0.992, 0.972]), (height, width, 3)).copy()
    for centre, half, ink in ((0.1215, 0.0035, "#1d3f77"), (0.1148, 0.0006, "#1d3f77"), (0.1328, 0.0012, "#b58a3c")):
        cover = texture.edge(np.abs(radius - centre) - half, 0.0005) * upper
        picture = texture.blend(picture, ink, np.broadcast_to(cover[:, None], (height, width)))
    return picture
