"""Shared arithmetic of the four planar predicates: the subject lies outside one face of the reference."""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter

PARAMS = {"gap": Parameter("number", "metres between the two facing sides; omitted: any distance, no overlap", 0.0)}


def pins(axis: str, params: dict) -> dict[str, tuple[str, ...]]:
    """It sets one coordinate with a gap; without one, nothing: the row is then a condition on what other rows set."""
    if "gap" not in params:
        return {}
    return {axis: (f"reference.{axis}", "reference.extents", "self.extents")}


def resolve(axis: str, side: int, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre on the positive (`side` 1) or negative (-1) side of the reference."""
    half = (f"{subject.name}.half_{axis}", subject.half(axis))
    gap = ("gap", params["gap"])
    if side > 0:
        return total(axis, (f"{reference.name}.max_{axis}", reference.high(axis)), gap, half)
    face = (f"{reference.name}.min_{axis}", reference.low(axis))
    return total(axis, face, (f"-{gap[0]}", gap[1]), (f"-{half[0]}", half[1]))


def holds(axis: str, side: int, subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the error of the gap; without a gap, the free distance."""
    near, far = (reference.high(axis), subject.low(axis)) if side > 0 else (subject.high(axis), reference.low(axis))
    free = far - near
    return TOLERANCE_M - abs(free - params["gap"]) if "gap" in params else free + TOLERANCE_M
