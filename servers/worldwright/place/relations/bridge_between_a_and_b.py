"""The body spans the space between two references: `body_b` and `other`.

    along the axis on which their world boxes are apart:  c = (near face of the one + near face of the other) / 2
    across it:                                            c = (reference.center + other.center) / 2
    level on_top:  z = (the tops of both) + half_z        level flush:  z = (the tops of both) - half_z
    long_axis:     deg_z so that the body's own x (or y) runs along the span: 0 or 90

`level` says whether the body rests on both tops, reaching at least `overlap` metres over each (omitted: it must reach
them), or fits between them with its top level with theirs; their tops must then be at one height. Omitted, z is set
elsewhere (e.g. by `flush_with_platform_top`) and the body's centre must lie between the two. `long_axis` (x or y) turns
it; omitted, the yaw is not set. Source: paper, relation patterns, "Bridging"; parameters are ours.
"""

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "bridge_between_a_and_b"
FAMILY = "Bridge and span templates"
REFERENCE = "required"
PARAMS = {
    "other": Parameter("object", "the second reference", required=True),
    "level": Parameter("name", "on_top of both, or flush with their tops", choices=("on_top", "flush")),
    "overlap": Parameter("number", "metres by which it reaches over each support, on_top; omitted: 0", 0.0),
    "long_axis": Parameter("name", "the body's own axis that spans", choices=("x", "y")),
}
UNIT = "m"
SUPPORTS = True
WEST = {"name": "west", "size": (1.0, 1.0, 0.8), "x": -1.5, "y": 0.0, "z": 0.4, "yaw": 0}
EAST = {"name": "east", "size": (0.6, 1.0, 0.8), "x": 1.3, "y": 0.2, "z": 0.4, "yaw": 0}
NORTH = {"name": "north", "size": (1.0, 1.0, 0.8), "x": -1.5, "y": 3.0, "z": 0.4, "yaw": 0}
GOOD = (
    Case(
        {"size": (2.4, 0.5, 0.1)},
        WEST,
        {"other": EAST, "level": "on_top", "overlap": 0.1, "long_axis": "x"},
        {"x": 0.0, "y": 0.1, "z": 0.85, "yaw": 0.0},
    ),
    Case(
        {"size": (2.0, 0.5, 0.1)},
        WEST,
        {"other": NORTH, "level": "flush", "long_axis": "x"},
        {"x": -1.5, "y": 1.5, "z": 0.75, "yaw": 90.0},
    ),
)
BAD = (
    Case(
        {"size": (2.1, 0.5, 0.1), "x": 0.0, "y": 0.1, "z": 0.85, "yaw": 0},
        WEST,
        {"other": EAST, "level": "on_top", "overlap": 0.1},
    ),
    Case({"size": (2.4, 0.5, 0.1), "x": -1.6, "y": 0.1, "z": 0.85, "yaw": 0}, WEST, {"other": EAST}),
)


def refuse(params: dict) -> tuple[str, str] | None:
    """Refuse `overlap` unless the body lies on top."""
    if "overlap" in params and params.get("level") != "on_top":
        return ("`overlap` speaks of what lies on top", "add `level: on_top`, or remove `overlap`")
    return None


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the plane always; height with `level`, yaw with `long_axis`."""
    both = ("reference.x", "reference.y", "other.x", "other.y", "reference.extents", "other.extents")
    found: dict[str, tuple[str, ...]] = {"x": both, "y": both}
    if "level" in params:
        found["z"] = ("reference.z", "other.z")
    if "long_axis" in params:
        found["yaw"] = both
    return found


def _axis(reference: Box, other: Box) -> tuple[str, Box, Box]:
    """The axis of the span, and the two references in its order."""
    free = {a: max(other.low(a) - reference.high(a), reference.low(a) - other.high(a)) for a in ("x", "y")}
    axis = "x" if free["x"] >= free["y"] else "y"
    if free[axis] <= 0:
        raise CannotResolveError(
            f"{reference.name} and {other.name} are not apart, so there is nothing to span", "move them apart"
        )
    first, second = (reference, other) if reference.get(axis) < other.get(axis) else (other, reference)
    return axis, first, second


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the middle of the span."""
    other: Box = params["other"]
    axis, first, second = _axis(reference, other)
    if dof == "yaw":
        value = 0.0 if axis == params["long_axis"] else 90.0 if axis == "y" else -90.0
        return Derivation(value, f"deg_z = own {params['long_axis']} along the span (world {axis}) = {value:g}")
    if dof == "z":
        if abs(reference.high("z") - other.high("z")) > TOLERANCE_M:
            raise CannotResolveError(
                f"the tops of {reference.name} and {other.name} are {abs(reference.high('z') - other.high('z')):.4g} m "
                "apart in height",
                "make them equally high, or leave out `level` and set z by another row",
            )
        half = subject.half("z")
        sign = "" if params["level"] == "on_top" else "-"
        return total("z", (f"{reference.name}.max_z", reference.high("z")), (f"{sign}{subject.name}.half_z", half))
    if dof == axis:
        low, high = first.high(axis), second.low(axis)
        names = f"({first.name}.max_{axis} + {second.name}.min_{axis}) / 2"
    else:
        low, high = first.get(dof), second.get(dof)
        names = f"({first.name}.center_{dof} + {second.name}.center_{dof}) / 2"
    return total(dof, (names, (low + high) / 2))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how far it reaches over both, how closely it fits, or how far inside the span its centre is; metres."""
    axis, first, second = _axis(reference, params["other"])
    reach = (first.high(axis) - subject.low(axis), subject.high(axis) - second.low(axis))
    level = params.get("level")
    if level is None:
        return TOLERANCE_M + min(subject.get(axis) - first.high(axis), second.low(axis) - subject.get(axis))
    top = reference.high("z")
    if level == "flush":
        return TOLERANCE_M - max(*(abs(r) for r in reach), abs(subject.high("z") - top))
    return TOLERANCE_M + min(*(r - params.get("overlap", 0.0) for r in reach), -abs(subject.low("z") - top))
