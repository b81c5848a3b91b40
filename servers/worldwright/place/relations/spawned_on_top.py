"""The body starts a little above the reference's top face and lands on it when the world runs.

    z = reference.max_z + gap + half_z
    (x, y) = reference.center + Rz(reference.yaw) offset        when `offset` is given

`gap` is the metres of free fall, above 0 where landing is to be seen. `offset` [dx, dy] runs along the reference's own axes,
metres; omitted, other rows set x and y. The centre must lie over the face.
Source: paper, relation patterns, "On-top"; parameters are ours.
"""

from ..anchors import Box, Derivation
from ..parameters import Parameter
from ..vocabulary import Case
from . import _on_top

CODE = "spawned_on_top"
FAMILY = "On-top templates"
REFERENCE = "required"
PARAMS = {
    "gap": Parameter("number", "metres between the top face and the lowest point", 0.0, required=True),
    "offset": Parameter("pair", "metres from the middle of the top face, along the reference's own x and y"),
}
UNIT = "m"
SUPPORTS = True
DROP = "gap"
BLOCK = {"name": "block", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 0.2)}, BLOCK, {"gap": 0.05}, {"z": 0.95}),
    Case(
        {"size": (0.4, 0.6, 0.2)},
        {**BLOCK, "yaw": -90},
        {"gap": 0.1, "offset": (0.1, 0.2)},
        {"x": 0.7, "y": 0.9, "z": 1.0},
    ),
)
BAD = (Case({"size": (0.4, 0.6, 0.2), "x": 0.5, "y": 1.0, "z": 0.9, "yaw": 0}, BLOCK, {"gap": 0.05}),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when `offset` is given."""
    plane = {a: (f"reference.{a}", "reference.yaw") for a in ("x", "y")} if "offset" in params else {}
    return {"z": ("reference.z",), **plane}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre of something that is let go there."""
    return _on_top.place(dof, subject, reference, params["gap"], params.get("offset", (0.0, 0.0)))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well gap and place are kept, metres."""
    return _on_top.holds(subject, reference, params["gap"], params.get("offset"))
