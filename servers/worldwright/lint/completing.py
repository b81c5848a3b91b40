"""Completing a plan from the world that its program builds: what is claimed stays, what else is there is written down."""

from pathlib import Path

from ..model.errors import GateError, NotFoundError
from ..model.evidence.run import Run, sha256_file
from ..model.finding import Finding
from ..model.frozen import Frozen
from ..model.plan.committed import Plan
from ..model.plan.plan_rows import completed
from ..model.plan.plan_text import read_plan


class Completed(Frozen):
    """What was written into a plan from the built world, and what could not be."""

    run: str
    objects: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    materials: tuple[str, ...] = ()
    placed: tuple[str, ...] = ()
    """Objects whose place is the program's, new ones included."""
    left: tuple[str, ...] = ()
    """What the program built and no row of a plan can say, each with the next move."""
    findings: tuple[Finding, ...] = ()
    """Where the built world is not what the completed plan says; nothing of that was overwritten."""
    written: bool = False
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Nothing is left over, and nothing differs from what the plan states."""
        return not self.left and not any(finding.severity == "error" for finding in self.findings)

    def text(self) -> str:
        """What was added, what was not, and the next command."""
        lines = [f"{self.run}: " + ("plan.md completed from the built world" if self.written else "nothing to add")]
        lines += [
            f"  {what}: {', '.join(names)}"
            for what, names in (
                ("objects", self.objects),
                ("joints", self.joints),
                ("materials", self.materials),
                ("placed as built", self.placed),
            )
            if names
        ]
        lines += [f"  left to you: {one}" for one in self.left]
        lines += [str(finding) for finding in self.findings]
        return "\n".join([*lines, f"next: {self.next_move}"])


def complete(run: Run, wall_s: float) -> Completed:
    """Build the program's world in the sandbox and write into plan.md what it has and the plan does not name.

    Raises:
        NotFoundError: there is no program.
        GateError: the program makes no world.
        PlanError: the plan cannot be read.
    """
    from . import engine
    from . import source as sources
    from .compiled import as_rows, fetch, planned
    from .compiled.view import ModelView
    from .program_view import Program

    if not run.program.is_file():
        raise NotFoundError(
            "there is no program whose world could complete the plan",
            place=str(run.program),
            next_move=f"write simulation.py, or draft it: worldwright go {run.folder}",
        )
    before = read_plan(run.plan)
    outcome = fetch.world(run.program, wall_s=wall_s)
    if outcome.status != "compiled":
        raise GateError(
            f"the program makes no world: {outcome.message or outcome.status}",
            place=f"{run.program}:{outcome.line}" if outcome.line else str(run.program),
            next_move=f"worldwright lint check-program {run.program}",
        )
    twin = planned.world(before.plan, wall_s)
    view = ModelView(
        outcome, None, before.plan, ModelView(twin, None, before.plan) if twin.status == "compiled" else None
    )
    rows = as_rows.rows(view, before.plan)
    after = completed(
        before,
        {
            ("scene_objects",): rows.objects,
            ("topology", "joints"): rows.joints,
            ("geometry_relations",): rows.places,
            ("simulation_parameters", "inferred"): [f"masses.{name}" for name in rows.masses],
        },
        {("simulation_parameters", "materials"): rows.materials, ("simulation_parameters", "masses"): rows.masses},
    )
    changed = after.text != before.text
    if changed:
        from worldkit.files import write_atomic

        write_atomic(run.plan, after.text.encode())
        run.log("lint", "plan", completed=[row["name"] for row in rows.objects], plan_sha256=sha256_file(run.plan))
    plan: Plan = after.plan.read_from(run.folder)
    program = Program(sources.read(run.program), plan, True)
    found = engine.check_world(program, outcome, planned.world(plan, wall_s))
    return Completed(
        run=run.name,
        objects=tuple(row["name"] for row in rows.objects),
        joints=tuple(row["name"] for row in rows.joints),
        materials=tuple(rows.materials),
        placed=tuple(row["body_a"] for row in rows.places),
        left=tuple(rows.left),
        findings=tuple(finding for finding in found if finding.severity == "error"),
        written=changed,
        next_move=_next(run.folder, rows.left, changed),
    )


def _next(folder: Path, left: list[str], changed: bool) -> str:
    if left:
        return "mend what is left to you, then complete again"
    check = f"`worldwright place check {folder}`, then `worldwright go {folder}`"
    return f"{check}: the plan is approved as it now stands" if changed else f"worldwright go {folder}"
