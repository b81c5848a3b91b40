"""The body rests on the reference's top face.

    z = reference.max_z + half_z
    (x, y) = reference.center + Rz(reference.yaw) offset        when `offset` is given

The top face is the upper face of the bounding box (for a seat or a bed use PLACE-ON with `surface`). `offset` [dx, dy]
runs along the reference's own axes, metres; omitted, other rows set x and y. The centre must lie over the face.
Source: paper, relation patterns, "On-top"; parameters are ours.
"""

from ..anchors import Box, Derivation
from ..parameters import Parameter
from ..vocabulary import Case
from . import _on_top

CODE = "placed_on_top"
FAMILY = "On-top templates"
REFERENCE = "required"
PARAMS = {"offset": Parameter("pair", "metres from the middle of the top face, along the reference's own x and y")}
UNIT = "m"
SUPPORTS = True
BLOCK = {"name": "block", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 0.2)}, BLOCK, {}, {"z": 0.9}),
    Case({"size": (0.4, 0.6, 0.2)}, {**BLOCK, "yaw": 90}, {"offset": (0.1, 0.2)}, {"x": 0.3, "y": 1.1, "z": 0.9}),
)
BAD = (
    Case({"size": (0.4, 0.6, 0.2), "x": 0.5, "y": 1.0, "z": 0.91, "yaw": 0}, BLOCK),
    Case({"size": (0.4, 0.6, 0.2), "x": 1.1, "y": 1.0, "z": 0.9, "yaw": 0}, BLOCK),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when `offset` is given."""
    plane = {a: (f"reference.{a}", "reference.yaw") for a in ("x", "y")} if "offset" in params else {}
    return {"z": ("reference.z",), **plane}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre of something that rests there."""
    return _on_top.place(dof, subject, reference, 0.0, params.get("offset", (0.0, 0.0)))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well it rests, metres."""
    return _on_top.holds(subject, reference, 0.0, params.get("offset"))
