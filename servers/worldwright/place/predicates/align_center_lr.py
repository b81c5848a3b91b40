"""Subject and reference have the same centre on the left-right (Y) axis.

    y = reference.center_y + offset

`offset` is in metres along world +Y and moves the subject away from being flush; omitted it is 0. Faces are those
of the world AABBs (rotated extents). Source: paper, predicate algebra, 2-D alignment.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _aligned

CODE = "ALIGN-CENTER-LR"
FAMILY = "Planar alignment"
REFERENCE = "required"
PARAMS = _aligned.PARAMS
UNIT = "m"
TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 1)}, TABLE, {}, {"y": 1.0}),
    Case({"size": (0.4, 0.6, 1)}, TABLE, {"offset": -0.25}, {"y": 0.75}),
)
BAD = (Case({"size": (0.4, 0.6, 1), "yaw": 0, "y": 1.1}, TABLE),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the y coordinate."""
    return _aligned.pins("y", 0)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the aligned centre."""
    return _aligned.resolve("y", 0, subject, reference, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the anchors meet, metres."""
    return _aligned.holds("y", 0, subject, reference, params)
