"""The view of a model rule: the numbers and names of the compiled world, the lines that speak of them, and the plan."""

from functools import cached_property
from typing import Any

import numpy as np

from ...model.finding import Severity
from ...model.plan.committed import Plan
from ..problem import Problem
from ..program_view import Program
from .fetch import Outcome


class ModelView:
    """A compiled world. The engine's arrays are attributes by their own names, e.g. `view.geom_size`."""

    def __init__(
        self,
        outcome: Outcome,
        program: Program | None = None,
        plan: Plan | None = None,
        planned: "ModelView | None" = None,
    ) -> None:
        self.outcome = outcome
        self.program = program
        self.plan = plan
        self.planned = planned
        """The world that the plan describes, compiled from its own draft (`planned.world`)."""
        self.texts: dict[str, Any] = outcome.texts

    def __getattr__(self, name: str) -> Any:
        outcome: Outcome = self.__dict__["outcome"]
        if name in outcome.arrays:
            return outcome.arrays[name]
        if name in outcome.texts:
            return outcome.texts[name]
        raise AttributeError(f"the compiled world holds no {name}")

    def name(self, kind: str, index: int) -> str:
        """The name of an object; a nameless one is called by its kind and id, e.g. `geom_7`, or as its body's geom."""
        given = self.texts["names"][kind][index]
        if given:
            return str(given)
        if kind == "geom":
            return f"geom {index} of {self.name('body', int(self.geom_bodyid[index]))}"
        return f"{kind}_{index}"

    def at(self, kind: str, index: int, message: str, fix: str, severity: Severity | None = None) -> Problem:
        """A problem of one object, on the line of the source that names it (or its body)."""
        return Problem(message, fix, self.line_of(kind, index), severity=severity)

    def of_world(self, message: str, fix: str, *words: str, severity: Severity | None = None) -> Problem:
        """A problem of the whole world, on the first line where one of the words stands."""
        line = next((self._lines[w] for w in words if w in self._lines), None)
        return Problem(message, fix, line or 1, severity=severity)

    def line_of(self, kind: str, index: int) -> int:
        """The line that names an object, else its body, else the element of a nameless one; else 1."""
        names = [self.texts["names"][kind][index]]
        body = {"geom": "geom_bodyid", "joint": "jnt_bodyid", "camera": "cam_bodyid"}.get(kind)
        if body is not None:
            carrier = int(getattr(self, body)[index])
            while carrier > 0:
                names.append(self.texts["names"]["body"][carrier])
                carrier = int(self.body_parentid[carrier])
        return next((self._lines[n] for n in names if n and n in self._lines), 1)

    def masks_line(self, geom: int) -> int | None:
        """The line with a geom's contact masks, in its element or its default class; None without one."""
        if self.program is None:
            return None
        masks, tags = {"contype", "conaffinity"}, list(self.program.tags())
        own = next(
            (t for t in tags if t.name == "geom" and t.attributes.get("name") == self.texts["names"]["geom"][geom]),
            None,
        )
        if own is None or masks & set(own.attributes):
            return own.line if own is not None else None
        classes = [t for t in tags if t.name == "default" and t.attributes.get("class") == own.attributes.get("class")]
        given = (c for t in classes for c in t.children if c.name == "geom" and masks & set(c.attributes))
        return next((c.line for c in given), None)

    @cached_property
    def _lines(self) -> dict[str, int]:
        """The first line where each name is written: in a string of the program, or an attribute of the MJCF."""
        import ast

        found: dict[str, int] = {}
        if self.program is None:
            return found
        for tag in self.program.tags():
            found.setdefault(tag.name, tag.line)
            for key, value in tag.attributes.items():
                found.setdefault(key, tag.line)
                if key == "name":
                    found.setdefault(value, tag.line)
        for node in self.program.nodes(ast.Constant):
            if isinstance(node.value, str) and len(node.value) < 100:
                found.setdefault(node.value, node.lineno)
        for keyword in self.program.nodes(ast.keyword):
            if keyword.arg:
                found.setdefault(keyword.arg, keyword.value.lineno)
        for attribute in self.program.nodes(ast.Attribute):
            found.setdefault(attribute.attr, attribute.lineno)
        return found

    @cached_property
    def planned_bodies(self) -> frozenset[str]:
        """Names of the bodies of the plan's own world."""
        planned = self.planned
        return frozenset() if planned is None else frozenset(filter(None, planned.texts["names"]["body"]))

    @cached_property
    def things(self) -> frozenset[str]:
        """Names of the plan's objects and of all bodies of its own world, be it this one or the one that this is held against."""
        bodies = (self.planned or self).texts["names"]["body"]
        return frozenset(filter(None, bodies)) | set(self.plan.object_names() if self.plan else ())

    @cached_property
    def moving(self) -> np.ndarray:
        """(nbody,) bool: whether a body has degrees of freedom, its own or those of what carries it."""
        return self.body_treeid >= 0

    @cached_property
    def collides(self) -> np.ndarray:
        """(ngeom,) bool: whether a geom takes part in contacts at all, by its masks or in an explicit pair."""
        found = (self.geom_contype != 0) | (self.geom_conaffinity != 0)
        found[self.pair_geom1] = found[self.pair_geom2] = True
        return found

    def may_touch(self, geom: int) -> np.ndarray:
        """(ngeom,) bool: the geoms of other moving trees, or of the scenery, that a geom may meet."""
        mask = (self.geom_contype[geom] & self.geom_conaffinity) | (self.geom_contype & self.geom_conaffinity[geom])
        found = mask != 0
        for one, other in ((self.pair_geom1, self.pair_geom2), (self.pair_geom2, self.pair_geom1)):
            found[other[one == geom]] = True
        own, bodies = int(self.geom_bodyid[geom]), self.geom_bodyid
        same = self.body_weldid[bodies] == self.body_weldid[own]
        static = ~self.moving[bodies] & ~self.moving[own]
        for signature in self.exclude_signature:
            ends = (int(signature) >> 16, int(signature) & 0xFFFF)
            if own in ends:
                found[bodies == (ends[0] if ends[1] == own else ends[1])] = False
        return found & ~same & ~static

    @cached_property
    def contacts_off(self) -> bool:
        """Whether contacts, or all constraints, are switched off for the whole world."""
        return bool({"contact", "constraint"} & set(self.disabled))

    @cached_property
    def speed(self) -> np.ndarray:
        """(nbody,) speed of each free body at the start, m/s; zero for all others."""
        found = np.zeros(len(self.body_mass))
        for joint, kind in enumerate(self.joint_kind):
            if kind == "free":
                first = int(self.jnt_dofadr[joint])
                found[int(self.jnt_bodyid[joint])] = float(np.linalg.norm(self.qvel[first : first + 3]))
        return found

    def root_named(self, name: str) -> int | None:
        """The body of that name, or None."""
        names = self.texts["names"]["body"]
        return names.index(name) if name in names else None
