"""The closed vocabulary: predicates and relation templates, one module each, and what such a module defines.

CODE        the name in the plan, e.g. `LEFT-OF`
FAMILY      its row in the paper's table
REFERENCE   `required`, `optional` (omitted means the base) or `none`
PARAMS      its parameters by name
UNIT        of its margin: `m` or `deg`
GOOD, BAD   cases: worked numbers that resolve to `gives` and hold; layouts that do not hold
pins        (params) -> the coordinates of the subject it sets, each with what it reads: `reference.x`, `self.extents` …
resolve     (dof, subject, reference, params) -> Derivation
holds       (subject, reference, params) -> signed margin; negative means violated
and optionally `refuse(params) -> (cause, fix) | None` for combinations that make no sense.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import FunctionType
from typing import Any

from ..shelf import Shelf
from .anchors import Box, Surface

BASE = "base"
"""The ground at the world's origin: a point without extents, facing +X, on an endless plane at z = 0."""

_SHAPE: dict[str, type | tuple[type, ...]] = {
    "FAMILY": str,
    "REFERENCE": str,
    "PARAMS": dict,
    "UNIT": str,
    "GOOD": tuple,
    "BAD": tuple,
    "pins": FunctionType,
    "resolve": FunctionType,
    "holds": FunctionType,
}
PREDICATES = Shelf("worldwright.place.predicates", _SHAPE)
RELATIONS = Shelf("worldwright.place.relations", _SHAPE)

CAMERA_TEMPLATES = (
    "side_minus_x",
    "side_plus_x",
    "side_minus_y",
    "side_plus_y",
    "top_down",
    "perspective",
    "inside_minus_x_wall",
    "inside_plus_x_wall",
    "inside_minus_y_wall",
    "inside_plus_y_wall",
    "camera_side_minus_y",
)
"""Relations that place a camera, not a body: the runtime resolves them when it frames the scene."""


@dataclass(frozen=True)
class Case:
    """A worked example of one predicate.

    subject, reference: arguments of `Box`; the subject of a GOOD case leaves out what the predicate sets.
    gives: coordinates the predicate sets, metres and degrees.
    """

    subject: Mapping[str, Any]
    reference: Mapping[str, Any] | None = None
    params: Mapping[str, Any] = field(default_factory=dict)
    gives: Mapping[str, float] = field(default_factory=dict)


def base() -> Box:
    """The base as a box."""
    endless = Surface("top", 0.0, (float("inf"), float("inf")))

    def surface(name: str | None) -> Surface:
        if name not in (None, "top"):
            raise KeyError(f"the base has no surface {name!r}; it has: top")
        return endless

    return Box(BASE, (0.0, 0.0, 0.0), x=0.0, y=0.0, z=0.0, yaw=0.0, round=True, surface=surface)
