"""Where does everything go, and why? The public functions of this server."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.files import write_atomic

from ..expose import Positional, reads
from ..model.errors import NotFoundError, PlanError
from ..model.evidence.run import Run, sha256_file
from ..model.finding import Finding
from ..model.picture import Illustrated, Picture
from ..model.plan.committed import Plan
from ..model.plan.layout import Scene
from ..model.plan.plan_edit import edit
from ..model.plan.plan_text import PlanDocument, read_plan
from . import built_world, checks, engine, explaining, picture_given, settling, start, write_back
from .placement_results import CheckReport, Drawing, Explanation, Layout, Reckoned, SettleReport

PlanPath = Annotated[Path, Field(description="The plan.md, its run folder, or the run's name.")]


def resolve(
    plan: PlanPath,
    write: Annotated[bool, Field(description="Write poses and provenance back into the plan's rows.")] = True,
    image: Annotated[
        Path | None, Field(description="A picture the person gave: kept beside the plan as reference.*")
    ] = None,
) -> Layout:
    """Turn the plan's placement rows into numeric poses.

    Applies scene_predicates, geometry_relations and body_positions in dependency order on bounding-box anchors: z up,
    +X front, centres, metres, degrees. Nothing is assumed: an axis that no row sets, rows that disagree, cycles and
    unknown names are findings. When every object has a pose, each row in plan.md gets it; nothing else changes.
    """
    document = _read(plan)
    if image is not None:
        picture_given.keep(image, Path(document.file).parent)
    resolution = _resolve(document)
    text = document.text
    if write and resolution.scene.ok:
        text = edit(document, write_back.changes(document, resolution))
    written = text != document.text
    if written:
        _save(document, text, "resolve")
    return Layout(
        objects=resolution.scene.objects,
        cameras=resolution.scene.cameras,
        findings=resolution.scene.findings,
        plan=document.file,
        written=written,
        at_start=tuple(start.told(document.plan, resolution.scene)),
    )


@reads
def check(plan: PlanPath) -> CheckReport:
    """Check that the resolved layout holds.

    Measures every row (signed margin in metres or degrees), finds objects that penetrate each other (boxes first, then
    the exact collision shapes), reach below the ground, start in mid-air, and poses in the plan that are older than
    its rows. Tells how slack each rope is at the start, and what the start angles of joints put inside something.
    Changes nothing.
    """
    document = _read(plan)
    built = built_world.find(Path(document.file))
    return checks.check(document.plan, _resolve(document), file=document.file, locate=document.line_of, built=built)


def stale_poses(plan: Path) -> list[Finding]:
    """The poses written in a plan that its rows no longer give, as errors. For other servers, no tool.

    Raises:
        PlanError: it cannot be read.
    """
    document = _read(plan)
    only = (checks.stale.check,)
    report = checks.check(
        document.plan, _resolve(document), file=document.file, locate=document.line_of, exact=False, only=only
    )
    return [found for found in report.findings if found.code == "WP305" and found.severity == "error"]


def settle(
    plan: PlanPath,
    duration_s: Annotated[float, Field(gt=0, le=10, description="Simulated seconds to let go for.")] = 1.5,
    write: Annotated[
        bool, Field(description="Write the settled displacements into the plan, if all are small.")
    ] = False,
    tolerance_m: Annotated[
        float, Field(gt=0, le=settling.MOST_M, description="Largest displacement to write, m.")
    ] = 0.005,
    tolerance_deg: Annotated[
        float, Field(gt=0, le=settling.MOST_DEG, description="Largest turn or tilt to write.")
    ] = 1.0,
) -> SettleReport:
    """Let the layout go in a short physics pre-roll and report how far each object drops, slides and tilts.

    No initial motion, no control; objects on joints stay where they are. Objects that motion_expectations names may
    move; any other that does not stay is a finding that says what moved. With `write`, and when everything else stays within
    the tolerance, displacements go into topology.settled, which resolve adds to its poses; otherwise nothing is written.
    """
    document = _read(plan)
    resolution = _resolve(document)
    _need_all(document, resolution)
    report = settling.settle(
        document.plan, resolution.scene, file=document.file, locate=document.line_of, duration_s=duration_s
    )
    if write and report.ok:
        report = _write_settled(document, report, tolerance_m, tolerance_deg)
    return report.model_copy(update={"objects": report.objects[:60]})


def _write_settled(
    document: PlanDocument, report: SettleReport, tolerance_m: float, tolerance_deg: float
) -> SettleReport:
    """Write the displacements into the plan, or report what moved too far."""
    found, too_far = settling.offsets(document.plan, report, tolerance_m, tolerance_deg)
    if too_far:
        finding = Finding(
            code="WP323",
            name="beyond_tolerance",
            severity="error",
            message=f"nothing was written: {'; '.join(too_far[:6])}; the tolerance is {tolerance_m:g} m and {tolerance_deg:g} deg",
            fix="correct the rows so that it starts at rest, name it in motion_expectations, or allow a larger tolerance",
            file=document.file,
            line=document.line_of("topology"),
            section="topology",
        )
        return report.model_copy(update={"findings": (*report.findings, finding)})
    before = {name: offset.model_dump(exclude_defaults=True) for name, offset in document.plan.topology.settled.items()}
    after = {name: value for name, value in {**before, **found}.items() if value}
    if after == before:
        return report
    _save(document, edit(document, [(("topology", "settled"), after)]), "settle")
    again = _read(Path(document.file))
    _save(again, edit(again, write_back.changes(again, _resolve(again))), "resolve")
    return report.model_copy(update={"written": tuple(found)})


@reads
def explain(
    plan: PlanPath,
    object: Annotated[str, Field(description="Name of the object to explain.")],
) -> Explanation:
    """Say why an object is where it is: the chain of rows and formulas, with numbers, from the base to the object."""
    document = _read(plan)
    resolution = _resolve(document)
    if object not in resolution.boxes:
        names = document.plan.object_names()
        about = [f for f in resolution.scene.findings if object in f.message]
        raise NotFoundError(
            f"`{object}` has no pose" if object in names else f"there is no object `{object}`",
            place=document.file,
            next_move=about[0].fix if about else f"known: {', '.join(names)}",
        )
    return explaining.explain(document.plan, resolution, object)


@reads
def draw(
    plan: PlanPath,
    out: Annotated[Path | None, Field(description="PNG file to write the picture to.")] = None,
) -> Illustrated:
    """Draw the layout: seen from above and from the side on one scale, labelled, fronts as arrows, problems in red.

    Shows what moves and holds, too: joints with their axis, ropes (sagging by their slack) and springs, velocities and swung
    poses at the start in blue, and where cameras stand with how wide they see.
    """
    from .drawing import sheet

    document = _read(plan)
    resolution = _resolve(document)
    report = checks.check(document.plan, resolution, file=document.file, locate=document.line_of)
    picture = sheet(document.plan, resolution, report.findings)
    if out is not None:
        write_atomic(out, picture)
    placed = {o.name for o in resolution.scene.objects}
    data = Drawing(
        out=str(out or ""),
        objects=len(placed),
        unplaced=tuple(n for n in document.plan.object_names() if n not in placed),
        findings=report.findings[:40],
    )
    return Illustrated(data, (Picture(picture, f"Layout of {document.plan.title or document.file}"),))


@reads
def reckon(
    expressions: Annotated[
        list[str],
        Field(description="`name = expression`, in order; later ones may use earlier names. Empty: list the forms."),
        Positional(),
    ] = [],  # noqa: B006 (read only)
    plan: Annotated[
        Path | None, Field(description="A plan, run folder or run: its gravity is g, its constants are known.")
    ] = None,
) -> Reckoned:
    """Reckon what should happen: evaluate sums like `v = sqrt(2*g*h)`, then `t = v/g`, in SI units.

    Knows g, pi, math functions (sin takes radians) and closed forms, the same that the scan measures by: fall_time, fall_speed,
    flight_time, flight_range, bounce_height, pendulum_period, body_pendulum_period, spring_period, spring_launch_speed,
    slope_acceleration, rolling_acceleration, sliding_distance, rolling_distance, tipping_angle, tipping_force,
    collision_speed, precession_rate, inertia_ball. Without expressions it lists all with their arguments. A comparison
    (`mu > w/h`) comes to 1 or 0.
    """
    from . import reckoning

    document = None if plan is None else _read(plan)
    if document is None:
        return reckoning.reckon(expressions)
    return reckoning.reckon(expressions, document.plan, document.file)


def laid_out(plan: Plan) -> Scene:
    """For other servers (no tool): the layout of a plan in memory, every object with its pose, and the findings."""
    return engine.resolve(plan).scene


def _save(document: PlanDocument, text: str, action: str) -> None:
    """Write a plan, and note it in its run's journal."""
    path = Path(document.file)
    write_atomic(path, text.encode())
    if path.name == "plan.md":
        Run(path.parent).log("place", action, plan_sha256=sha256_file(path))


def _read(plan: Path) -> PlanDocument:
    path = Path(plan)
    return read_plan(path if path.is_file() or path.suffix == ".md" else Run.find(path).plan)


def _resolve(document: PlanDocument) -> engine.Resolution:
    return engine.resolve(document.plan, file=document.file, locate=document.line_of)


def _need_all(document: PlanDocument, resolution: engine.Resolution) -> None:
    if len(resolution.scene.objects) < len(document.plan.object_names()):
        raise PlanError(
            "the layout cannot be resolved yet",
            findings=resolution.scene.findings,
            place=document.file,
            next_move="fix what `worldwright place resolve` names",
        )


def vocabulary() -> dict[str, tuple[str, ...]]:
    """The `predicates` and `relations` that a plan may use, in order, and those `grouping` that place nothing.

    It serves the other servers and is no tool by itself.
    """
    from .vocabulary import PREDICATES, RELATIONS

    return {
        "predicates": tuple(sorted(PREDICATES)),
        "relations": tuple(sorted(RELATIONS)),
        "grouping": tuple(code for code, entry in PREDICATES.items() if entry.GROUPS and not entry.COPIES),
    }


TOOLS = (resolve, check, settle, explain, draw, reckon)
