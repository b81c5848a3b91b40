"""A cloth-bound hardcover lying flat; someone in front of it (+X) can read the cover, the spine is on their left."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import Surface

LENGTH, WIDTH, HEIGHT = 0.235, 0.160, 0.032  # m along x, y, z
BOARD, INSET = 0.0032, 0.004  # m
NAVY, GOLD = "#16294d", "#d3a94f"


def make() -> Recipe:
    """The book: one wrapped cover around a block of pages."""
    cover = _cover()
    pages = _pages()
    return Recipe(
        key="book",
        category="office",
        description="Hardcover book, 23.5 x 16 cm, lying flat",
        metric_height=HEIGHT,
        metric_height_source="typical hardcover novel: 235 x 160 mm, about 320 pages, 30 mm thick",
        mass=0.62,
        mass_source="typical 320-page hardcover: 0.5 to 0.75 kg",
        contact={"friction": 0.4, "restitution": 0.15},
        contact_source="book cloth on wood: friction 0.3 to 0.5; restitution of a soft slap",
        parts=[
            Part("cover", cover, "cloth", density=700, crease_deg=35),
            Part("pages", pages, "paper", density=750, crease_deg=30),
        ],
        materials={
            "cloth": {"texture": "cover.png", "specular": 0.12, "shininess": 0.2, "roughness": 0.7},
            "paper": {"texture": "pages.png", "specular": 0.02, "shininess": 0.05, "roughness": 0.95},
        },
        recolour=("cloth",),
        textures={"cover.png": _picture(), "pages.png": _edges()},
        texture_levels={"cover.png": 86, "pages.png": 64},
        collision=[hulls.box((LENGTH, WIDTH, HEIGHT), (0, 0, 0))],
        supports=[Support("cover", HEIGHT / 2, (LENGTH, WIDTH), default=True)],
    )


def _cover() -> Surface:
    """A U-shaped section (spine at -Y, slightly rounded, with a hinge groove) carried along x."""
    h, w, b = HEIGHT / 2, WIDTH / 2, BOARD
    r = 0.0009
    outer = [
        (w - r, h),
        (-w + 0.0135, h),
        (-w + 0.0115, h - 0.0010),
        (-w + 0.0085, h - 0.0010),
        (-w + 0.0065, h - 0.0002),
    ]
    spine = shapes.arc((-w + 0.0065, 0), 1.0, 90, 270, 17)
    spine = np.column_stack([-w + 0.0065 + 0.0065 * (spine[:, 0] + w - 0.0065), (h - 0.0002) * spine[:, 1]])
    lower = [(y, -z) for y, z in outer[::-1]]
    inner_spine = np.column_stack(
        [
            -w + 0.0085 + 0.0055 * np.cos(np.radians(np.linspace(250, 110, 9))),
            (h - b) * np.sin(np.radians(np.linspace(250, 110, 9))) / np.sin(np.radians(110)),
        ]
    )
    section = np.concatenate(
        [
            outer,
            spine[1:-1],
            lower,
            [(w, -h + r), (w, -h + b - r), (w - r, -h + b)],
            inner_spine,
            [(w - r, h - b), (w, h - b + r), (w, h - r)],
        ]
    )
    if np.sum(section[:, 0] * np.roll(section[:, 1], -1) - section[:, 1] * np.roll(section[:, 0], -1)) < 0:
        section = section[::-1]
    x = LENGTH / 2
    body = shapes.sweep(
        np.array([(-x, 0, 0), (-x + 0.0008, 0, 0), (x - 0.0008, 0, 0), (x, 0, 0)]), section, side=(0, 1, 0)
    )
    corner, face = body.corners(), np.repeat(_face_normals(body), 3, axis=0)
    across, along = corner[:, 1] / WIDTH + 0.5, 0.5 - corner[:, 0] / LENGTH
    # the picture holds the front in its right half, spine and plain cloth in its left half
    front = (face[:, 2] > 0.5) & (corner[:, 2] > h - 0.002)
    spine_side = (face[:, 1] < -0.4) & (corner[:, 1] < -w + 0.007)
    u = np.where(
        front,
        0.5 + 0.5 * across,
        np.where(spine_side, 0.02 + 0.10 * (corner[:, 2] / HEIGHT + 0.5), 0.16 + 0.3 * across),
    )
    return body.with_uv(np.column_stack([u, along]))


def _pages() -> Surface:
    size = (LENGTH - 2 * INSET, WIDTH - INSET - 0.006, HEIGHT - 2 * BOARD + 0.0002)
    block = shapes.rounded_box(size, 0.0004, 1).moved(0, 0.001, 0)
    corner = block.corners()
    return block.with_uv(np.column_stack([(corner[:, 0] + corner[:, 1]) / 0.24, corner[:, 2] / size[2] + 0.5]))


def _face_normals(surface: Surface) -> np.ndarray:
    corners = surface.vertices[surface.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def _edges() -> np.ndarray:
    lines = texture.noise((128, 256), 71, slope=0.3, stretch=(60, 1))
    return texture.ramp(0.62 + 0.16 * lines, ["#b7a988", "#e2d8be", "#f6f0df"])


def _picture() -> np.ndarray:
    """Gold on navy cloth: a ball's bouncing path under a ruled frame, title above."""
    height, width = 640, 880
    grain = texture.noise((height, width), 72, slope=0.3) * 0.5 + texture.noise((height, width), 73, slope=1.3) * 0.5
    picture = np.clip(texture.colour(NAVY) * (1 + 0.10 * grain[..., None]), 0, 1)
    y, x = np.mgrid[0:height, 0:width].astype(float)
    left = width / 2
    x0, w = left + 0.10 * width / 2, 0.84 * width / 2  # the frame sits clear of the hinge
    inside = np.maximum(np.abs(x - x0 - w / 2) - w / 2 + 6, np.abs(y - height / 2) - height / 2 + 36)
    for at, half in ((0, 1.8), (-9, 0.7)):
        picture = texture.blend(picture, GOLD, texture.edge(np.abs(inside - at) - half, 1.2))
    floor, ground = 0.80 * height, x0 + 0.10 * w
    reach = 0.80 * w
    path = np.full_like(x, 1e9)
    start, span, tall = ground - 0.30 * reach, 0.60 * reach, 0.36 * height
    for _ in range(5):
        t = np.clip((x - start) / span, 0, 1)
        crest = floor - tall * 4 * t * (1 - t)
        slope = np.hypot(1, tall * 4 * (1 - 2 * t) / span)
        here = (x >= max(start, ground)) & (x <= min(start + span, ground + reach))
        path = np.where(here, np.minimum(path, np.abs(y - crest) / slope), path)
        start, span, tall = start + span, span * 0.72, tall * 0.55
    picture = texture.blend(picture, GOLD, texture.edge(path - 1.7, 1.2))
    ruled = np.maximum(np.abs(y - floor - 3) - 1.4, np.abs(x - ground - reach / 2) - reach / 2)
    picture = texture.blend(picture, GOLD, texture.edge(ruled, 1.2))
    ball = np.hypot(x - ground - 2, y - floor + 0.36 * height) - 19
    picture = texture.blend(picture, GOLD, texture.edge(ball, 1.2))
    middle = x0 + w / 2
    picture = texture.lettering(picture, "THINGS", (middle, 0.165 * height), 54, GOLD, 800)
    picture = texture.lettering(picture, "THAT FALL", (middle, 0.255 * height), 54, GOLD, 800)
    picture = texture.lettering(picture, "a field guide to gravity", (middle, 0.875 * height), 22, GOLD, 400)
    for bar in (0.08, 0.105, 0.88, 0.905):  # rules across the spine
        rule = np.maximum(np.abs(y - bar * height) - 2.2, np.abs(x - 0.07 * width) - 0.05 * width)
        picture = texture.blend(picture, GOLD, texture.edge(rule, 1.2))
    strip = np.rot90(picture[:, : int(0.14 * width)], 1).copy()
    strip = texture.lettering(strip, "THINGS THAT FALL", (height / 2, 0.07 * width), 40, GOLD, 800)
    picture[:, : int(0.14 * width)] = np.rot90(strip, -1)
    return picture
