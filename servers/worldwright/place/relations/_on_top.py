"""Shared arithmetic of the on-top templates: the body's lowest point on, or above, the reference's top face."""

from ..anchors import TOLERANCE_M, Box, Derivation, shown, total


def place(dof: str, subject: Box, reference: Box, gap: float, offset: tuple[float, float]) -> Derivation:
    """Compute the centre over the top face; `offset` runs along the reference's own axes, m."""
    if dof == "z":
        terms = [(f"{reference.name}.max_z", reference.high("z"))]
        if gap:
            terms.append(("gap", gap))
        return total("z", *terms, (f"{subject.name}.half_z", subject.half("z")))
    shift = reference.to_world(*offset)["xy".index(dof)]
    turned = "" if reference.get("yaw") % 360 == 0 else f" turned by {shown(reference.get('yaw'))} deg"
    terms = [(f"{reference.name}.center_{dof}", reference.get(dof))]
    return total(dof, *terms, *([(f"offset{turned}", shift)] if any(offset) else []))


def holds(subject: Box, reference: Box, gap: float, offset: tuple[float, float] | None) -> float:
    """Return the smaller of: tolerance minus the error of height and offset, and how far the centre is over the top face."""
    x, y = reference.to_own(subject.get("x"), subject.get("y"))
    margins = [TOLERANCE_M - abs(subject.low("z") - reference.high("z") - gap)]
    sx, sy, _ = reference.size
    if sx and sy:  # the base has no extents, and no edge
        margins.append(min(sx / 2 - abs(x), sy / 2 - abs(y)) + TOLERANCE_M)
    if offset is not None:
        margins.append(TOLERANCE_M - max(abs(x - offset[0]), abs(y - offset[1])))
    return min(margins)
