"""How high the subject is, or how tall: a declared level, or a declared vertical extent.

    z = level + bottom + half_z   |   level + center   |   level + top - half_z
    level = 0 for the base (or no reference), else reference.max_z

`bottom`, `center` and `top` are metres above that level, or the name of a layer of `topology.reference_heights`; give
at most one. `extent` declares the vertical extent instead of setting anything: it must equal the size that
`scene_objects[].size` or `asset_dimensions` owns. Something free that is held by nothing falls from there.
Source: paper, predicate algebra, height and support (the excerpt is silent on parameters; these are ours).
"""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "HEIGHT"
FAMILY = "Height and support"
REFERENCE = "optional"
PARAMS = {
    "bottom": Parameter("height", "metres of the lowest point above the ground, or above the reference's top"),
    "center": Parameter("height", "metres of the centre above the ground, or above the reference's top"),
    "top": Parameter("height", "metres of the highest point above the ground, or above the reference's top"),
    "extent": Parameter("number", "the vertical extent that the subject must have, metres", 0.0),
}
UNIT = "m"
DROP = "bottom"
SHELF = {"name": "shelf", "size": (1, 1, 0.2), "x": 0, "y": 0, "z": 1.0, "yaw": 0}
GOOD = (
    Case({"size": (0.2, 0.2, 0.3)}, None, {"bottom": 1.8}, {"z": 1.95}),
    Case({"size": (0.2, 0.2, 0.3)}, None, {"center": 1.8}, {"z": 1.8}),
    Case({"size": (0.2, 0.2, 0.3)}, SHELF, {"top": 0.5}, {"z": 1.45}),
    Case({"size": (0.2, 0.2, 0.3), "z": 0.0}, None, {"extent": 0.3}),
)
BAD = (
    Case({"size": (0.2, 0.2, 0.3), "z": 1.8}, None, {"bottom": 1.8}),
    Case({"size": (0.2, 0.2, 0.3), "z": 1.8}, None, {"extent": 0.4}),
)
_LEVELS = ("bottom", "center", "top")


def refuse(params: dict) -> tuple[str, str] | None:
    """Refuse more than one level, and a row without any level or extent."""
    given = [name for name in _LEVELS if name in params]
    if len(given) > 1:
        return (f"it gives both {' and '.join(given)}", "keep one of them: each sets z")
    if not given and "extent" not in params:
        return ("it says neither how high nor how tall", "add `bottom`, `center` or `top` (metres), or `extent`")
    return None


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height, when a level is given."""
    return {"z": ("reference.z",)} if any(name in params for name in _LEVELS) else {}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre's height."""
    name = next(level for level in _LEVELS if level in params)
    level = ("ground", 0.0) if reference.size[2] == 0 else (f"{reference.name}.max_z", reference.high("z"))
    half = (f"{subject.name}.half_z", subject.half("z"))
    shift = {"bottom": [half], "center": [], "top": [(f"-{half[0]}", half[1])]}[name]
    return total("z", level, (name, params[name]), *shift)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the largest error of level and extent."""
    errors = [subject.size[2] - params["extent"]] if "extent" in params else []
    for name, anchor in (("bottom", subject.low), ("center", subject.get), ("top", subject.high)):
        if name in params:
            errors.append(anchor("z") - reference.high("z") - params[name])
    return TOLERANCE_M - max(abs(error) for error in errors)
