"""The body's bottom face is at the free surface of a fluid, so that it settles under its own load.

    z = level + half_z        with level = `level` in the world, or inside.floor + `depth` of the reference
    (x, y) = inside.center + Rz(reference.yaw) offset        when `offset` is given

`level` is metres above the ground, or the name of a layer of `topology.reference_heights`; `depth` is metres of fluid above the
inner floor of the reference (a container). Give one of the two. `offset` [dx, dy] runs along the container's own axes;
omitted, other rows set x and y. The centre must lie inside. Source: paper, relation patterns, "Surface-float";
parameters are ours.
"""

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, Surface, shown, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "floating_box_at_surface"
FAMILY = "Surface-float template"
REFERENCE = "required"
PARAMS = {
    "level": Parameter("height", "the free surface, metres above the ground, or a named layer"),
    "depth": Parameter("number", "depth of the fluid above the inner floor, metres", 0.0),
    "offset": Parameter("pair", "metres from the middle of the inside, along the container's own x and y"),
}
UNIT = "m"


def _tank(name: str | None) -> Surface:
    return Surface("inside", 0.1, (1.8, 0.8))


TANK = {"name": "tank", "size": (2.0, 1.0, 0.8), "x": 1.0, "y": 1.0, "z": 0.4, "yaw": 90, "surface": _tank}
GOOD = (
    Case({"size": (0.4, 0.4, 0.2)}, TANK, {"depth": 0.5, "offset": (0.3, 0.0)}, {"x": 1.0, "y": 1.3, "z": 0.7}),
    Case({"size": (0.4, 0.4, 0.2)}, TANK, {"level": 0.55}, {"z": 0.65}),
)
BAD = (
    Case({"size": (0.4, 0.4, 0.2), "x": 1.0, "y": 1.0, "z": 0.6, "yaw": 0}, TANK, {"depth": 0.5}),
    Case({"size": (0.4, 0.4, 0.2), "x": 1.5, "y": 1.0, "z": 0.7, "yaw": 0}, TANK, {"depth": 0.5}),
)


def refuse(params: dict) -> tuple[str, str] | None:
    """Refuse a surface that is given twice or not at all."""
    if ("level" in params) == ("depth" in params):
        return ("it must say where the surface is, once", "give `level` (world) or `depth` (above the inner floor)")
    return None


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when `offset` is given."""
    plane = {a: (f"reference.{a}", "reference.yaw") for a in ("x", "y")} if "offset" in params else {}
    return {"z": ("reference.z",) if "depth" in params else (), **plane}


def _inside(reference: Box) -> Surface:
    try:
        return reference.surface("inside")
    except KeyError as cause:
        raise CannotResolveError(str(cause.args[0]), "refer to a box_container that holds the fluid") from cause


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre of something whose bottom touches the surface."""
    inside = _inside(reference)
    half = (f"{subject.name}.half_z", subject.half("z"))
    if dof == "z" and "level" in params:
        return total("z", ("level", params["level"]), half)
    if dof == "z":
        floor = reference.low("z") + inside.height_m
        return total("z", (f"{reference.name}.inside.floor", floor), ("depth", params["depth"]), half)
    own = (inside.centre[0] + params["offset"][0], inside.centre[1] + params["offset"][1])
    turned = "" if reference.get("yaw") % 360 == 0 else f" turned by {shown(reference.get('yaw'))} deg"
    shift = reference.to_world(*own)["xy".index(dof)]
    return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)), (f"offset{turned}", shift))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the smaller of: tolerance minus the error of level and offset, and how far the centre is inside."""
    inside = _inside(reference)
    level = params["level"] if "level" in params else reference.low("z") + inside.height_m + params["depth"]
    x, y = reference.to_own(subject.get("x"), subject.get("y"))
    margins = [TOLERANCE_M - abs(subject.low("z") - level), inside.inset(x, y) + TOLERANCE_M]
    if "offset" in params:
        errors = (x - inside.centre[0] - params["offset"][0], y - inside.centre[1] - params["offset"][1])
        margins.append(TOLERANCE_M - max(map(abs, errors)))
    return min(margins)
