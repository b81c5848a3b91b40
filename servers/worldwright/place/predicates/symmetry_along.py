"""The subject's centre is the mirror image of another object's centre, the mirror standing in the reference's centre.

    axis LR:    x = of.x                        y = 2 reference.center_y - of.y
    axis FB:    x = 2 reference.center_x - of.x        y = of.y
    axis both:  x = 2 reference.center_x - of.x        y = 2 reference.center_y - of.y

`of` is the object that is mirrored, `axis` the direction that changes sign: LR (left and right, y), FB (front and back,
x) or both (a half turn about the reference). Height and yaw are not set. Mirroring twice gives the original back.
Source: paper, predicate algebra, 2-D symmetry (the excerpt is silent on parameters; these are ours).
"""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "SYMMETRY-ALONG"
FAMILY = "Symmetry"
REFERENCE = "required"
PARAMS = {
    "of": Parameter("object", "the object whose centre is mirrored", required=True),
    "axis": Parameter(
        "name", "LR mirrors y, FB mirrors x, both mirrors both", choices=("LR", "FB", "both"), required=True
    ),
}
UNIT = "m"
TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}
CHAIR = {"name": "chair", "size": (0.5, 0.5, 0.9), "x": 0.7, "y": -0.4, "z": 0.45, "yaw": 90}
GOOD = (
    Case({"size": (0.5, 0.5, 0.9)}, TABLE, {"of": CHAIR, "axis": "LR"}, {"x": 0.7, "y": 2.4}),
    Case({"size": (0.5, 0.5, 0.9)}, TABLE, {"of": CHAIR, "axis": "FB"}, {"x": 0.3, "y": -0.4}),
    Case({"size": (0.5, 0.5, 0.9)}, TABLE, {"of": CHAIR, "axis": "both"}, {"x": 0.3, "y": 2.4}),
)
BAD = (Case({"size": (0.5, 0.5, 0.9), "x": 0.7, "y": 2.3}, TABLE, {"of": CHAIR, "axis": "LR"}),)
_MIRRORED = {"LR": "y", "FB": "x", "both": "xy"}


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets both coordinates of the plane."""
    mirrored = _MIRRORED[params["axis"]]
    return {a: (f"of.{a}", f"reference.{a}") if a in mirrored else (f"of.{a}",) for a in ("x", "y")}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the mirrored centre."""
    of: Box = params["of"]
    if dof not in _MIRRORED[params["axis"]]:
        return total(dof, (f"{of.name}.center_{dof}", of.get(dof)))
    twice = (f"2 {reference.name}.center_{dof}", 2 * reference.get(dof))
    return total(dof, twice, (f"-{of.name}.center_{dof}", of.get(dof)))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the distance from the mirror image."""
    of: Box = params["of"]
    errors = [
        subject.get(a) + of.get(a) - 2 * reference.get(a)
        if a in _MIRRORED[params["axis"]]
        else subject.get(a) - of.get(a)
        for a in ("x", "y")
    ]
    return TOLERANCE_M - max(map(abs, errors))
