"""A tenpin bowling pin: white coat with two red neck rings, to the measures of the sport."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe

INCH = 0.0254
HEIGHT = 15 * INCH  # m
DIAMETERS = [  # height and diameter in inches, from base to crown
    (0.0, 2.031), (0.75, 2.828), (2.25, 3.906), (3.375, 4.510), (4.5, 4.766), (5.875, 4.563), (7.25, 3.703),
    (8.625, 2.472), (9.375, 1.965), (10.0, 1.797), (10.875, 1.870), (11.75, 2.094), (12.625, 2.406), (13.5, 2.547),
]  # fmt: skip
SIDES = 28


def make() -> Recipe:
    """The pin; its collision pieces are the belly, the neck's two cones, and the head, each convex."""
    side = shapes.curve([(d / 2 * INCH, z * INCH) for z, d in DIAMETERS], 60)
    crown = shapes.arc((0.0, 15 * INCH - 1.273 * INCH), 1.273 * INCH, 0, 90, 14)[1:]
    crown[:, 1] += HEIGHT - crown[-1, 1]
    profile = np.concatenate([[(0.0, 0.0)], side, crown])
    profile[-1, 0] = 0
    heights = np.cumsum(np.r_[0, np.linalg.norm(np.diff(profile, axis=0), axis=1)])
    return Recipe(
        key="bowling_pin",
        category="sport",
        description="Tenpin bowling pin, white with two red rings on its neck",
        metric_height=HEIGHT,
        metric_height_source="USBC equipment specifications: 15 in, diameters at fourteen heights",
        mass=1.53,
        mass_source="USBC equipment specifications: 3 lb 6 oz to 3 lb 10 oz",
        contact={"friction": 0.25, "torsional": 0.001, "rolling": 0.0002, "restitution": 0.65},
        contact_source="USBC: coefficient of restitution 0.605 to 0.735; friction of a plastic coat, conservative",
        parts=[Part("pin", shapes.lathe(profile, 64), "coat", density=700, crease_deg=60)],
        materials={"coat": {"texture": "coat.png", "specular": 0.5, "shininess": 0.7, "roughness": 0.2}},
        recolour=("coat",),
        textures={"coat.png": _coat(profile[:, 1], heights / heights[-1])},
        texture_levels={"coat.png": 48},
        collision=[
            _piece(profile, low, high)
            for low, high in ((0, 7.25), (7.25, 8.625), (8.625, 10), (10, 11.75), (11.75, 15))
        ],
    )


def _piece(profile: np.ndarray, low: float, high: float) -> hulls.Hull:
    """The convex hull of the pin between two heights (in)."""
    inside = (profile[:, 1] >= low * INCH - 1e-6) & (profile[:, 1] <= high * INCH + 1e-6) & (profile[:, 0] > 0)
    edge = [
        (np.interp(z, profile[1:-1, 1], profile[1:-1, 0]), z) for z in (low * INCH, high * INCH) if z < HEIGHT - 0.02
    ]
    rings = [*profile[inside][::4], *edge]
    turns = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z in rings for a in turns]
    return hulls.Hull(shapes.hull(np.array([*points, *([(0, 0, HEIGHT)] if high == 15 else [])])))


def _coat(z: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Ivory with two rings, lightly worn towards the base."""
    height, width = 512, 256
    row = 1 - (np.arange(height) + 0.5) / height
    at = np.interp(row, v, z)[:, None] / INCH
    worn = texture.noise((height, width), 31, slope=1.2)
    picture = texture.ramp(0.8 + 0.05 * worn + 0.0 * at, ["#e4dfd0", "#faf8f0"])
    scuff = texture.edge(1.9 - texture.noise((height, width), 32, slope=0.8, stretch=(1, 2)) - 0.5 * (at < 5), 0.2)
    picture = texture.blend(picture, "#8d8779", 0.25 * scuff)
    for middle in (9.6, 10.7):
        picture = texture.blend(picture, "#c01f26", texture.edge(np.abs(at - middle) - 0.22 + 0.0 * worn, 0.03))
    return picture
