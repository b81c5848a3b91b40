"""Shared arithmetic of the six alignments: one anchor of the subject meets the same anchor of the reference."""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter

PARAMS = {"offset": Parameter("number", "metres along the world axis, from the reference's anchor; omitted: 0, flush")}


def pins(axis: str, side: int) -> dict[str, tuple[str, ...]]:
    """It sets one coordinate; faces depend on extents, centres do not."""
    extents = ("reference.extents", "self.extents") if side else ()
    return {axis: (f"reference.{axis}", *extents)}


def resolve(axis: str, side: int, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre whose lower (-1) or upper (1) face, or middle (0), meets the reference's."""
    terms = [(f"{reference.name}.{_anchor(axis, side)}", _anchor_value(reference, axis, side))]
    if "offset" in params:
        terms.append(("offset", params["offset"]))
    if side:
        terms.append((f"{'-' if side > 0 else ''}{subject.name}.half_{axis}", subject.half(axis)))
    return total(axis, *terms)


def holds(axis: str, side: int, subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the distance between the two anchors."""
    error = _anchor_value(subject, axis, side) - _anchor_value(reference, axis, side) - params.get("offset", 0.0)
    return TOLERANCE_M - abs(error)


def _anchor(axis: str, side: int) -> str:
    return f"{'min' if side < 0 else 'max'}_{axis}" if side else f"center_{axis}"


def _anchor_value(box: Box, axis: str, side: int) -> float:
    if not side:
        return box.get(axis)
    return box.high(axis) if side > 0 else box.low(axis)
