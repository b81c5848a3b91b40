"""The subject's front points the other way than the reference's front.

    deg_z = reference.deg_z + 180 + turn_deg

Source: paper, predicate algebra, rotation-only.
"""

from ..anchors import Box, Derivation, wrap
from ..vocabulary import Case
from . import _facing

CODE = "FACING-OPPOSITE-TO"
FAMILY = "Orientation"
REFERENCE = "required"
PARAMS = _facing.PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (1, 1, 1), "x": 0, "y": 0, "z": 0.5, "yaw": 30}
GOOD = (
    Case({"size": (1, 1, 1)}, SOFA, {}, {"yaw": -150.0}),
    Case({"size": (1, 1, 1)}, SOFA, {"turn_deg": -90.0}, {"yaw": 120.0}),
)
BAD = (Case({"size": (1, 1, 1), "yaw": 30.0}, SOFA),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw, from the reference's."""
    return {"yaw": ("reference.yaw",)}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the heading opposite to the reference's, turned."""
    return _facing.derivation(f"{reference.name}.deg_z + 180", wrap(reference.get("yaw") + 180), params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the two fronts are opposed, degrees."""
    return _facing.holds(reference.get("yaw") + 180, subject, params)
