"""The subject lies in front of the reference (+X): its near face is `gap` metres beyond the reference's.

    x = reference.max_x + gap + half_x

Faces are those of the world AABBs, so a yawed body counts with its rotated extents. Without `gap` the row sets
nothing and only demands that the two do not overlap along x. Source: paper, predicate algebra, 2-D spatial.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _outside

CODE = "FRONT-OF"
FAMILY = "Planar position"
REFERENCE = "required"
PARAMS = _outside.PARAMS
UNIT = "m"
TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 1), "yaw": 0}, TABLE, {"gap": 0.1}, {"x": 1.3}),
    Case({"size": (0.4, 0.6, 1), "yaw": -90}, TABLE, {"gap": 0.1}, {"x": 1.4}),
)
BAD = (
    Case({"size": (0.4, 0.6, 1), "yaw": 0, "x": 1.5}, TABLE, {"gap": 0.1}),
    Case({"size": (0.4, 0.6, 1), "yaw": 0, "x": 1.1}, TABLE),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the x coordinate, when `gap` is given."""
    return _outside.pins("x", params)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre beyond the reference's face."""
    return _outside.resolve("x", 1, subject, reference, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the gap is kept, metres."""
    return _outside.holds("x", 1, subject, reference, params)
