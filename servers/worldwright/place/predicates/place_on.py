"""The subject rests on a surface of the reference: its lowest point is on that surface's plane.

    z = reference.min_z + surface.height + gap + half_z
    (x, y) = reference.center + Rz(reference.yaw) (surface.center + offset)        when `offset` is given

`surface` names where on the reference, e.g. `bed` of a pool table or `seat` of a chair; omitted, it is the reference's
default surface (the catalog says which; `inside` for a box_container, the top face for other scene objects). `offset`
[dx, dy] moves the centre from the middle of the surface along the reference's *own* axes, so that a laid table can be
turned; omitted, other rows must set x and y. `gap` lifts the subject (it then falls); omitted, it rests in contact.
The centre must lie above the surface. Source: paper, predicate algebra, height and support (parameters are ours).
"""

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, Surface, shown, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "PLACE-ON"
FAMILY = "Height and support"
REFERENCE = "required"
PARAMS = {
    "surface": Parameter("name", "named surface of the reference; omitted: its default one"),
    "offset": Parameter("pair", "metres from the middle of the surface, along the reference's own x and y"),
    "gap": Parameter("number", "metres between the surface and the lowest point; omitted: 0, in contact", 0.0),
}
UNIT = "m"
SUPPORTS = True
DROP = "gap"
OTHERWISE = "across two supports: bridge_between_a_and_b, or HEIGHT"


def _tray(name: str | None) -> Surface:
    return Surface("top", 0.7, (1.0, 2.0))


TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0, "surface": _tray}
TURNED = {**TABLE, "yaw": 90}
GOOD = (
    Case({"size": (0.2, 0.2, 0.1)}, TABLE, {"offset": (0.1, 0.2)}, {"x": 0.6, "y": 1.2, "z": 0.75}),
    Case({"size": (0.2, 0.2, 0.1)}, TURNED, {"offset": (0.1, 0.2), "gap": 0.05}, {"x": 0.3, "y": 1.1, "z": 0.8}),
)
BAD = (
    Case({"size": (0.2, 0.2, 0.1), "x": 0.5, "y": 1.0, "z": 0.8, "yaw": 0}, TABLE),
    Case({"size": (0.2, 0.2, 0.1), "x": 1.1, "y": 1.0, "z": 0.75, "yaw": 0}, TABLE),
    Case({"size": (0.2, 0.2, 0.1), "x": 0.6, "y": 1.0, "z": 0.75, "yaw": 0}, TABLE, {"offset": (0.0, 0.0)}),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when `offset` is given."""
    if "offset" not in params:
        return {"z": ("reference.z",)}
    return {"z": ("reference.z",), "x": ("reference.x", "reference.yaw"), "y": ("reference.y", "reference.yaw")}


def _surface(reference: Box, params: dict) -> Surface:
    try:
        return reference.surface(params.get("surface"))
    except KeyError as cause:
        message = str(cause.args[0])
        raise CannotResolveError(message, "name one of its surfaces, or leave `surface` out for the default") from cause


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre of something that rests on the surface."""
    surface = _surface(reference, params)
    if dof == "z":
        terms = [(f"{reference.name}.{surface.name}", reference.low("z") + surface.height_m)]
        if "gap" in params:
            terms.append(("gap", params["gap"]))
        return total("z", *terms, (f"{subject.name}.half_z", subject.half("z")))
    own = (surface.centre[0] + params["offset"][0], surface.centre[1] + params["offset"][1])
    shift = reference.to_world(*own)["xy".index(dof)]
    turned = "" if reference.get("yaw") % 360 == 0 else f" turned by {shown(reference.get('yaw'))} deg"
    return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)), (f"offset{turned}", shift))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the smaller of: tolerance minus the error of the contact, and how far the centre is inside the surface."""
    surface = _surface(reference, params)
    plane = reference.low("z") + surface.height_m
    x, y = reference.to_own(subject.get("x"), subject.get("y"))
    margins = [TOLERANCE_M - abs(subject.low("z") - plane - params.get("gap", 0.0)), surface.inset(x, y) + TOLERANCE_M]
    if "offset" in params:
        errors = (x - surface.centre[0] - params["offset"][0], y - surface.centre[1] - params["offset"][1])
        margins.append(TOLERANCE_M - max(map(abs, errors)))
    return min(margins)
