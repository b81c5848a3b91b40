"""The front (+X) faces of subject and reference are flush.

    x = reference.max_x + offset - half_x

`offset` is in metres along world +X and moves the subject away from being flush; omitted it is 0. Faces are those
of the world AABBs (rotated extents). Source: paper, predicate algebra, 2-D alignment.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _aligned

CODE = "ALIGN-FRONT"
FAMILY = "Planar alignment"
REFERENCE = "required"
PARAMS = _aligned.PARAMS
UNIT = "m"
TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 1), "yaw": 0}, TABLE, {}, {"x": 0.8}),
    Case({"size": (0.4, 0.6, 1), "yaw": 90}, TABLE, {"offset": 0.1}, {"x": 0.8}),
)
BAD = (Case({"size": (0.4, 0.6, 1), "yaw": 0, "x": 0.5}, TABLE),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the x coordinate."""
    return _aligned.pins("x", 1)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the aligned centre."""
    return _aligned.resolve("x", 1, subject, reference, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the anchors meet, metres."""
    return _aligned.holds("x", 1, subject, reference, params)
