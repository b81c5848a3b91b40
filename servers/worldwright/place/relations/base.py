"""The body has no reference object: its absolute centre is given.

    x, y, z = position        yaw = deg_z (when given)

`position` is the world-frame centre of the body's bounding box in metres; `deg_z` its yaw in degrees. A container that is a
generated_boundary is given by its floor instead: z = position.z + half_z, its rim at position.z + size.z. Entries of
`topology.body_positions` mean the same. Source: paper, relation patterns, "Base".
"""

from ..anchors import TOLERANCE_M, Box, Derivation, shown, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "base"
FAMILY = "Base"
REFERENCE = "none"
PARAMS = {
    "position": Parameter("point", "world-frame centre, metres"),
    "deg_z": Parameter("number", "yaw, degrees counter-clockwise from +X"),
}
UNIT = "m"
GOOD = (
    Case({"size": (1, 1, 1)}, None, {"position": (1.0, 2.0, 3.0)}, {"x": 1.0, "y": 2.0, "z": 3.0}),
    Case({"size": (1, 1, 1)}, None, {"position": (0.0, 0.0, 0.5), "deg_z": 30.0}, {"z": 0.5, "yaw": 30.0}),
    Case(
        {"size": (4, 2, 1), "floor_datum": True}, None, {"position": (0.0, 0.0, -0.2)}, {"x": 0.0, "y": 0.0, "z": 0.3}
    ),
)
BAD = (Case({"size": (1, 1, 1), "x": 1, "y": 2, "z": 3.1, "yaw": 0}, None, {"position": (1.0, 2.0, 3.0)}),)


def refuse(params: dict) -> tuple[str, str] | None:
    """Refuse a base body without a position."""
    return None if "position" in params else ("it needs `position`", "add `position: [x, y, z]`, the centre in metres")


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets all three coordinates, and the yaw when it is given."""
    dofs = ("x", "y", "z", "yaw") if "deg_z" in params else ("x", "y", "z")
    return dict.fromkeys(dofs, ())


def resolve(dof: str, subject: Box, reference: Box | None, params: dict) -> Derivation:
    """Compute the coordinate as given."""
    value = params["deg_z"] if dof == "yaw" else params["position"]["xyz".index(dof)]
    if dof == "z" and subject.floor_datum:
        return total("z", ("floor (absolute)", value), (f"{subject.name}.half_z", subject.half("z")))
    return Derivation(value, f"{dof} = {shown(value)} (absolute)")


def holds(subject: Box, reference: Box | None, params: dict) -> float:
    """Return the tolerance minus the distance from the given centre."""
    x, y, z = params["position"]
    given = (x, y, z - subject.written_shift)
    return TOLERANCE_M - max(abs(subject.get(axis) - given[i]) for i, axis in enumerate("xyz"))
