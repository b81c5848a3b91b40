"""The body is flush against the reference's minus y face (-Y, right) and their centres are at one height.

    y = reference.min_y - gap - half_y        x = reference.center_x + offset        z = reference.center_z

Faces are those of the world AABBs, so a yawed body counts with its rotated extents. `gap` keeps the sides apart and
`offset` slides the body along the face, both in metres; omitted they are 0. Yaw is not set.
Source: paper, relation patterns, "Adjacent-outside"; parameters are ours.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _adjacent

CODE = "adjacent_minus_y_centers"
FAMILY = "Adjacent centers"
REFERENCE = "required"
PARAMS = _adjacent.PARAMS
UNIT = "m"
BLOCK = {"name": "block", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 0.2), "yaw": 0}, BLOCK, {}, {"x": 0.5, "y": -0.3, "z": 0.4}),
    Case({"size": (0.4, 0.6, 0.2), "yaw": 90}, BLOCK, {"gap": 0.1, "offset": -0.3}, {"x": 0.2, "y": -0.3, "z": 0.4}),
)
BAD = (
    Case({"size": (0.4, 0.6, 0.2), "yaw": 0, "x": 0.5, "y": -0.35, "z": 0.4}, BLOCK),
    Case({"size": (0.4, 0.6, 0.2), "yaw": 0, "x": 0.5, "y": -0.3, "z": 0.41}, BLOCK),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """All three coordinates."""
    return _adjacent.pins("y")


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """The centre beside the face."""
    return _adjacent.resolve("y", -1, 0, dof, subject, reference, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """How well the two meet, metres."""
    return _adjacent.holds("y", -1, 0, subject, reference, params)
