"""The subject's front points where the reference's front points.

    deg_z = reference.deg_z + turn_deg

Source: paper, predicate algebra, rotation-only.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _facing

CODE = "FACING-SAME-AS"
FAMILY = "Orientation"
REFERENCE = "required"
PARAMS = _facing.PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (1, 1, 1), "x": 0, "y": 0, "z": 0.5, "yaw": 30}
GOOD = (
    Case({"size": (1, 1, 1)}, SOFA, {}, {"yaw": 30.0}),
    Case({"size": (1, 1, 1)}, SOFA, {"turn_deg": -90.0}, {"yaw": -60.0}),
)
BAD = (Case({"size": (1, 1, 1), "yaw": 31.0}, SOFA),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw, from the reference's."""
    return {"yaw": ("reference.yaw",)}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the reference's heading, turned."""
    return _facing.derivation(f"{reference.name}.deg_z", reference.get("yaw"), params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the two fronts agree, degrees."""
    return _facing.holds(reference.get("yaw"), subject, params)
