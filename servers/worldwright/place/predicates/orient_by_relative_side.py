"""The subject squarely faces the side of the reference that it is at, as chairs do around a table.

    (u, v) = Rz(-reference.yaw) (center - reference.center) / (half own extents of the reference)
    |u| > |v|:  heading = 180 when u > 0 (at its front), else 0 (at its back)
    |v| > |u|:  heading = -90 when v > 0 (at its left), else 90 (at its right)
    deg_z = reference.deg_z + heading + turn_deg

Unlike FACING-TO, all chairs along one side look the same way. `turn_deg` 180 turns the back to it. A reference without extents
counts as square. Exactly on a diagonal there is no such side.
Source: paper, predicate algebra, rotation-only (the excerpt is silent on the rule; this is ours).
"""

from ..anchors import Box, CannotResolveError, Derivation, wrap
from ..vocabulary import Case
from . import _facing

CODE = "ORIENT-BY-RELATIVE-SIDE"
FAMILY = "Orientation"
REFERENCE = "required"
PARAMS = _facing.PARAMS
UNIT = "deg"
TABLE = {"name": "table", "size": (1.0, 3.0, 0.7), "x": 0.0, "y": 0.0, "z": 0.35, "yaw": 0}
GOOD = (
    Case({"size": (1, 1, 1), "x": 0.9, "y": 1.2}, TABLE, {}, {"yaw": 180.0}),
    Case({"size": (1, 1, 1), "x": 0.2, "y": -1.9}, TABLE, {"turn_deg": 5.0}, {"yaw": 95.0}),
    Case({"size": (1, 1, 1), "x": 0.2, "y": -1.9}, {**TABLE, "yaw": 90}, {}, {"yaw": 90.0}),
)
BAD = (Case({"size": (1, 1, 1), "x": 0.9, "y": 1.2, "yaw": -127.0}, TABLE),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw, from both centres and the reference's yaw."""
    return {"yaw": ("self.x", "self.y", "reference.x", "reference.y", "reference.yaw")}


def heading(subject: Box, reference: Box) -> tuple[str, float]:
    """The side, and the yaw that looks at it."""
    u, v = reference.to_own(subject.get("x"), subject.get("y"))
    sx, sy, _ = reference.size
    if sx and sy:
        u, v = 2 * u / sx, 2 * v / sy
    if abs(abs(u) - abs(v)) < 1e-9:
        raise CannotResolveError(
            f"{subject.name} is on a diagonal of {reference.name}, at no side of it",
            "move it towards one side, or use FACING-TO",
        )
    if abs(u) > abs(v):
        side, turn = ("front", 180.0) if u > 0 else ("back", 0.0)
    else:
        side, turn = ("left", -90.0) if v > 0 else ("right", 90.0)
    return side, wrap(reference.get("yaw") + turn)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the yaw that looks at that side."""
    side, value = heading(subject, reference)
    return _facing.derivation(f"facing the {side} side of {reference.name}", value, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how squarely the subject looks at its side, degrees."""
    return _facing.holds(heading(subject, reference)[1], subject, params)
