"""An open laptop: aluminium slab, real keys, a lit screen with a landscape; the screen faces +X."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import Surface, join, rotation

WIDE, DEEP, THICK, LID = 0.312, 0.221, 0.0125, 0.0052  # m along y, x, z
OPEN = 108.0  # degrees between base and lid
ROWS = (
    ("esc", "1", "2", "3", "4", "5", "6", "7", "8", "9", "0", "-", "=", "del*1.5"),
    ("tab*1.5", *"QWERTYUIOP", "[", "]", "\\"),
    ("caps*1.75", *"ASDFGHJKL", ";", "'", "enter*1.75"),
    ("shift*2.25", *"ZXCVBNM", ",", ".", "/", "shift*2.25"),
    ("fn", "ctrl", "alt", "cmd*1.25", "*5", "cmd*1.25", "alt", "<", "v", ">"),
)
PITCH, GAP = 0.0190, 0.0028  # m
BOARD_X = (-0.083, 0.017)  # m, back and front edge of the keyboard well
BOARD_Y = 0.1385  # m, half its width


def make() -> Recipe:
    """The laptop; collision is one box for the base and one for the lid."""
    keys, board = _keys()
    lid, bezel, screen = _lid()
    base = _slab(DEEP, WIDE, THICK, 0.010).moved(0, 0, THICK / 2 + 0.0015)
    deck = THICK + 0.0015
    feet = [
        shapes.lathe(np.array([(0, 0), (0.006, 0), (0.0068, 0.0008), (0.0068, 0.0018), (0, 0.0018)]), 16).moved(x, y)
        for x in (-0.09, 0.09)
        for y in (-0.13, 0.13)
    ]
    well = _panel(BOARD_X[0], BOARD_X[1], BOARD_Y, deck + 0.0001)
    pad = _panel(0.030, 0.101, 0.056, deck + 0.0002)
    turn = rotation("y", 90 - OPEN)
    centre = _hinge() + turn @ np.array([0.0, 0.0, DEEP / 2])
    return Recipe(
        key="laptop",
        category="electronics",
        description="Open 14-inch laptop, aluminium, screen on, facing +x",
        metric_height=0.224,
        metric_height_source="typical 14-inch laptop, 31 x 22 cm, opened to about 108 degrees",
        mass=1.4,
        mass_source="typical 14-inch laptop: 1.2 to 1.6 kg",
        contact={"friction": 0.45, "restitution": 0.2},
        contact_source="aluminium and rubber feet on wood: friction 0.3 to 0.6; restitution conservative",
        parts=[
            Part("base", base, "aluminium", density=1250, crease_deg=35),
            Part("feet", join(feet), "rubber", density=1100),
            Part("lid", lid, "aluminium", density=1000, crease_deg=35),
            Part("bezel", bezel, "black", density=0),
            Part("screen", screen, "screen", density=0),
            Part("well", well, "black", density=0),
            Part("keys", keys, "keys", density=0, crease_deg=20),
            Part("trackpad", pad, "trackpad", density=0),
        ],
        materials={
            "aluminium": {
                "rgba": [0.70, 0.71, 0.73, 1.0],
                "specular": 0.55,
                "shininess": 0.35,
                "metallic": 1.0,
                "roughness": 0.35,
            },
            "rubber": {"rgba": [0.10, 0.10, 0.11, 1.0], "specular": 0.1, "shininess": 0.1},
            "black": {"rgba": [0.055, 0.055, 0.062, 1.0], "specular": 0.3, "shininess": 0.5, "roughness": 0.3},
            "screen": {"texture": "screen.png", "emission": 0.85, "specular": 0.1, "shininess": 0.6, "roughness": 0.1},
            "keys": {"texture": "keys.png", "specular": 0.15, "shininess": 0.2, "roughness": 0.6},
            "trackpad": {"rgba": [0.62, 0.63, 0.65, 1.0], "specular": 0.35, "shininess": 0.4, "roughness": 0.3},
        },
        recolour=("aluminium",),
        textures={"screen.png": _landscape(), "keys.png": board},
        texture_levels={"screen.png": 128},
        collision=[
            hulls.box((DEEP, WIDE, THICK + 0.0015), (0, 0, (THICK + 0.0015) / 2), name="base"),
            hulls.box((LID, WIDE, DEEP), tuple(float(c) for c in centre), tilt_deg=90 - OPEN, name="lid"),
        ],
        supports=[Support("deck", deck + 0.0015, (DEEP - 0.03, WIDE - 0.01), centre=(0.01, 0.0), default=True)],
    )


def _hinge() -> np.ndarray:
    return np.array([-DEEP / 2 + 0.0055, 0.0, THICK + 0.001])


def _slab(x: float, y: float, z: float, corner: float) -> Surface:
    """A plate with round corners in plan and softly rounded edges."""
    edge = min(0.0026, z / 2 - 0.0002)
    ring = shapes.rounded_section(x - 2 * edge, y - 2 * edge, corner, 7)
    return shapes.rounded_hull(np.array([(*p, s * (z / 2 - edge)) for p in ring for s in (-1, 1)]), edge, 2)


def _panel(back: float, front: float, half_width: float, z: float) -> Surface:
    """A thin flat inlay seen from above; u to the right, v to the back (for someone in front of it)."""
    vertices = np.array(
        [(front, -half_width, z), (front, half_width, z), (back, half_width, z), (back, -half_width, z)]
    )
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return Surface(vertices, faces, np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float), faces)


def _lid() -> tuple[Surface, Surface, Surface]:
    """Shell, black front glass and picture, built lying on the back of the hinge line and swung open."""
    turn = rotation("y", 90 - OPEN)

    def stand(surface: Surface) -> Surface:
        return surface.mapped(surface.vertices @ turn.T + _hinge())

    shell = _slab(DEEP, WIDE, LID, 0.010).turned("y", -90).moved(0, 0, DEEP / 2)

    def glass(margin_side: float, low: float, high: float, x: float) -> Surface:
        y = WIDE / 2 - margin_side
        vertices = np.array([(x, -y, low), (x, y, low), (x, y, high), (x, -y, high)])
        faces = np.array([(0, 1, 2), (0, 2, 3)])
        return Surface(vertices, faces, np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float), faces)

    return (
        stand(shell),
        stand(glass(0.004, 0.004, DEEP - 0.004, LID / 2 + 0.0002)),
        stand(glass(0.0085, 0.020, DEEP - 0.0095, LID / 2 + 0.0005)),
    )


def _keys() -> tuple[Surface, np.ndarray]:
    """Low bevelled caps in a recessed-looking well, and their legends on one picture mapped from above."""
    scale = 3600  # pixels per metre
    height, width = int((BOARD_X[1] - BOARD_X[0]) * scale), int(2 * BOARD_Y * scale)
    picture = np.full((height, width, 3), 0.115)
    total = 2 * BOARD_Y - 0.004
    caps = []
    for row, labels in enumerate(ROWS):
        weights = [float(label.split("*")[1]) if "*" in label else 1.0 for label in labels]
        unit = total / sum(weights)
        y = -total / 2
        x = BOARD_X[0] + 0.0025 + PITCH * (row + 0.5)
        for label, weight in zip(labels, weights, strict=True):
            w, middle = weight * unit, y + weight * unit / 2
            y += w
            half = np.array([(PITCH - GAP) / 2, (w - GAP) / 2])
            rings = [
                np.column_stack([shapes.rounded_section(*(2 * (half - d)), 0.0018 - d, 3), np.full(12, z)])
                for d, z in ((0, 0.0), (0, 0.0010), (0.0006, 0.0014))
            ]
            caps.append(shapes.hull(np.concatenate(rings)).moved(x, middle, THICK + 0.0015))
            text = label.split("*")[0]
            size = 24 if len(text) == 1 else 13
            at = ((middle + BOARD_Y) * scale, (x - BOARD_X[0]) * scale)
            if text:
                picture = _legend(picture, text, at, size)
    surface = join(caps)
    corner = surface.corners()
    u = (corner[:, 1] + BOARD_Y) / (2 * BOARD_Y)
    v = 1 - (corner[:, 0] - BOARD_X[0]) / (BOARD_X[1] - BOARD_X[0])
    return surface.with_uv(np.column_stack([u, v])), picture


def _legend(picture: np.ndarray, text: str, at: tuple[float, float], size: int) -> np.ndarray:
    """Letter one key by working on a small patch of the picture."""
    x, y, half = int(at[0]), int(at[1]), 40
    rows, columns = slice(max(0, y - half), y + half), slice(max(0, x - half), x + half)
    patch = picture[rows, columns]
    out = picture.copy()
    out[rows, columns] = texture.lettering(patch, text, (x - columns.start, y - rows.start), size, "#d9dce0", 500)
    return out


def _landscape() -> np.ndarray:
    """A dawn sky over five ridges that fade with distance, and a dock of icons."""
    height, width = 400, 640
    y, x = (
        np.mgrid[0:height, 0:width] / (height, width)
        if False
        else np.meshgrid(np.arange(height) / height, np.arange(width) / width, indexing="ij")
    )
    picture = texture.ramp(y / 0.72, ["#22366f", "#5a5fa6", "#c77fa2", "#f4a878", "#ffd9a0"])
    sun = np.hypot((x - 0.64) * width / height, y - 0.50)
    picture = picture + np.exp(-((sun / 0.16) ** 2))[..., None] * np.array([0.30, 0.20, 0.08])
    picture = texture.blend(np.clip(picture, 0, 1), "#fff1cf", texture.edge(sun - 0.062, 0.006))
    layers = ("#b07a93", "#805f8a", "#57497a", "#352f5c", "#1b1a38")
    for k, ink in enumerate(layers):
        line = texture.noise((1, 1024), 90 + k, slope=1.35)[0, :width]
        level = 0.55 + 0.085 * k - (0.060 - 0.004 * k) * line
        cover = texture.edge((level[None] - y) * height, 1.5)
        haze = texture.colour(ink)[None, None] + 0.16 * np.clip((y - level[None]) / 0.2, 0, 1)[..., None] * (
            0.25 if k < 4 else 0.0
        )
        picture = texture.blend(picture, haze, cover)
    dock = _pill(x * width, y * height, width / 2, height - 25, 148, 17, 9)
    picture = texture.blend(picture, "#dfe3ee", 0.45 * texture.edge(dock, 1.5))
    for n, ink in enumerate(("#3b82f6", "#f97316", "#22c55e", "#e11d48", "#a855f7", "#facc15", "#14b8a6", "#64748b")):
        icon = _pill(x * width, y * height, width / 2 + (n - 3.5) * 35, height - 25, 12, 12, 5)
        picture = texture.blend(picture, ink, texture.edge(icon, 1.5))
    return texture.blend(picture, "#10142a", 0.45 * texture.edge(y * height - 13, 1.0))


def _pill(x: np.ndarray, y: np.ndarray, cx: float, cy: float, half_w: float, half_h: float, r: float) -> np.ndarray:
    """Signed distance to a rounded rectangle, pixels."""
    dx, dy = np.abs(x - cx) - half_w + r, np.abs(y - cy) - half_h + r
    return np.hypot(np.maximum(dx, 0), np.maximum(dy, 0)) + np.minimum(np.maximum(dx, dy), 0) - r
