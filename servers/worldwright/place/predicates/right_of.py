"""The subject lies to the right of the reference (-Y): its near face is `gap` metres beyond the reference's.

    y = reference.min_y - gap - half_y

Faces are those of the world AABBs, so a yawed body counts with its rotated extents. Without `gap` the row sets
nothing and only demands that the two do not overlap along y. Source: paper, predicate algebra, 2-D spatial.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _outside

CODE = "RIGHT-OF"
FAMILY = "Planar position"
REFERENCE = "required"
PARAMS = _outside.PARAMS
UNIT = "m"
TABLE = {"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}
GOOD = (
    Case({"size": (0.4, 0.6, 1), "yaw": 0}, TABLE, {"gap": 0.1}, {"y": -0.4}),
    Case({"size": (0.4, 0.6, 1), "yaw": 90}, TABLE, {"gap": 0.1}, {"y": -0.3}),
)
BAD = (
    Case({"size": (0.4, 0.6, 1), "yaw": 0, "y": -0.5}, TABLE, {"gap": 0.1}),
    Case({"size": (0.4, 0.6, 1), "yaw": 0, "y": -0.2}, TABLE),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the y coordinate, when `gap` is given."""
    return _outside.pins("y", params)


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre beyond the reference's face."""
    return _outside.resolve("y", -1, subject, reference, params)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well the gap is kept, metres."""
    return _outside.holds("y", -1, subject, reference, params)
