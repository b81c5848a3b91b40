"""The subject's front (+X) points at the centre of the reference.

    deg_z = atan2(reference.center_y - center_y, reference.center_x - center_x) + turn_deg

Only yaw is set. When the subject's own position depends on its yaw (rotated extents), both are solved together.
Source: paper, predicate algebra, rotation-only.
"""

import math

from ..anchors import Box, CannotResolveError, Derivation
from ..vocabulary import Case
from . import _facing

CODE = "FACING-TO"
FAMILY = "Orientation"
REFERENCE = "required"
PARAMS = _facing.PARAMS
UNIT = "deg"
TABLE = {"name": "table", "size": (1, 1, 1), "x": 1.0, "y": 1.0, "z": 0.5, "yaw": 0}
GOOD = (
    Case({"size": (1, 1, 1), "x": 0.0, "y": 0.0}, TABLE, {}, {"yaw": 45.0}),
    Case({"size": (1, 1, 1), "x": 1.0, "y": 3.0}, TABLE, {"turn_deg": 10.0}, {"yaw": -80.0}),
)
BAD = (Case({"size": (1, 1, 1), "x": 0.0, "y": 0.0, "yaw": 0.0}, TABLE),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw, from both centres."""
    return {"yaw": ("self.x", "self.y", "reference.x", "reference.y")}


def heading(subject: Box, reference: Box) -> float:
    """Direction from the subject's centre to the reference's, degrees."""
    dx, dy = reference.get("x") - subject.get("x"), reference.get("y") - subject.get("y")
    if math.hypot(dx, dy) < 1e-9:
        raise CannotResolveError(
            f"{subject.name} and {reference.name} have the same centre in the plane, so there is no direction to face",
            "move one of them, or turn the subject by FACING-FRONT with turn_deg",
        )
    return math.degrees(math.atan2(dy, dx))


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the yaw that looks at the reference."""
    return _facing.derivation(f"heading to {reference.name}", heading(subject, reference), params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the subject looks at the reference, degrees."""
    return _facing.holds(heading(subject, reference), subject, params)
