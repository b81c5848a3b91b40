"""The subject stands on the ground: its lowest point is on the plane z = 0.

    z = half_z + gap        x = params.x        y = params.y

`x` and `y` give the centre in the world frame, metres; each one left out must be set by another row. `gap` lifts the
subject above the ground (it then falls); omitted, it stands in contact. Source: paper, predicate algebra, height and
support (the excerpt is silent on parameters; these are ours).
"""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "PLACE-ON-BASE"
FAMILY = "Height and support"
REFERENCE = "none"
PARAMS = {
    "x": Parameter("number", "world x of the centre, metres"),
    "y": Parameter("number", "world y of the centre, metres"),
    "gap": Parameter("number", "metres between the ground and the lowest point; omitted: 0, in contact", 0.0),
}
UNIT = "m"
SUPPORTS = True
DROP = "gap"
GOOD = (
    Case({"size": (1, 1, 0.8)}, None, {"x": 1.5, "y": -2.0}, {"x": 1.5, "y": -2.0, "z": 0.4}),
    Case({"size": (1, 1, 0.8)}, None, {"gap": 0.1}, {"z": 0.5}),
)
BAD = (
    Case({"size": (1, 1, 0.8), "x": 0, "y": 0, "z": 0.45, "yaw": 0}),
    Case({"size": (1, 1, 0.8), "x": 0.2, "y": 0, "z": 0.4, "yaw": 0}, None, {"x": 0.0}),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when they are given."""
    return {"z": (), **{axis: () for axis in ("x", "y") if axis in params}}


def resolve(dof: str, subject: Box, reference: Box | None, params: dict) -> Derivation:
    """Compute the centre of something that stands on z = 0."""
    if dof != "z":
        return total(dof, (f"params.{dof}", params[dof]))
    terms = [("ground", 0.0), (f"{subject.name}.half_z", subject.half("z"))]
    if "gap" in params:
        terms.insert(1, ("gap", params["gap"]))
    return total("z", *terms)


def holds(subject: Box, reference: Box | None, params: dict) -> float:
    """Return the tolerance minus the largest error of height, x and y."""
    errors = [subject.low("z") - params.get("gap", 0.0)]
    errors += [subject.get(axis) - params[axis] for axis in ("x", "y") if axis in params]
    return TOLERANCE_M - max(abs(error) for error in errors)
