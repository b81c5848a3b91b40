"""A walnut dining chair with a padded seat; the backrest is at -X, so it faces +X."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import Surface, join

SEAT, HEIGHT = 0.46, 0.86  # m, top of the pad; top of the backrest
WIDE, NARROW = 0.205, 0.185  # m, half distance between front legs and between back legs
FRONT, BACK = 0.190, -0.180  # m
TILE = 0.40


def make() -> Recipe:
    """The chair: swept back posts, bowed rails, a soft seat."""
    posts = [_post(side) for side in (1, -1)]
    crest = _rail(0.815, 0.075, 0.022)
    slats = [_rail(z, 0.034, 0.014) for z in (0.735, 0.665, 0.595)]
    fronts = [
        shapes.tapered_box((0.028, 0.028), (0.042, 0.042), (0.0, 0.425), 0.005)
        .moved(FRONT, s * WIDE)
        .box_uv(TILE, "z", (0.2 * s, 0.37))
        for s in (1, -1)
    ]
    frame = [
        _beam((FRONT, -WIDE, 0.395), (FRONT, WIDE, 0.395), 0.06, 0.022),
        _beam((BACK, -NARROW, 0.395), (BACK, NARROW, 0.395), 0.06, 0.022),
        *[_beam((BACK, s * NARROW, 0.395), (FRONT, s * WIDE, 0.395), 0.06, 0.022) for s in (1, -1)],
        *[
            _beam((BACK - 0.012, s * (NARROW + 0.002), 0.17), (FRONT, s * (WIDE + 0.0), 0.17), 0.026, 0.016)
            for s in (1, -1)
        ],
        _beam((0.0, -0.195, 0.17), (0.0, 0.195, 0.17), 0.026, 0.016),
    ]
    seat = _seat()
    return Recipe(
        key="chair",
        category="furniture",
        description="Walnut dining chair with a padded seat, facing +x",
        metric_height=HEIGHT,
        metric_height_source="typical dining chair: 80 to 95 cm high, seat at 45 to 46 cm",
        mass=5.6,
        mass_source="typical wooden dining chair: 5 to 7 kg",
        contact={"friction": 0.45, "restitution": 0.3},
        contact_source="wood on wood, dry: friction 0.25 to 0.5 (Engineering ToolBox); restitution conservative",
        parts=[
            Part("posts", join(posts), "walnut", density=640, crease_deg=50),
            Part("rails", join([crest, *slats]), "walnut", density=640, crease_deg=50),
            Part("front_legs", join(fronts), "walnut", density=640),
            Part("frame", join(frame), "walnut", density=640),
            Part("seat", seat, "fabric", density=120, crease_deg=80),
        ],
        materials={
            "walnut": {"texture": "walnut.png", "specular": 0.22, "shininess": 0.35, "roughness": 0.45},
            "fabric": {"texture": "fabric.png", "specular": 0.03, "shininess": 0.05, "roughness": 0.95},
        },
        recolour=("fabric",),
        textures={
            "walnut.png": texture.wood(384, 61, ["#3a2112", "#5b3820", "#7a5131", "#946842"], rings=8),
            "fabric.png": texture.weave(128, 65, 24, ["#5d665c", "#8d9788", "#b9c0b0"]),
        },
        texture_levels={"walnut.png": 64, "fabric.png": 64},
        collision=[
            hulls.box(
                (FRONT - BACK + 0.05, 2 * WIDE + 0.03, 0.055), (0.007, 0, SEAT - 0.0275), name="seat", friction=0.6
            ),
            *[_box_under(s) for s in (1, -1)],
            *[piece for post in posts for piece in hulls.decomposed(post, threshold=0.08)],
            *hulls.decomposed(crest, threshold=0.08),
            *[piece for slat in slats for piece in hulls.decomposed(slat, threshold=0.1)],
            hulls.box((0.022, 2 * WIDE, 0.06), (FRONT, 0, 0.395), name="apron_front"),
            hulls.box((0.026, 0.39, 0.016), (0, 0, 0.17), name="stretcher"),
        ],
        supports=[Support("seat", SEAT, (0.36, 0.36), centre=(0.005, 0.0), default=True)],
    )


def _box_under(side: int) -> hulls.Hull:
    points = [(x * s / 2, y * s / 2, z) for s, z in ((0.026, 0.0), (0.042, 0.425)) for x in (-1, 1) for y in (-1, 1)]
    return hulls.Hull(
        shapes.hull(np.array(points)).moved(FRONT, side * WIDE), name=f"leg_front_{'left' if side > 0 else 'right'}"
    )


def _post(side: int) -> Surface:
    """Back leg and backrest post in one bent piece; it starts flat on the floor."""
    line = shapes.curve(
        [(-0.225, 0.0), (-0.198, 0.2), (BACK - 0.004, 0.42), (-0.196, 0.62), (-0.245, HEIGHT - 0.012)], 20
    )
    line[0, 1], line[1, 0] = 0.0, line[1, 0]
    path = np.column_stack([line[:, 0], np.full(len(line), side * NARROW), line[:, 1]])
    scale = np.interp(np.linspace(0, 1, 20), [0, 0.5, 1], [0.78, 1.0, 0.72])
    body = shapes.sweep(
        path, shapes.rounded_section(0.030, 0.040, 0.008), side=(0, 1, 0), scale=scale, tile=(TILE, TILE)
    )
    floor = np.where(np.arange(len(body.vertices)) < 12, 0.0, body.vertices[:, 2])  # the first ring lies in the floor
    return body.mapped(np.column_stack([body.vertices[:, :2], floor]))


def _rail(height: float, tall: float, thick: float) -> Surface:
    """A rail bowed to the back between the posts."""
    lean = np.interp(height, [0.42, 0.62, 0.85], [BACK - 0.004, -0.196, -0.242])
    y = np.linspace(-NARROW - 0.004, NARROW + 0.004, 17)
    path = np.column_stack([lean - 0.026 * (1 - (y / NARROW) ** 2), y, np.full(17, height)])
    section = shapes.rounded_section(thick, tall, 0.0045)
    return shapes.sweep(path, section, side=(-1, 0, -0.15), tile=(TILE, TILE))


def _beam(start: tuple[float, float, float], end: tuple[float, float, float], tall: float, thick: float) -> Surface:
    path = np.linspace(start, end, 2)
    along = path[1] - path[0]
    side = np.cross(along, (0, 0, 1))
    return shapes.sweep(path, shapes.rounded_section(thick, tall, 0.003, 2), side=tuple(side), tile=(TILE, TILE))


def _seat() -> Surface:
    """A pad with a soft crown: a rounded trapezoid whose rings shrink towards the top."""
    outline = [(FRONT + 0.035, WIDE + 0.022), (BACK - 0.012, NARROW + 0.006)]
    quad = np.array(
        [(x, y * s) for (x, y), s in ((outline[0], 1), (outline[1], 1), (outline[1], -1), (outline[0], -1))]
    )
    r, loop = 0.045, []
    for k in range(4):
        before, here, after = quad[k - 1], quad[k], quad[(k + 1) % 4]
        a, b = (before - here) / np.linalg.norm(before - here), (after - here) / np.linalg.norm(after - here)
        t = np.linspace(0, 1, 8)[:, None]
        loop.append((1 - t) ** 2 * (here + a * r) + 2 * t * (1 - t) * here + t**2 * (here + b * r))
    ring = np.concatenate(loop)
    middle = quad.mean(axis=0)
    steps = [
        (0.97, 0.422),
        (1.0, 0.428),
        (1.005, 0.436),
        (0.995, 0.445),
        (0.97, 0.4515),
        (0.92, 0.4555),
        (0.8, 0.4588),
        (0.6, 0.46),
        (0.3, 0.46),
    ]
    rows = [np.column_stack([middle + (ring - middle) * s, np.full(len(ring), z)]) for s, z in steps]
    n = len(ring)
    vertices = np.concatenate([*rows, [[*middle, 0.46], [*middle, 0.422]]])
    a, b = np.arange(n), (np.arange(n) + 1) % n
    faces = []
    for k in range(len(steps) - 1):
        low, high = k * n, (k + 1) * n
        faces += [np.column_stack([low + a, low + b, high + b]), np.column_stack([low + a, high + b, high + a])]
    top, bottom = len(vertices) - 2, len(vertices) - 1
    last = (len(steps) - 1) * n
    faces += [np.column_stack([last + a, last + b, np.full(n, top)]), np.column_stack([b, a, np.full(n, bottom)])]
    pad = Surface.bare(vertices, np.concatenate(faces))
    if np.cross(*(ring[[1, 2]] - ring[0])) < 0:
        pad = Surface.bare(pad.vertices, pad.faces[:, ::-1])
    return pad.box_uv(0.09, "x")
