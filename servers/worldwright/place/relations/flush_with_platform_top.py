"""The body's top is level with the platform's top.

    z = reference.max_z + offset - half_z

`offset` is in metres upwards; omitted it is 0, level. x, y and yaw are not set.
Source: paper, relation patterns, "Bridging"; parameters are ours.
"""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "flush_with_platform_top"
FAMILY = "Bridge and span templates"
REFERENCE = "required"
PARAMS = {"offset": Parameter("number", "metres by which the body's top is above the platform's; omitted: 0")}
UNIT = "m"
PLATFORM = {"name": "platform", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 0}
GOOD = (
    Case({"size": (2.0, 0.6, 0.1)}, PLATFORM, {}, {"z": 0.75}),
    Case({"size": (2.0, 0.6, 0.1)}, PLATFORM, {"offset": 0.02}, {"z": 0.77}),
)
BAD = (Case({"size": (2.0, 0.6, 0.1), "x": 0, "y": 0, "z": 0.85, "yaw": 0}, PLATFORM),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height."""
    return {"z": ("reference.z",)}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre below the level."""
    terms = [(f"{reference.name}.max_z", reference.high("z"))]
    if "offset" in params:
        terms.append(("offset", params["offset"]))
    return total("z", *terms, (f"-{subject.name}.half_z", subject.half("z")))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the distance between the two levels."""
    return TOLERANCE_M - abs(subject.high("z") - reference.high("z") - params.get("offset", 0.0))
