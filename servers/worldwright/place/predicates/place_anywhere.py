"""The subject is at a free place on a surface, drawn from a seed.

    z = reference.min_z + surface.height + half_z
    (x, y) = a place of a Poisson-disk sample of the free area (Bridson 2007) with disk radius r = 2 R + spacing

All subjects of one reference with the same params are drawn together: R is the largest of their circumscribed circles,
so that none can touch another at any yaw, and `spacing` is the free distance between these circles. A place keeps its
circle `margin` metres from the edge and clear of everything that other rows place there. `surface` names where on the
reference (omitted: its default one); on the base, `area` [x, y] is the extents of the region in metres, around `center`
[x, y] (omitted: its middle). `seed` omitted is the plan's own; names, not the order of rows, decide who gets which
place.
Source: paper, predicate algebra, special (the excerpt is silent on parameters; these are ours).
"""

import math

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, Surface, shown, total
from ..parameters import Parameter
from ..vocabulary import Case
from . import _poisson

CODE = "PLACE-ANYWHERE"
FAMILY = "Containment and free placement"
REFERENCE = "optional"
PARAMS = {
    "surface": Parameter("name", "named surface of the reference; omitted: its default one"),
    "area": Parameter("pair", "extents of the region, metres; needed on the base", 0.0),
    "center": Parameter("pair", "middle of the region from the middle of the surface, metres; omitted: 0, 0"),
    "spacing": Parameter("number", "free metres between two of them; omitted: 0", 0.0),
    "margin": Parameter("number", "free metres to the edge of the region; omitted: 0", 0.0),
    "seed": Parameter("number", "of the draw; omitted: simulation_parameters.seed"),
}
UNIT = "m"
SUPPORTS = True


def _field(name: str | None) -> Surface:
    return Surface("top", 0.7, (1.0, 2.0))


TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0, "surface": _field}
CUP = {"name": "cup", "size": (0.1, 0.1, 0.1), "x": 0.5, "y": 1.0, "z": 0.75, "yaw": 0}
GOOD = (Case({"size": (0.2, 0.2, 0.1)}, TABLE, {"spot": (0.6, 1.2)}, {"x": 0.6, "y": 1.2, "z": 0.75}),)
BAD = (
    Case({"size": (0.2, 0.2, 0.1), "x": 0.95, "y": 1.0, "z": 0.75, "yaw": 0}, TABLE, {"spot": (0.95, 1.0)}),
    Case(
        {"size": (0.2, 0.2, 0.1), "x": 0.6, "y": 1.0, "z": 0.75, "yaw": 0},
        TABLE,
        {"spot": (0.6, 1.0), "other": CUP, "spacing": 0.1},
    ),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets all three coordinates."""
    return {"x": ("reference.x", "reference.yaw"), "y": ("reference.y", "reference.yaw"), "z": ("reference.z",)}


def radius(box: Box) -> float:
    """The radius of the circle around the footprint at any yaw, metres."""
    sx, sy, _ = box.size
    return max(sx, sy) / 2 if box.round else math.hypot(sx, sy) / 2


def region(reference: Box, params: dict) -> Surface:
    """The area to draw in, in the reference's own frame."""
    try:
        surface = reference.surface(params.get("surface"))
    except KeyError as cause:
        message = str(cause.args[0])
        raise CannotResolveError(message, "name one of its surfaces, or leave `surface` out for the default") from cause
    if "area" not in params and not math.isfinite(surface.extents[0]):
        raise CannotResolveError("the ground has no edge", "add `area: [x, y]`, the extents of the region in metres")
    cx, cy = params.get("center", (0.0, 0.0))
    extents = params.get("area", surface.extents)
    shape = "rectangle" if "area" in params else surface.shape
    return Surface(surface.name, surface.height_m, extents, (surface.centre[0] + cx, surface.centre[1] + cy), shape)


def sample(subjects: list[Box], reference: Box, params: dict, obstacles: list[Box]) -> list[tuple[float, float]]:
    """Draw a place for each subject, world frame, m, clear of the obstacles."""
    area = region(reference, params)
    plane = reference.low("z") + area.height_m
    reach = max(radius(box) for box in subjects)
    height = max(box.size[2] for box in subjects)
    in_way = [
        box
        for box in obstacles
        if box.name != reference.name and box.high("z") > plane + TOLERANCE_M and box.low("z") < plane + height
    ]
    spacing = params.get("spacing", 0.0)

    def fits(x: float, y: float) -> bool:
        if area.inset(x, y) < reach + params.get("margin", 0.0):
            return False
        dx, dy = reference.to_world(x, y)
        return all(away(reference.get("x") + dx, reference.get("y") + dy, box) >= reach + spacing for box in in_way)

    spots = _poisson.places(area, 2 * reach + spacing, int(params["seed"]), fits)
    if len(spots) < len(subjects):
        where = reference.name
        raise CannotResolveError(
            f"there is room for {len(spots)} of the {len(subjects)} objects that go anywhere on {where}",
            "enlarge the area, or reduce `spacing` and `margin`, or place fewer",
        )
    found = []
    for x, y in spots[: len(subjects)]:
        dx, dy = reference.to_world(x, y)
        found.append((reference.get("x") + dx, reference.get("y") + dy))
    return found


def away(x: float, y: float, box: Box) -> float:
    """Distance of a world point to a footprint in the plane, metres; 0 inside."""
    u, v = box.to_own(x, y)
    if box.round:
        return max(math.hypot(u, v) - radius(box), 0.0)
    return math.hypot(max(abs(u) - box.size[0] / 2, 0.0), max(abs(v) - box.size[1] / 2, 0.0))


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the drawn place, and the height of the surface."""
    if dof == "z":
        area = region(reference, params) if "spot" not in params else reference.surface(params.get("surface"))
        plane = reference.low("z") + area.height_m
        return total("z", (f"{reference.name}.{area.name}", plane), (f"{subject.name}.half_z", subject.half("z")))
    value = params["spot"]["xy".index(dof)]
    seed = f", seed {params['seed']:g}" if "seed" in params else ""
    return Derivation(value, f"{dof} = drawn on {reference.name}{seed} = {shown(value)}")


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the smallest of: the place drawn, the distance to the edge, and to the others drawn with it; metres."""
    area, reach = region(reference, params), radius(subject)
    x, y = reference.to_own(subject.get("x"), subject.get("y"))
    spot = params["spot"]
    margins = [
        TOLERANCE_M - abs(subject.low("z") - reference.low("z") - area.height_m),
        TOLERANCE_M - max(abs(subject.get("x") - spot[0]), abs(subject.get("y") - spot[1])),
        area.inset(x, y) - reach - params.get("margin", 0.0) + TOLERANCE_M,
    ]
    for other in params.get("others", [params["other"]] if "other" in params else []):
        gap = math.hypot(subject.get("x") - other.get("x"), subject.get("y") - other.get("y"))
        margins.append(gap - reach - radius(other) - params.get("spacing", 0.0) + TOLERANCE_M)
    return min(margins)
