"""The resolver's result: poses with their formulas, the statements they come from, and the cameras' shots."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

from ..model.finding import Finding
from ..model.plan.committed import Plan, SettledOffset
from ..model.plan.layout import PlacedCamera, PlacedObject, Scene
from ..model.plan.weights import weight
from .anchors import DOFS, Box, shown, wrap
from .extents import fixed_objects
from .graph import Node
from .placement_results import RowMargin
from .statements import Statement
from .vocabulary import BASE, SCENE, base


@dataclass(frozen=True)
class Shot:
    """A camera that a template placed: a point (a box without extents), and the box that it frames."""

    camera: Box
    frames: Box
    placed: PlacedCamera


@dataclass
class Resolution:
    """A resolved layout with everything that led to it."""

    scene: Scene
    boxes: dict[str, Box] = field(default_factory=dict)
    """Placed objects by name, in dependency order; not rounded."""
    statements: list[Statement] = field(default_factory=list)
    derived: dict[tuple[str | int, ...], list[str]] = field(default_factory=dict)
    """Formulas that each row contributed, by its path."""
    shots: dict[str, Shot] = field(default_factory=dict)
    """Cameras that a template placed, by name."""
    margins: list[RowMargin] = field(default_factory=list)
    """How well each row holds."""

    @cached_property
    def rows_at(self) -> dict[tuple[str | int, ...], list[Statement]]:
        """Statements by the path of their row; a row about several objects has several."""
        found: dict[tuple[str | int, ...], list[Statement]] = defaultdict(list)
        for statement in self.statements:
            found[statement.path].append(statement)
        return dict(found)

    def subject(self, statement: Statement) -> Box | None:
        """The box, or the camera, that a statement is about."""
        if statement.subject in self.shots and statement.subject not in self.boxes:
            return self.shots[statement.subject].camera
        return self.boxes.get(statement.subject)

    def reference(self, statement: Statement) -> Box | None:
        """The box a statement refers to."""
        if statement.reference in (None, BASE):
            return base()
        if statement.reference == SCENE:
            return self.whole()
        return self.boxes.get(str(statement.reference))

    def measurable(self, statement: Statement) -> bool:
        """Whether everything a statement speaks about is placed."""
        return (
            self.subject(statement) is not None
            and self.reference(statement) is not None
            and all(name in self.boxes for name in statement.needs())
        )

    def whole(self) -> Box | None:
        """The box around every object; None without objects."""
        return around(list(self.boxes.values()), SCENE)

    def told(self, findings: list[Finding]) -> "Resolution":
        """This resolution with findings and cameras in its scene."""
        cameras = tuple(shot.placed for shot in self.shots.values())
        scene = Scene(objects=self.scene.objects, cameras=cameras, findings=tuple(findings))
        return replace(self, scene=scene)


def around(boxes: list[Box], name: str) -> Box | None:
    """The world AABB of boxes, as a box of that name."""
    if not boxes:
        return None
    low = [min(box.low(axis) for box in boxes) for axis in "xyz"]
    high = [max(box.high(axis) for box in boxes) for axis in "xyz"]
    size = (high[0] - low[0], high[1] - low[1], high[2] - low[2])
    x, y, z = ((a + b) / 2 for a, b in zip(low, high, strict=True))
    return Box(name, size, x=x, y=y, z=z, yaw=0.0)


def collected(
    plan: Plan,
    placed: dict[str, Box],
    rows: list[Statement],
    formulas: Mapping[Node, list[str]],
    derived: Mapping[tuple[str | int, ...], list[str]],
) -> Resolution:
    """Collect the layout of the placed boxes, references before what refers to them."""
    fixed = set(fixed_objects(plan))
    kinds = {row.name: "scene_object" for row in plan.scene_objects}
    kinds |= {name: row.filename for row in plan.assets for name in row.instances}
    supports = _supports(rows)
    weights = dict(_weights(plan))
    turned = {row.subject for row in rows if "yaw" in row.pins}

    def provenance(name: str) -> Iterator[str]:
        for dof in DOFS:
            yield from formulas.get((name, dof), ())
        if name not in turned:
            yield "deg_z = 0 (no orientation row: front along +X)"
        if name in settled:
            yield f"then {_shifted(settled[name])} (topology.settled: let go in a pre-roll)"

    settled = plan.topology.settled
    rest = SettledOffset()

    objects = tuple(
        PlacedObject(
            name=name,
            kind=kinds[name],
            size=box.size,
            position=(
                rounded(box.get("x") + settled.get(name, rest).x),
                rounded(box.get("y") + settled.get(name, rest).y),
                rounded(box.get("z") + settled.get(name, rest).z),
            ),
            deg_z=rounded(wrap(box.get("yaw") + settled.get(name, rest).deg_z)),
            round=box.round,
            fixed=name in fixed,
            supported_by=supports.get(name),
            weight=weights.get(name, ""),
            provenance=tuple(provenance(name)),
        )
        for name, box in _ordered(placed, rows)
    )
    return Resolution(Scene(objects=objects), {o.name: placed[o.name] for o in objects}, rows, dict(derived))


def _weights(plan: Plan) -> Iterator[tuple[str, str]]:
    """The mass of each compound in words; nothing if its masses contradict each other, which the linter reports."""
    for row in plan.scene_objects:
        if row.parts and not row.visual_only:
            with suppress(ValueError):
                yield row.name, str(weight(plan, row))


def _shifted(offset: SettledOffset) -> str:
    """A settled displacement in words."""
    parts = [f"{dof} {shown(v)} m" for dof, v in (("x", offset.x), ("y", offset.y), ("z", offset.z)) if v]
    return ", ".join([*parts, *([f"deg_z {shown(offset.deg_z)}"] if offset.deg_z else [])]) or "nothing"


def _supports(rows: list[Statement]) -> dict[str, str]:
    """The object on which each one rests by its rows; a copy rests on the copy of its original's support."""
    found: dict[str, str] = {}
    copies: dict[str, tuple[str, str, str]] = {}
    for row in rows:
        if row.entry.SUPPORTS:
            found[row.subject] = "ground" if row.reference in (None, BASE) else str(row.reference)
        elif row.entry.COPIES:
            leader = row.params["leader"].name if "leader" in row.params else row.subject
            original = row.params["original"].name if "original" in row.params else str(row.reference)
            copies[row.subject] = (original, str(row.reference), leader)
    leaders: dict[tuple[str, str], dict[str, str]] = defaultdict(dict)
    for name, (original, source, leader) in copies.items():
        leaders[source, leader][original] = name

    def of(name: str, seen: frozenset[str] = frozenset()) -> str | None:
        if name in found or name not in copies or name in seen:
            return found.get(name)
        original, source, leader = copies[name]
        below = of(original, seen | {name})
        if below in leaders[source, leader]:
            return leaders[source, leader][below]
        if name != leader and below == of(source, seen | {name}):
            return of(leader, seen | {name})
        return below

    return found | {name: below for name in copies if (below := of(name)) is not None}


def _ordered(placed: dict[str, Box], rows: list[Statement]) -> list[tuple[str, Box]]:
    """Order references before what refers to them, otherwise as in the plan."""
    needs: dict[str, list[str]] = defaultdict(list)
    for row in rows:
        if row.pins and row.subject in placed:
            needs[row.subject] += [name for name in row.needs() if name in placed]
    order: dict[str, Box] = {}
    for root in placed:
        if root in order:
            continue
        stack = [(root, iter(needs[root]))]
        open_names = {root}
        while stack:
            name, references = stack[-1]
            step = next((r for r in references if r not in order and r not in open_names), None)
            if step is not None:
                stack.append((step, iter(needs[step])))
                open_names.add(step)
            else:
                stack.pop()
                order.setdefault(name, placed[name])
    return list(order.items())


def rounded(value: float) -> float:
    """Round to micrometres and microdegrees, without a negative zero."""
    return round(value, 6) + 0.0
