"""Resolve a plan: apply rows to anchors in dependency order, until every object has a pose and every number a formula.

Nothing is guessed. What is said twice must agree, what is not said is a finding that names the predicates which would
say it, and what depends on itself is a finding that names the circle. Source: paper, "Scene Inference" and the
Predicate-to-Position Contract.
"""

import gc
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager

from ..model.plan.committed import Plan
from .anchors import DOFS, CannotResolveError, Derivation, shown, wrap
from .extents import boxes
from .graph import Node, groups, order_within
from .margins import measure
from .resolution import Resolution, collected
from .setters import setters
from .shots import shots
from .statements import Locate, Problems, Statement, statements
from .vocabulary import BASE, CAMERA_FAMILY, ask, base

AGREE = 1e-6
"""Two rows may set the same coordinate if they differ by less: metres or degrees."""


def resolve(plan: Plan, *, file: str = "plan.md", locate: Locate = lambda *_path: None) -> Resolution:
    """Place every object of a plan.

    Args:
        plan: the plan.
        file: its file, for findings.
        locate: line of a path in it (`PlanDocument.line_of`).

    Returns:
        the layout; `scene.findings` has an error for each object that could not be placed, and for each row that does not
        hold at the poses found (a centre beyond the edge of its surface, a demanded side that is not kept).
    """
    with uncollected():
        return _Resolver(plan, Problems(file, locate)).resolve()


@contextmanager
def uncollected() -> Iterator[None]:
    """Run without the cyclic garbage collector: nothing made here is garbage before the end, and to scan it again and again
    costs a third of the time at ten thousand objects."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


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
        self.regions: dict[tuple[object, ...], list[Statement]] = defaultdict(list)
        """Rows whose places are drawn together."""
        self.failed: set[str] = set()
        self.told: set[str] = set()
        """Failed objects with a finding of their own; the other failed ones only wait for them."""

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
            if row.entry.FAMILY == CAMERA_FAMILY:
                continue
            rows_of[row.subject].append(row)
            if row.entry.sample is not None:
                self.regions[self.region(row)].append(row)
            for dof in row.pins:
                self.pins[row.subject, dof].append(row)
        for name in self.boxes:
            if name not in self.failed:
                self.check_determined(name, rows_of[name])
        reads = {node: self.reads(node) for node in self.nodes()}
        for group in self.sampled_last(groups(reads), reads):
            self.place(group, reads)
        self.name_the_waiting()
        placed = {name: box for name, box in self.boxes.items() if name not in self.failed}
        resolution = collected(self.plan, placed, rows, self.formulas, self.derived)
        resolution.shots = shots(resolution, self.problems)
        resolution.margins = measure(resolution, self.problems)
        return resolution.told(self.problems.findings)

    def fail(self, names: set[str]) -> None:
        """Note that these objects cannot be placed, and that a finding says why."""
        self.failed |= names
        self.told |= names

    def nodes(self) -> Iterator[Node]:
        for name in self.boxes:
            for dof in DOFS:
                if (name, dof) in self.pins or dof == "yaw":
                    yield (name, dof)

    def reads(self, node: Node) -> set[Node]:
        """The coordinates that a node is computed from."""
        found: set[Node] = set()
        for row in self.pins.get(node, ()):
            for name in row.pins[node[1]]:
                owner, _, anchor = name.partition(".")
                for target in row.sources(owner):
                    if anchor != "extents":
                        found.add((target, anchor))
                    elif target in self.boxes and not self.boxes[target].round:
                        found.add((target, "yaw"))
        return found

    def sampled_last(self, found: list[list[Node]], reads: dict[Node, set[Node]]) -> list[list[Node]]:
        """Order groups so that those without drawn places come first and leave the free area for the drawn ones."""
        if not self.regions:
            return found
        drawn = {(row.subject, dof) for rows in self.regions.values() for row in rows for dof in row.pins}
        late: set[Node] = set()
        first, last = [], []
        for group in found:
            if any(node in drawn or not late.isdisjoint(reads[node]) for node in group):
                late.update(group)
                last.append(group)
            else:
                first.append(group)
        return first + last

    @staticmethod
    def region(row: Statement) -> tuple[object, ...]:
        """The key that rows share if their places are drawn together."""
        return (row.code, row.reference, *sorted((key, str(value)) for key, value in row.params.items()))

    def sample(self, row: Statement) -> None:
        """Draw the places of every row of a region at once, clear of everything placed by now."""
        rows = sorted(self.regions[self.region(row)], key=lambda r: r.subject)
        members = {r.subject for r in rows}
        obstacles = [
            box
            for name, box in self.boxes.items()
            if name not in members and name not in self.failed and None not in (box.x, box.y, box.z, box.yaw)
        ]
        reference = self.base if row.reference in (None, BASE) else self.boxes[str(row.reference)]
        spots = ask(row.entry, "sample", [self.boxes[r.subject] for r in rows], reference, row.params, obstacles)
        for index, (member, spot) in enumerate(zip(rows, spots, strict=True)):
            member.params.update(spot=spot, others=[self.boxes[r.subject] for r in rows[:index]])

    def check_determined(self, name: str, rows: list[Statement]) -> None:
        """Report an object without x, y or z; yaw has the documented baseline."""
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
                f"add a row that does: {setters(dof)}",
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
                if "spot" not in row.params and row.entry.sample is not None:
                    self.sample(row)
                results.append((row, ask(row.entry, "resolve", dof, box, reference, row.params)))
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
                    if step > 40:  # it swings to and fro, so half steps are taken
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
        """Report a circle of positions with the rows that close it."""
        rows: dict[str, Statement] = {}
        for position, node in enumerate(circle):
            read = circle[position - 1]
            for row in self.pins[node]:
                if read[0] in (row.reference, row.subject, *row.needs()):
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
        """Report the objects that only wait for others in one finding."""
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
