"""Turn a compound into what the resolver needs: the box around its parts, and the level tops on which things can rest.

A surface has the name of its part (`seat` of a chair, `rung_3` of a ladder). For a box_container part it is the floor, and
the first of these is also called `inside`; `top`, the default, is the largest that reaches the top of the whole.
"""

from worldkit.parts import Solid

from ..model.plan.committed import SceneObject
from .anchors import Box, Surface

EXACT = 1e-6


def box(row: SceneObject) -> Box:
    """The unplaced box of a compound, after its tilt."""
    whole = row.whole()
    bottom = -whole.extents[2] / 2
    tops = [found for solid in whole.solids if (found := _top(row.name, solid, bottom)) is not None]
    known = {surface.name: surface for surface in tops}
    floors = [found for solid in whole.solids if _floor(solid) and (found := _top(row.name, solid, bottom)) is not None]
    if floors:
        known["inside"] = floors[0]
    highest = [s for s in tops if abs(s.height_m - whole.extents[2]) < EXACT]
    if highest:
        largest = max(highest, key=lambda s: s.extents[0] * s.extents[1])
        known = {"top": Surface("top", largest.height_m, largest.extents, largest.centre, largest.shape)} | known

    def surface(name: str | None) -> Surface:
        if (name or "top") in known:
            return known[name or "top"]
        told = f"has no surface {name!r}" if name else "has no level top"
        raise KeyError(f"{row.name} {told}; level are: {', '.join(known) or 'none'}")

    return Box(row.name, whole.extents, surface=surface, surfaces=lambda: list(known.values()))


def _top(name: str, solid: Solid, bottom: float) -> Surface | None:
    """The level upper face of a solid; None if it is round, slopes, or lies askew in the object."""
    askew = any(EXACT < abs(v) < 1 - EXACT for row in solid.rotation for v in row)
    label = solid.name.removeprefix(f"{name}/")
    if _floor(solid):
        label = label.removesuffix("_floor")
    centre = solid.centre[:2]
    width, length, tall = (2 * v for v in solid.reach)
    height = solid.centre[2] + tall / 2 - bottom
    if solid.shape == "box" and not askew:
        return Surface(label, height, (width, length), centre)
    if solid.shape == "cylinder" and abs(solid.rotation[2][2]) > 1 - EXACT:
        return Surface(label, height, (width, length), centre, "ellipse")
    return None


def _floor(solid: Solid) -> bool:
    """The floor of a box_container part."""
    return solid.part.shape == "container" and solid.name.endswith("_floor")
