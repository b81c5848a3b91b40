"""Shared arithmetic of the twelve adjacent templates: the body's side meets one side face of the reference."""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter

PARAMS = {
    "gap": Parameter("number", "metres between the two facing sides; omitted: 0, flush", 0.0),
    "offset": Parameter("number", "metres along the face, from the reference's centre; omitted: 0, centred"),
}
_ACROSS = {"x": "y", "y": "x"}
_ANCHORS = {-1: "min_z", 0: "center_z", 1: "max_z"}


def pins(axis: str) -> dict[str, tuple[str, ...]]:
    """All three coordinates."""
    across = _ACROSS[axis]
    return {
        axis: (f"reference.{axis}", "reference.extents", "self.extents"),
        across: (f"reference.{across}",),
        "z": ("reference.z",),
    }


def resolve(axis: str, side: int, level: int, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """The centre beside the face on the positive (`side` 1) or negative (-1) side, flush at `level` (-1, 0, 1)."""
    half = subject.half(dof) if dof in (axis, "z") else 0.0
    if dof == axis:
        gap = params.get("gap", 0.0)
        if side > 0:
            terms = [(f"{reference.name}.max_{axis}", reference.high(axis)), ("gap", gap)]
            return total(axis, *terms, (f"{subject.name}.half_{axis}", half))
        terms = [(f"{reference.name}.min_{axis}", reference.low(axis)), ("-gap", gap)]
        return total(axis, *terms, (f"-{subject.name}.half_{axis}", half))
    if dof == "z":
        terms = [(f"{reference.name}.{_ANCHORS[level]}", _level(reference, level))]
        if level:
            terms.append((f"{'-' if level > 0 else ''}{subject.name}.half_z", half))
        return total("z", *terms)
    terms = [(f"{reference.name}.center_{dof}", reference.get(dof))]
    return total(dof, *terms, *([("offset", params["offset"])] if "offset" in params else []))


def holds(axis: str, side: int, level: int, subject: Box, reference: Box, params: dict) -> float:
    """Tolerance minus the largest error of gap, offset and level."""
    across = _ACROSS[axis]
    near = subject.low(axis) - reference.high(axis) if side > 0 else reference.low(axis) - subject.high(axis)
    errors = (
        near - params.get("gap", 0.0),
        subject.get(across) - reference.get(across) - params.get("offset", 0.0),
        _level(subject, level) - _level(reference, level),
    )
    return TOLERANCE_M - max(abs(error) for error in errors)


def _level(box: Box, level: int) -> float:
    if not level:
        return box.get("z")
    return box.high("z") if level > 0 else box.low("z")
