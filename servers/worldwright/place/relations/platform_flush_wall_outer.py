"""A platform stands flush against the outer face of a container's wall.

    wall plus_x:   x = reference.max_x + half_x        y = reference.center_y + offset
    wall minus_x:  x = reference.min_x - half_x        y = reference.center_y + offset
    wall plus_y:   y = reference.max_y + half_y        x = reference.center_x + offset
    wall minus_y:  y = reference.min_y - half_y        x = reference.center_x + offset
    top rim:       z = reference.max_z - half_z        top floor:  z = reference.min_z + inside.height - half_z

`wall` names the side. `offset` slides the platform along the wall, metres; omitted it is 0. `top` says what the platform's top
is level with: the container's rim or its inner floor; omitted, another row sets z (e.g. PLACE-ON-BASE).
Source: paper, relation patterns, "Adjacent-outside"; parameters are ours.
"""

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, Surface, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "platform_flush_wall_outer"
FAMILY = "Wall-adjacent platform"
REFERENCE = "required"
PARAMS = {
    "wall": Parameter(
        "name", "side of the container", choices=("plus_x", "minus_x", "plus_y", "minus_y"), required=True
    ),
    "offset": Parameter("number", "metres along the wall, from its middle; omitted: 0"),
    "top": Parameter("name", "what the platform's top is level with", choices=("rim", "floor")),
}
UNIT = "m"


def _tank(name: str | None) -> Surface:
    return Surface("inside", 0.1, (1.8, 0.8))


TANK = {"name": "tank", "size": (2.0, 1.0, 0.8), "x": 1.0, "y": 1.0, "z": 0.4, "yaw": 0, "surface": _tank}
GOOD = (
    Case(
        {"size": (1.0, 1.0, 0.8), "yaw": 0},
        TANK,
        {"wall": "minus_x", "top": "rim"},
        {"x": -0.5, "y": 1.0, "z": 0.4},
    ),
    Case(
        {"size": (1.0, 0.6, 0.1), "yaw": 0},
        TANK,
        {"wall": "plus_y", "offset": 0.5, "top": "floor"},
        {"x": 1.5, "y": 1.8, "z": 0.05},
    ),
)
BAD = (
    Case({"size": (1.0, 1.0, 0.8), "x": -0.45, "y": 1.0, "z": 0.4, "yaw": 0}, TANK, {"wall": "minus_x"}),
    Case({"size": (1.0, 1.0, 0.8), "x": -0.5, "y": 1.0, "z": 0.5, "yaw": 0}, TANK, {"wall": "minus_x", "top": "rim"}),
)


def _sides(params: dict) -> tuple[str, str, int]:
    sign, axis = params["wall"].split("_")
    return axis, "y" if axis == "x" else "x", 1 if sign == "plus" else -1


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the plane always; the height with `top`."""
    axis, across, _ = _sides(params)
    height = {"z": ("reference.z",)} if "top" in params else {}
    return {
        axis: (f"reference.{axis}", "reference.extents", "self.extents"),
        across: (f"reference.{across}",),
        **height,
    }


def _level(reference: Box, params: dict) -> tuple[str, float]:
    if params["top"] == "rim":
        return (f"{reference.name}.max_z", reference.high("z"))
    try:
        height = reference.surface("inside").height_m
    except KeyError as cause:
        raise CannotResolveError(str(cause.args[0]), "refer to a box_container, or use `top: rim`") from cause
    return (f"{reference.name}.inside.floor", reference.low("z") + height)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre beside the wall."""
    axis, _, sign = _sides(params)
    if dof == "z":
        return total("z", _level(reference, params), (f"-{subject.name}.half_z", subject.half("z")))
    if dof != axis:
        terms = [(f"{reference.name}.center_{dof}", reference.get(dof))]
        return total(dof, *terms, *([("offset", params["offset"])] if "offset" in params else []))
    if sign > 0:
        return total(
            dof, (f"{reference.name}.max_{dof}", reference.high(dof)), (f"{subject.name}.half_{dof}", subject.half(dof))
        )
    return total(
        dof, (f"{reference.name}.min_{dof}", reference.low(dof)), (f"-{subject.name}.half_{dof}", subject.half(dof))
    )


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the largest error of contact, offset and level."""
    axis, across, sign = _sides(params)
    touch = subject.low(axis) - reference.high(axis) if sign > 0 else reference.low(axis) - subject.high(axis)
    errors = [touch, subject.get(across) - reference.get(across) - params.get("offset", 0.0)]
    if "top" in params:
        errors.append(subject.high("z") - _level(reference, params)[1])
    return TOLERANCE_M - max(abs(error) for error in errors)
