"""Shared arithmetic of the orientation predicates: a heading, and an extra turn."""

from ..anchors import TOLERANCE_DEG, Box, Derivation, shown, wrap
from ..parameters import Parameter

PARAMS = {"turn_deg": Parameter("number", "extra yaw on top, degrees counter-clockwise; omitted: 0")}


def derivation(symbol: str, heading: float, params: dict) -> Derivation:
    """The heading plus the turn."""
    turn = params.get("turn_deg", 0.0)
    value = wrap(heading + turn)
    formula = f"deg_z = {symbol}" + (f" + turn_deg = {shown(heading)} + {shown(turn)}" if turn else "")
    return Derivation(value, f"{formula} = {shown(value)}")


def holds(heading: float, subject: Box, params: dict) -> float:
    """Return the tolerance minus the angle between the subject's front and the heading, degrees."""
    return TOLERANCE_DEG - abs(wrap(subject.get("yaw") - heading - params.get("turn_deg", 0.0)))
