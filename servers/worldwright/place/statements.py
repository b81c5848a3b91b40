"""The placing statements of a plan, checked one by one: scene_predicates, geometry_relations and body_positions.

A statement that names nothing known, or has parameters that make no sense, becomes a finding here and goes no further.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

from ..model.finding import Finding
from ..model.plan.breakage import pieces
from ..model.plan.committed import TO_CLARIFY, Plan, PredicateRow, RelationRow
from ..model.plan.plan_references import GROUND, WORLD
from ..model.plan.spread import Stand, moved
from ..shelf import Entry
from .anchors import Box, CannotResolveError
from .parameters import read
from .vocabulary import BASE, CAMERA_FAMILY, PREDICATES, RELATIONS, SCENE, Expansion, ask

Path = tuple[str | int, ...]
Locate = Callable[..., int | None]
"""`PlanDocument.line_of`: line of a path, or None."""


@dataclass(frozen=True)
class Statement:
    """One row, ready to be evaluated."""

    path: Path
    """Its path in the plan."""
    line: int | None
    subject: str
    code: str
    reference: str | None
    params: dict[str, Any]
    entry: Entry = field(repr=False, compare=False)
    pins: dict[str, tuple[str, ...]] = field(repr=False)
    """The coordinates that it sets, with the names of what they are computed from."""

    def sources(self, owner: str) -> tuple[str, ...]:
        """Names of the objects that an owner in `pins` stands for: `self`, `reference`, or a parameter."""
        if owner == "self":
            return (self.subject,)
        value = self.reference if owner == "reference" else self.params.get(owner)
        if isinstance(value, Box):
            return (value.name,)
        return () if value in (None, BASE) else (str(value),)

    def needs(self) -> Iterator[str]:
        """The names of the objects that it refers to."""
        if self.reference not in (None, BASE, SCENE):
            yield str(self.reference)
        yield from (v.name for v in self.params.values() if isinstance(v, Box) and v.name != self.subject)

    @property
    def label(self) -> str:
        """The row in words."""
        return " ".join(part for part in (self.subject, self.code, self.reference) if part)

    def __str__(self) -> str:
        return f"{self.label} (line {self.line})" if self.line else self.label


class Problems:
    """Collects findings on a plan, each at its line."""

    def __init__(self, file: str, locate: Locate) -> None:
        self.file = file
        self.locate = locate
        self.findings: list[Finding] = []

    def add(self, code: str, name: str, message: str, fix: str, path: Path = (), *, severity: Any = "error") -> None:
        """Note one problem."""
        self.findings.append(
            Finding(
                code=code,
                name=name,
                severity=severity,
                message=message,
                fix=fix,
                file=self.file,
                line=self.locate(*path) if path else None,
                section=str(path[0]) if path else "topology",
            )
        )


def statements(
    plan: Plan, boxes: dict[str, Box], known: set[str], problems: Problems
) -> tuple[list[Statement], set[str]]:
    """Every statement that makes sense, and the objects of those that are wrong or unclear.

    Args:
        plan: the plan.
        boxes: objects whose size is known.
        known: all objects of the plan.
        problems: collects the senseless statements.
    """
    reader = _Reader(plan, boxes, known, problems)
    found = list(reader.rows())
    return found, reader.spoiled


def _groups(predicate: str) -> bool:
    """Whether rows of a predicate name a leader and its members."""
    return predicate in PREDICATES.entries and PREDICATES.entries[predicate].GROUPS


class _Reader:
    def __init__(self, plan: Plan, boxes: dict[str, Box], known: set[str], problems: Problems) -> None:
        self.plan = plan
        self.boxes = boxes
        self.known = known
        self.problems = problems
        self.spoiled: set[str] = set()
        heights = plan.topology.reference_heights
        self.heights = heights if isinstance(heights, dict) else {}
        self.cameras = {camera.name: camera for camera in plan.cameras()}
        self.groups = {
            row.subject: members
            for row in plan.topology.scene_predicates
            if _groups(row.predicate) and (members := _names(row.params.get("members")))
        }

    def rows(self) -> Iterator[Statement]:
        leaders: dict[str, Path] = {}
        for index, row in enumerate(self.plan.topology.scene_predicates):
            path: Path = ("topology", "scene_predicates", index)
            if _groups(row.predicate) and _names(row.params.get("members")):
                if row.subject in leaders:
                    self.spoiled.add(row.subject)
                    self.problems.add(
                        "WP212",
                        "second_group",
                        f"`{row.subject}` leads a group already: which one would be copied depends on the order of rows",
                        "name all members in one row, or let another object lead",
                        path,
                    )
                    continue
                leaders[row.subject] = path
            unclear = TO_CLARIFY in (row.position, row.orientation) or TO_CLARIFY in row.params.values()
            if unclear:
                self.unclear(row.subject, path)
            elif row.subject in self.plan.families or row.spread is not None:
                yield from self.copies(path, row)
            elif self.exists(row.subject, path):
                yield from self.statement(PREDICATES, path, row.subject, row.predicate, row.object, row.params)
        for index, relation in enumerate(self.plan.geometry_relations):
            path = ("geometry_relations", index)
            entry = RELATIONS.entries.get(relation.relation_name)
            if entry is not None and entry.FAMILY == CAMERA_FAMILY:
                yield from self.camera(path, relation)
                continue
            if relation.body_a in self.cameras and relation.body_a not in self.known:
                self.problems.add(
                    "WP211",
                    "unknown_relation",
                    f"`{relation.relation_name}` does not place the camera `{relation.body_a}`",
                    f"cameras: {', '.join(code for code, e in RELATIONS.items() if e.FAMILY == CAMERA_FAMILY)}",
                    path,
                )
                continue
            if _unclear(relation.parameters):
                self.unclear(relation.body_a, path)
            elif self.exists(relation.body_a, path):
                given = relation.parameters if isinstance(relation.parameters, dict) else {}
                yield from self.statement(
                    RELATIONS, path, relation.body_a, relation.relation_name, relation.body_b, given
                )
        for body, position in self.plan.topology.body_positions.items():
            path = ("topology", "body_positions", body)
            if isinstance(position, str):
                self.unclear(body, path)
            elif self.exists(body, path):
                params = {"position": list(position.vector)}
                yield from self.statement(RELATIONS, path, body, "base", None, params)

    def copies(self, path: Path, row: PredicateRow) -> Iterator[Statement]:
        """The same statement about every copy of its subject, moved and turned as `spread` says."""
        names = self.plan.families.get(row.subject)
        if names is None:
            self.spoiled.add(row.subject)
            cause = f"`spread` tells copies apart, and `{row.subject}` has no `count`"
            self.problems.add("WP202", "bad_params", cause, "give the scene object a `count`, or remove `spread`", path)
            return
        if row.subject in self.plan.broken:
            stands = [Stand(*p.offset[:2], p.low_m, None) for p in pieces(self.plan.broken[row.subject])]
        elif row.spread is not None:
            stands = row.spread.stands(len(names))
        else:
            for name in names:
                if self.exists(name, path):
                    yield from self.statement(PREDICATES, path, name, row.predicate, row.object, row.params)
            return
        for name, stand in zip(names, stands, strict=True):
            params = moved(row.predicate, row.params, stand)
            if params is None:
                self.spoiled |= set(names)
                cause = f"{row.predicate} gives no place that `spread` could go around"
                fix = "spread a row PLACE-ON-BASE (x, y), PLACE-ON or PLACE-IN (offset)"
                if row.subject in self.plan.broken:
                    cause = f"{row.predicate} gives no place for the pieces of `{row.subject}`"
                    fix = "place what breaks by one row PLACE-ON-BASE (x, y), PLACE-ON or PLACE-IN (offset); it is not turned"
                self.problems.add("WP202", "bad_params", cause, fix, path)
                return
            yield from self.statement(PREDICATES, path, name, row.predicate, row.object, params)
            if stand.deg_z is not None:
                turn = {"min_deg": stand.deg_z, "max_deg": stand.deg_z}
                yield from self.statement(PREDICATES, path, name, "RANDOM-ROT", None, turn)

    def unclear(self, subject: str, path: Path) -> None:
        self.spoiled.add(subject)
        self.problems.add(
            "WP210",
            "to_clarify",
            f"`{subject}` is marked {TO_CLARIFY}: nobody has said where it goes",
            f"ask, then write the answer as predicates and remove {TO_CLARIFY}",
            path,
        )

    def exists(self, subject: str, path: Path) -> bool:
        if subject in self.boxes:
            return True
        self.spoiled.add(subject)
        if subject not in self.known:
            near = get_close_matches(subject, self.known, n=1, cutoff=0.6)
            self.problems.add(
                "WP203",
                "unknown_object",
                f"there is no object `{subject}`",
                f"did you mean `{near[0]}`?" if near else f"known: {', '.join(sorted(self.known)) or '(none)'}",
                path,
            )
        return False

    def statement(
        self, shelf: Any, path: Path, subject: str, code: str, reference: str | None, params: dict[str, Any]
    ) -> Iterator[Statement]:
        line = self.problems.locate(*path)
        if code not in shelf.entries:
            self.spoiled.add(subject)
            near = get_close_matches(code.upper() if shelf is PREDICATES else code, shelf, n=1, cutoff=0.6)
            word = "predicate" if shelf is PREDICATES else "relation"
            self.problems.add(
                "WP201" if shelf is PREDICATES else "WP211",
                f"unknown_{word}",
                f"`{code}` is not a {word}: the vocabulary is closed",
                (f"did you mean `{near[0]}`? " if near else "") + f"known: {', '.join(shelf)}",
                path,
            )
            return
        entry = shelf.entries[code]
        wrong = self.reference_problem(entry, subject, reference)
        values, faults = read(params, entry.PARAMS, self.heights)
        if not wrong and not faults:
            faults = list(self.objects(entry, subject, values))
        if not wrong and not faults and entry.refuse is not None:
            try:
                faults = [refused] if (refused := ask(entry, "refuse", values)) else []
            except CannotResolveError as error:
                faults = [(str(error), error.fix)]
        for cause, fix in [*([wrong] if wrong else []), *faults]:
            self.spoiled.add(subject)
            place = (*path, "params") if path[0] != "geometry_relations" else (*path, "parameters")
            self.problems.add("WP202", "bad_params", f"{subject} {code}: {cause}", fix, path if wrong else place)
        if wrong or faults:
            return
        if entry.REFERENCE == "optional" and reference is None:
            reference = BASE
        if "seed" in entry.PARAMS:
            values.setdefault("seed", float(self.plan.simulation_parameters.seed))
        for part, own in self.expanded(entry, path, subject, reference, values):
            try:
                yield Statement(path, line, part, code, reference, own, entry, ask(entry, "pins", own))
            except CannotResolveError as error:
                self.spoiled.add(part)
                self.problems.add("WP202", "bad_params", f"{part} {code}: {error}", error.fix, path)

    def objects(self, entry: Entry, subject: str, values: dict[str, Any]) -> Iterator[tuple[str, str]]:
        """Replace names of objects among the parameters by their boxes; yields what is wrong with them."""
        for key, parameter in entry.PARAMS.items():
            if key not in values or parameter.kind not in ("object", "objects"):
                continue
            names = values[key] if parameter.kind == "objects" else (values[key],)
            for name in names:
                if name == subject:
                    yield f"`{key}` names the subject itself", "name another object"
                elif name not in self.known:
                    near = get_close_matches(name, self.known, n=1, cutoff=0.6)
                    fix = f"did you mean `{near[0]}`?" if near else f"known: {', '.join(sorted(self.known))}"
                    yield f"`{key}`: there is no object `{name}`", fix
                elif name not in self.boxes:
                    yield f"`{key}`: the size of `{name}` is not known", f"fix the finding about `{name}` first"
            if parameter.kind == "object" and values[key] in self.boxes:
                values[key] = self.boxes[values[key]]

    def expanded(
        self, entry: Entry, path: Path, subject: str, reference: str | None, values: dict[str, Any]
    ) -> list[tuple[str, dict[str, Any]]]:
        """The statements that a row about several objects stands for."""
        if entry.expand is None:
            return [(subject, values)]
        try:
            parts: list[tuple[str, dict[str, Any]]] = ask(
                entry, "expand", Expansion(subject, reference, values, self.groups, self.boxes)
            )
        except CannotResolveError as error:
            self.spoiled |= {subject, *(name for name in values.get("members", ()) if name in self.known)}
            self.problems.add("WP202", "bad_params", f"{subject} {entry.code}: {error}", error.fix, path)
            return []
        return parts

    def camera(self, path: Path, relation: RelationRow) -> Iterator[Statement]:
        """A camera's relation; its lens and the recording's format come from their owners."""
        name = relation.body_a
        if name not in self.cameras:
            self.problems.add(
                "WP203",
                "unknown_object",
                f"there is no camera `{name}`",
                "add it to the cameras of an implementation step; known: " + (", ".join(self.cameras) or "(none)"),
                path,
            )
            return
        if _unclear(relation.parameters):
            self.unclear(name, path)
            self.spoiled.discard(name)
            return
        given = dict(relation.parameters) if isinstance(relation.parameters, dict) else {}
        width, height = self.plan.recording_mode.size
        given.setdefault("fovy_deg", self.cameras[name].fovy)
        given.setdefault("aspect", width / height)
        reference = None if relation.body_b in (BASE, WORLD, GROUND, SCENE) else relation.body_b
        entry = RELATIONS.entries[relation.relation_name]
        if reference is None and entry.REFERENCE == "optional":
            reference = SCENE
        yield from self.statement(RELATIONS, path, name, relation.relation_name, reference, given)
        self.spoiled.discard(name)

    def reference_problem(self, entry: Entry, subject: str, reference: str | None) -> tuple[str, str] | None:
        if entry.REFERENCE == "none":
            return None if reference in (None, BASE) else ("it takes no object", "remove `object`")
        if reference is None:
            if entry.REFERENCE == "optional":
                return None
            return (
                "it needs an object to refer to",
                f"add `object: <name>`, or `object: {BASE}` for the world's origin",
            )
        if reference == subject:
            return ("it refers to itself", "name another object")
        if reference == BASE or reference in self.known or (reference == SCENE and entry.FAMILY == CAMERA_FAMILY):
            return None
        near = get_close_matches(reference, self.known, n=1, cutoff=0.6)
        return (
            f"there is no object `{reference}`",
            f"did you mean `{near[0]}`?" if near else f"known: {BASE}, {', '.join(sorted(self.known))}",
        )


def _unclear(parameters: Any) -> bool:
    """Whether a relation, or one of its parameters, is still open."""
    return bool(parameters == TO_CLARIFY or (isinstance(parameters, dict) and TO_CLARIFY in parameters.values()))


def _names(value: Any) -> tuple[str, ...]:
    return tuple(value) if isinstance(value, list | tuple) and all(isinstance(v, str) for v in value) else ()
