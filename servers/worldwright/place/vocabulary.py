"""The closed vocabulary: predicates and relation templates, one module each, and what such a module defines.

CODE        the name in the plan, e.g. `LEFT-OF`
FAMILY      its row in the paper's table
REFERENCE   `required`, `optional` (omitted means the base) or `none`
PARAMS      its parameters by name
UNIT        of its margin: `m` or `deg`
GOOD, BAD   cases: worked numbers that resolve to `gives` and hold; layouts that do not hold
pins        (params) -> the coordinates of the subject it sets, each with what it reads: `reference.x`, `self.extents`,
            or `<parameter>.yaw` of the object that a parameter names …
resolve     (dof, subject, reference, params) -> Derivation
holds       (subject, reference, params) -> signed margin; negative means violated
and optionally
refuse      (params) -> (cause, fix) | None, for combinations that make no sense
expand      (Expansion) -> [(subject, params), …], when one row places several objects
sample      (subjects, reference, params, obstacles) -> [(x, y), …], when the places of several objects are drawn together

Parameters of kind `object` arrive as boxes. `seed`, `fovy_deg` and `aspect`, when a row leaves them out, are the plan's
own: its seed, the camera's lens and the recording's format.
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

CAMERA_FAMILY = "Camera templates"
"""Relations that place a camera, not a body: they are resolved when every body has its pose."""
SCENE = "the scene"
"""The box around every object, which camera templates without a reference frame; no object can have this name."""


@dataclass(frozen=True)
class Case:
    """A worked example of one predicate.

    subject, reference: arguments of `Box`; the subject of a GOOD case leaves out what the predicate sets.
    params: mappings in it stand for boxes too. gives: coordinates the predicate sets, metres and degrees.
    """

    subject: Mapping[str, Any]
    reference: Mapping[str, Any] | None = None
    params: Mapping[str, Any] = field(default_factory=dict)
    gives: Mapping[str, float] = field(default_factory=dict)

    def boxes(self) -> tuple[Box, Box, dict[str, Any]]:
        """Subject, reference (the base when there is none) and parameters as a module takes them."""
        subject = Box(**{"name": "subject", **self.subject})
        reference = Box(**{"name": "reference", **self.reference}) if self.reference else base()
        params = {k: Box(**{"name": k, **v}) if isinstance(v, Mapping) else v for k, v in self.params.items()}
        return subject, reference, params


@dataclass(frozen=True)
class Expansion:
    """A row that speaks about several objects, before it is split into one statement for each."""

    subject: str
    reference: str | None
    params: Mapping[str, Any]
    groups: Mapping[str, tuple[str, ...]]
    """Members of every group of the plan by its leader, the leader left out."""
    boxes: Mapping[str, Box]


def base() -> Box:
    """The base as a box."""
    endless = Surface("top", 0.0, (float("inf"), float("inf")))

    def surface(name: str | None) -> Surface:
        if name not in (None, "top"):
            raise KeyError(f"the base has no surface {name!r}; it has: top")
        return endless

    return Box(BASE, (0.0, 0.0, 0.0), x=0.0, y=0.0, z=0.0, yaw=0.0, round=True, surface=surface)
