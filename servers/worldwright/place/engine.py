"""The resolver: rows in dependency order onto anchors, until every object has a pose and every number a formula.

It guesses nothing. What is said twice must agree, what is not said is a finding that names the predicates which would
say it, and what depends on itself is a finding that names the circle. Source: paper, "Scene Inference" and the
Predicate-to-Position Contract.
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field

from ..model.plan import Plan
from ..model.scene import PlacedObject, Scene
from .anchors import DOFS, Box, CannotResolveError, Derivation, shown, wrap
from .extents import boxes, fixed_objects
from .graph import Node, groups, order_within
from .statements import Locate, Problems, Statement, statements
from .vocabulary import BASE, base

AGREE = 1e-6
"""Two rows may set the same coordinate if they differ by less: metres or degrees."""
MISSING = {
    "x": "FRONT-OF or BACK-OF with `gap`, ALIGN-FRONT, ALIGN-BACK or ALIGN-CENTER-FB, PLACE-ON with `offset`, or "
    "PLACE-ON-BASE with `x`",
    "y": "LEFT-OF or RIGHT-OF with `gap`, ALIGN-LEFT, ALIGN-RIGHT or ALIGN-CENTER-LR, PLACE-ON with `offset`, or "
    "PLACE-ON-BASE with `y`",
    "z": "PLACE-ON-BASE, PLACE-ON, or HEIGHT with `bottom`, `center` or `top`",
}


@dataclass
class Resolution:
    """A resolved layout with everything that led to it."""

    scene: Scene
    boxes: dict[str, Box] = field(default_factory=dict)
    """Placed objects by name, in dependency order; not rounded."""
    statements: list[Statement] = field(default_factory=list)
    derived: dict[tuple[str | int, ...], list[str]] = field(default_factory=dict)
    """Formulas that each row contributed, by its path."""

    def reference(self, statement: Statement) -> Box | None:
        """The box a statement refers to."""
        if statement.reference in (None, BASE):
            return base()
        return self.boxes.get(str(statement.reference))


def resolve(plan: Plan, *, file: str = "plan.md", locate: Locate = lambda *path: None) -> Resolution:
    """Place every object of a plan.

    Args:
        plan: the plan.
        file: its file, for findings.
        locate: line of a path in it (`PlanDocument.line_of`).

    Returns:
        the layout; `scene.findings` has an error for each object that could not be placed.
    """
    return _Resolver(plan, Problems(file, locate)).resolve()


class _Resolver:
    def __init__(self, plan: Plan, problems: Problems) -> None:
        self.plan = plan
        self.problems = problems
        self.boxes, self.unsized = boxes(plan)
        self.known = set(plan.object_names())
        self.base = base()
        self.pins: dict[Node, list[Statement]] = defaultdict(list)
        self.formulas: dict[Node, list[str]] = {}
        self.derived: dict[tuple[str | int, ...], list[str]] = defaultdict(list)
        self.failed: set[str] = set()
        self.told: set[str] = set()
        """Failed objects that some finding is about; the other failed ones only wait for them."""

    def resolve(self) -> Resolution:
        reported: set[str] = set()
        for cause, fix, path in self.unsized.values():
            if cause not in reported:
                reported.add(cause)
                self.problems.add("WP209", "unknown_size", cause, fix, path)
        rows, spoiled = statements(self.plan, self.boxes, self.known, self.problems)
        self.fail(set(self.unsized) | spoiled)
        rows_of: dict[str, list[Statement]] = defaultdict(list)
        for row in rows:
            rows_of[row.subject].append(row)
            for dof in row.pins:
                self.pins[row.subject, dof].append(row)
        for name in self.boxes:
            if name not in self.failed:
                self.check_determined(name, rows_of[name])
        reads = {node: self.reads(node) for node in self.nodes()}
        for group in groups(reads):
            self.place(group, reads)
        self.name_the_waiting()
        return self.result(rows)

    def fail(self, names: set[str]) -> None:
        """These objects cannot be placed, and a finding says why."""
        self.failed |= names
        self.told |= names

    def nodes(self) -> Iterator[Node]:
        for name in self.boxes:
            for dof in DOFS:
                if (name, dof) in self.pins or dof == "yaw":
                    yield (name, dof)

    def reads(self, node: Node) -> set[Node]:
        """The coordinates that computing a node reads."""
        found: set[Node] = set()
        for row in self.pins.get(node, ()):
            for name in row.pins[node[1]]:
                owner, _, anchor = name.partition(".")
                target = row.subject if owner == "self" else row.reference
                if target is None or target == BASE:
                    continue
                if anchor != "extents":
                    found.add((target, anchor))
                elif target in self.boxes and not self.boxes[target].round:
                    found.add((target, "yaw"))
        return found

    def check_determined(self, name: str, rows: list[Statement]) -> None:
        """Every object needs x, y and z; yaw has the documented baseline."""
        missing = [dof for dof in ("x", "y", "z") if (name, dof) not in self.pins]
        if not missing:
            return
        self.fail({name})
        said = "; ".join(str(row) for row in rows)
        if not rows:
            self.problems.add(
                "WP204",
                "unplaced_object",
                f"nothing says where `{name}` goes",
                f"add rows for it under topology.scene_predicates, e.g. "
                f"`- {{subject: {name}, predicate: PLACE-ON-BASE, params: {{x: 0, y: 0}}}}`",
                self.declaration(name),
            )
            return
        for dof in missing:
            self.problems.add(
                "WP205",
                "under_determined",
                f"`{name}` has no {dof}: its rows ({said}) do not set it",
                f"add {MISSING[dof]}",
                rows[-1].path,
            )

    def declaration(self, name: str) -> tuple[str | int, ...]:
        for index, row in enumerate(self.plan.scene_objects):
            if row.name == name:
                return ("scene_objects", index)
        for index, asset in enumerate(self.plan.assets):
            if name in asset.instances:
                return ("assets", index)
        return ("topology",)

    def place(self, group: list[Node], reads: dict[Node, set[Node]]) -> None:
        """Compute one group of coordinates."""
        names = {name for name, _ in group}
        if names & self.failed or any(
            self.blocked(read) for node in group for read in reads[node] if read not in group
        ):
            self.failed |= names
            return
        if len(group) == 1 and group[0] not in reads[group[0]]:
            self.evaluate(group[0])
            return
        order, circle = order_within(group, reads)
        if circle is not None:
            self.tell_circle(circle)
            self.fail(names)
            return
        self.iterate(order, names)

    def blocked(self, node: Node) -> bool:
        return node[0] in self.failed or node[0] not in self.boxes or getattr(self.boxes[node[0]], node[1]) is None

    def evaluate(self, node: Node, *, final: bool = True) -> float | None:
        """Compute a coordinate from its rows; they must agree."""
        name, dof = node
        box = self.boxes[name]
        rows = self.pins.get(node, [])
        if not rows:  # only yaw has a baseline
            box.yaw = 0.0
            return 0.0
        results: list[tuple[Statement, Derivation]] = []
        for row in rows:
            reference = self.base if row.reference in (None, BASE) else self.boxes[str(row.reference)]
            try:
                results.append((row, row.entry.resolve(dof, box, reference, row.params)))
            except CannotResolveError as error:
                self.problems.add("WP208", "no_solution", f"{row}: {error}", error.fix, row.path)
                self.fail({name})
                return None
        value = results[0][1].value
        setattr(box, dof, value)
        if final:
            for row, derivation in results:
                self.derived[row.path].append(derivation.formula)
                difference = derivation.value - value
                if abs(wrap(difference) if dof == "yaw" else difference) > AGREE:
                    self.disagree(name, dof, results[0], (row, derivation))
                    return None
            self.formulas[node] = [f"{d.formula}  [{row.label}]" for row, d in results]
        return value

    def disagree(
        self, name: str, dof: str, first: tuple[Statement, Derivation], second: tuple[Statement, Derivation]
    ) -> None:
        unit = "deg" if dof == "yaw" else "m"
        away = abs(second[1].value - first[1].value)
        self.problems.add(
            "WP206",
            "over_determined",
            f"two rows set {dof} of `{name}` and disagree by {shown(away)} {unit}: "
            f"{first[0]} gives {first[1].formula}, "
            f"{second[0]} gives {second[1].formula}",
            "remove one of the two rows, or change its parameters until both agree",
            second[0].path,
        )
        self.fail({name})

    def iterate(self, order: list[Node], names: set[str]) -> None:
        """Solve positions and yaws that depend on each other: repeat until nothing moves."""
        for name, dof in order:
            if dof == "yaw":
                self.boxes[name].yaw = 0.0
        for step in range(400):
            change = 0.0
            for node in order:
                box, dof = self.boxes[node[0]], node[1]
                before = getattr(box, dof)
                value = self.evaluate(node, final=False)
                if value is None:
                    self.failed |= names
                    return
                if dof == "yaw":
                    turn = wrap(value - before)
                    if step > 40:  # it swings to and fro: take half steps
                        box.yaw = wrap(before + turn / 2)
                    change = max(change, abs(turn) / 57.3)
                else:
                    change = max(change, abs(value - before) if before is not None else 1.0)
            if change < 1e-11:
                break
        else:
            rows = sorted({str(row) for node in order for row in self.pins.get(node, ())})
            path = next(row.path for node in order for row in self.pins.get(node, ()))
            self.problems.add(
                "WP208",
                "no_solution",
                f"position and yaw of {', '.join(sorted(names))} depend on each other and do not settle: "
                + "; ".join(rows),
                "place them by centres (ALIGN-CENTER-LR, ALIGN-CENTER-FB) or give a fixed heading (FACING-FRONT …)",
                path,
            )
            self.fail(names)
            return
        for node in order:
            if self.evaluate(node) is None:
                self.failed |= names
                return

    def tell_circle(self, circle: list[Node]) -> None:
        """A circle of positions: name the rows that close it."""
        rows: dict[str, Statement] = {}
        for position, node in enumerate(circle):
            read = circle[position - 1]
            for row in self.pins[node]:
                if read[0] in (row.reference, row.subject):
                    rows.setdefault(str(row), row)
        names = list(dict.fromkeys(name for name, _ in circle))
        chain = " -> ".join([*names, names[0]])
        self.problems.add(
            "WP207",
            "cycle",
            f"{', '.join(f'{n}.{dof}' for n, dof in circle)} depend on each other ({chain}): {'; '.join(rows)}",
            f"place one of them without the others, e.g. by PLACE-ON-BASE with x and y, or relative to `{BASE}`",
            min((row.path for row in rows.values()), key=str),
        )

    def name_the_waiting(self) -> None:
        """Objects that only wait for others get one finding together."""
        waiting = sorted(self.failed - self.told)
        if waiting:
            first = next((row for dof in DOFS for row in self.pins.get((waiting[0], dof), ())), None)
            self.problems.add(
                "WP204",
                "unplaced_object",
                f"{', '.join(waiting)} cannot be placed, because what they refer to is not",
                "fix the other findings first",
                first.path if first else ("topology",),
            )

    def result(self, rows: list[Statement]) -> Resolution:
        fixed = set(fixed_objects(self.plan))
        kinds = {row.name: "scene_object" for row in self.plan.scene_objects}
        kinds |= {name: row.filename for row in self.plan.assets for name in row.instances}
        supports: dict[str, str] = {}
        for row in rows:
            if row.code == "PLACE-ON-BASE" or (row.code == "PLACE-ON" and row.reference == BASE):
                supports[row.subject] = "ground"
            elif row.code == "PLACE-ON":
                supports[row.subject] = str(row.reference)
        placed = {n: b for n, b in self.boxes.items() if n not in self.failed}
        objects = [
            PlacedObject(
                name=name,
                kind=kinds[name],
                size=box.size,
                position=(_round(box.get("x")), _round(box.get("y")), _round(box.get("z"))),
                deg_z=_round(wrap(box.get("yaw"))),
                round=box.round,
                fixed=name in fixed,
                supported_by=supports.get(name),
                provenance=tuple(self.provenance(name)),
            )
            for name, box in _ordered(placed, rows)
        ]
        scene = Scene(objects=tuple(objects), findings=tuple(self.problems.findings))
        return Resolution(scene, {o.name: self.boxes[o.name] for o in objects}, rows, dict(self.derived))

    def provenance(self, name: str) -> Iterator[str]:
        for dof in DOFS:
            yield from self.formulas.get((name, dof), ())
        if (name, "yaw") not in self.pins:
            yield "deg_z = 0 (no orientation row: front along +X)"


def _ordered(placed: dict[str, Box], rows: list[Statement]) -> list[tuple[str, Box]]:
    """References before what refers to them, otherwise in plan order."""
    needs: dict[str, list[str]] = defaultdict(list)
    for row in rows:
        if row.reference in placed and row.pins:
            needs[row.subject].append(str(row.reference))
    order: dict[str, Box] = {}
    for root in placed:
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


def _round(value: float) -> float:
    """Micrometres and microdegrees, without a negative zero."""
    return round(value, 6) + 0.0
