"""The subject's front points to the world's right (-Y).

    deg_z = -90 + turn_deg

Source: paper, predicate algebra, rotation-only.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _facing

CODE = "FACING-RIGHT"
FAMILY = "Orientation"
REFERENCE = "none"
PARAMS = _facing.PARAMS
UNIT = "deg"
HEADING = -90.0
GOOD = (
    Case({"size": (1, 1, 1)}, None, {}, {"yaw": -90.0}),
    Case({"size": (1, 1, 1)}, None, {"turn_deg": -30.0}, {"yaw": -120.0}),
)
BAD = (Case({"size": (1, 1, 1), "yaw": -85.0}),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw."""
    return {"yaw": ()}


def resolve(dof: str, subject: Box, reference: Box | None, params: dict) -> Derivation:
    """Compute the fixed heading, turned."""
    return _facing.derivation("heading of -Y", HEADING, params)


def holds(subject: Box, reference: Box | None, params: dict) -> float:
    """Measure how well the subject keeps the heading, degrees."""
    return _facing.holds(HEADING, subject, params)
