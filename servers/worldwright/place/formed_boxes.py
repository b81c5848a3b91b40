"""A form (a cone, a bowl, a hill …) as the resolver sees it: the box around it, and its level places.

`top` is the level face at its highest point, if it has one; `inside` the bottom of a vessel; the others are called `level_1`,
`level_2` … from the top down.
"""

from ..model.plan.committed import SceneObject
from .anchors import Box, Surface

TURNED = ("cone", "torus", "lathe")
"""What is round about its own z."""
EXACT = 1e-6


def box(row: SceneObject) -> Box:
    """The unplaced box of a form, after its tilt."""
    import numpy as np

    form = row.form()
    bottom = -form.extents[2] / 2
    upright = row.primitive in TURNED and not row.deg_x
    known: dict[str, Surface] = {}
    if row.primitive == "lathe" and row.wall_thickness and upright:
        known["inside"] = _inside(row)
    for number, (height, corners) in enumerate(form.levels(), start=1):
        away = float(np.linalg.norm(corners, axis=1).min())
        if upright and away > EXACT:
            continue  # a rim: nothing small can stand in its middle
        name = "top" if abs(height + bottom) < EXACT else f"level_{number}"
        low, high = corners.min(axis=0), corners.max(axis=0)
        middle, extents = (low + high) / 2, high - low
        shape = "ellipse" if upright else "rectangle"
        place = (0.0, 0.0) if upright else (float(middle[0]), float(middle[1]))
        known[name] = Surface(name, height - bottom, (float(extents[0]), float(extents[1])), place, shape)

    def surface(name: str | None) -> Surface:
        wanted = name or next(iter(known), "top")
        if wanted in known:
            return known[wanted]
        told = f"has no surface {name!r}" if name else f"has no level surface: it is a {row.primitive}"
        raise KeyError(f"{row.name} {told}; level are: {', '.join(known) or 'none'}")

    return Box(row.name, row.extents, round=upright, surface=surface, surfaces=lambda: list(known.values()))


def _inside(row: SceneObject) -> Surface:
    """The bottom of a vessel: as wide as it is within 2 % of its height above its lowest inner point."""
    import numpy as np

    form = row.form()
    away = np.hypot(form.vertices[:, 0], form.vertices[:, 1])
    heights = form.vertices[:, 2]
    low = heights.min()
    floor = float(heights[away < EXACT].max()) if (away < EXACT).any() else float(low)
    near = (heights >= floor - EXACT) & (heights <= floor + 0.02 * form.extents[2])
    half = float(away[near].max()) if near.any() else 0.0
    return Surface("inside", floor - float(low), (2 * half, 2 * half), shape="ellipse")
