"""The closed vocabulary: predicates and relation templates, one module each;
`PROTOCOL` says what such a module defines.

Parameters of kind `object` arrive as boxes. `seed`, `fovy_deg` and `aspect`, when a row leaves them out, are the plan's
own: its seed, the camera's lens and the recording's format.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..shelf import Attribute, Entry, Function, Shelf, failed
from .anchors import Box, CannotResolveError, Surface

BASE = "base"
"""The ground at the world's origin: a point without extents, facing +X, on an endless plane at z = 0."""

PROTOCOL = {
    "CODE": Attribute(str, "the name in the plan, e.g. `LEFT-OF`"),
    "FAMILY": Attribute(str, "its row in the paper's table"),
    "REFERENCE": Attribute(str, "`required`, `optional` (omitted means the base) or `none`"),
    "PARAMS": Attribute(dict, "its parameters by name"),
    "UNIT": Attribute(str, "of its margin: `m` or `deg`"),
    "GOOD": Attribute(tuple, "cases: worked numbers that resolve to `gives` and hold"),
    "BAD": Attribute(tuple, "cases: layouts that do not hold"),
    "pins": Attribute(
        Function,
        "(params) -> the coordinates of the subject that it sets, each with what it reads: `reference.x`, "
        "`self.extents`, or `<parameter>.yaw` of the object that a parameter names",
    ),
    "resolve": Attribute(Function, "(dof, subject, reference, params) -> Derivation"),
    "holds": Attribute(Function, "(subject, reference, params) -> signed margin; negative means violated"),
    "refuse": Attribute(Function, "(params) -> (cause, fix) or None, for combinations that make no sense", None),
    "expand": Attribute(Function, "(Expansion) -> [(subject, params), …], when one row places several objects", None),
    "sample": Attribute(
        Function,
        "(subjects, reference, params, obstacles) -> [(x, y), …], when the places of several objects are drawn together",
        None,
    ),
    "target": Attribute(Function, "(reference, params) -> the point that a camera looks at", None),
    "SUPPORTS": Attribute(bool, "the subject rests on the reference", False),
    "INSIDE": Attribute(bool, "the subject is meant to be inside the reference", False),
    "DROP": Attribute(str, "the parameter by which the subject is lifted over what it then falls onto, if any", ""),
    "OTHERWISE": Attribute(str, "what else may have been meant where it does not hold", ""),
    "GROUPS": Attribute(bool, "the row makes its subject the leader of `members`", False),
    "COPIES": Attribute(bool, "the subject and its members stand as those of another group do", False),
}
PREDICATES = Shelf("worldwright.place.predicates", PROTOCOL)
RELATIONS = Shelf("worldwright.place.relations", PROTOCOL)


def ask(entry: Entry, verb: str, *arguments: Any) -> Any:
    """Ask an entry; an exception of its own becomes a `CannotResolveError` that names the entry."""
    try:
        return getattr(entry, verb)(*arguments)
    except CannotResolveError:
        raise
    except Exception as defect:  # a defect of one entry must not end the layout of all the others
        raise CannotResolveError(failed(entry, defect), "say the same with another row meanwhile") from defect


CAMERA_FAMILY = "Camera templates"
"""Relations of this family place a camera, not a body, and are resolved when every body has its pose."""
SCENE = "the scene"
"""The box around all objects, which camera templates without a reference frame; no object can have this name."""


@dataclass(frozen=True)
class Case:
    """A worked example of one predicate.

    subject, reference: arguments of `Box`; the subject of a GOOD case leaves out what the predicate sets.
    params: mappings in it stand for boxes, too. gives: the coordinates that the predicate sets, metres and degrees.
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
    """The members of every group of the plan, without its leader, by leader."""
    boxes: Mapping[str, Box]


def base() -> Box:
    """The base as a box."""
    endless = Surface("top", 0.0, (float("inf"), float("inf")))

    def surface(name: str | None) -> Surface:
        if name not in (None, "top"):
            raise KeyError(f"the base has no surface {name!r}; it has: top")
        return endless

    return Box(BASE, (0.0, 0.0, 0.0), x=0.0, y=0.0, z=0.0, yaw=0.0, round=True, surface=surface)
