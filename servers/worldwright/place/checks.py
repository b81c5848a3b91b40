"""Whether a resolved layout holds: its rows, its overlaps, its supports, and the poses written in the plan."""

from collections.abc import Iterator

from ..model.errors import JobError
from ..model.finding import Finding
from ..model.plan import Orientation, Plan, Position
from ..model.scene import PlacedObject, Scene
from .anchors import TOLERANCE_DEG, TOLERANCE_M, CannotResolveError, shown, wrap
from .extents import fixed_objects
from .overlaps import overlapping
from .reports import CheckReport, RowMargin
from .resolution import Resolution
from .statements import Locate, Problems, Statement
from .world import drawn_only, jointed, simulate

OVERLAP_M = 1e-3
"""Penetration that a contact solver digests without a visible jolt."""


def check(
    plan: Plan, resolution: Resolution, *, file: str = "plan.md", locate: Locate, exact: bool = True
) -> CheckReport:
    """Check a resolved layout.

    Args:
        plan: the plan.
        resolution: its layout, with the findings of the resolver (they come first).
        file, locate: where the plan stands.
        exact: test pairs whose boxes overlap with their real collision shapes (in a process of its own).
    """
    problems = Problems(file, locate)
    margins = sorted(_rows(resolution, problems), key=lambda m: m.margin)
    _below_ground(plan, resolution.scene, problems)
    tested = _overlaps(plan, resolution, problems, exact)
    _supports(plan, resolution, problems)
    _stale(plan, resolution, problems)
    return CheckReport(
        objects=len(resolution.scene.objects),
        rows=len(resolution.statements),
        pairs_tested=tested,
        findings=(*resolution.scene.findings, *problems.findings),
        margins=tuple(margins[:40]),
    )


def _rows(resolution: Resolution, problems: Problems) -> Iterator[RowMargin]:
    """The margin of every row whose objects are placed."""
    for row in resolution.statements:
        subject, reference = resolution.subject(row), resolution.reference(row)
        if subject is None or reference is None or not resolution.measurable(row):
            continue
        unit = row.entry.UNIT
        try:
            margin = float(row.entry.holds(subject, reference, row.params))
        except CannotResolveError as error:
            problems.add("WP301", "row_does_not_hold", f"{row.label}: {error}", error.fix, row.path)
            continue
        if margin < 0:
            tolerance = TOLERANCE_DEG if unit == "deg" else TOLERANCE_M
            problems.add(
                "WP301",
                "row_does_not_hold",
                f"{row.label} is violated by {shown(tolerance - margin)} {unit}",
                "change the row, or the rows that set the coordinates it speaks about",
                row.path,
            )
        yield RowMargin(row=row.label, line=row.line, margin=round(margin, 6), unit=unit)


def _below_ground(plan: Plan, scene: Scene, problems: Problems) -> None:
    fixed = set(fixed_objects(plan))
    for placed in scene.objects:
        low = placed.bounds()[0][2]
        if low < -OVERLAP_M:
            problems.add(
                "WP303",
                "below_ground",
                f"`{placed.name}` reaches {shown(-low)} m below the ground",
                f"raise it: PLACE-ON-BASE puts its lowest point at z = 0 (its centre at {shown(placed.size[2] / 2)} m)",
                _path(plan, placed.name),
                severity="warning" if placed.name in fixed else "error",
            )


def _overlaps(plan: Plan, resolution: Resolution, problems: Problems, exact: bool) -> int:
    """Pairs that penetrate each other; returns how many were looked at closely."""
    scene, hidden, held = resolution.scene, drawn_only(plan), jointed(plan)
    bounds = [(o.name, *o.bounds()) for o in scene.objects if o.name not in hidden]
    pairs = [p for p in overlapping(bounds, deeper_than_m=OVERLAP_M) if not (p[0] in held and p[1] in held)]
    if not pairs:
        return 0
    if exact:
        names = {name for pair in pairs for name in pair[:2]}
        close = {pair[:2] for pair in pairs}
        try:
            touching = simulate(plan, scene, only=names, loose=True)["contacts"]
        except JobError as error:
            problems.add("WP302", "overlap", f"overlaps could not be tested exactly: {error.cause}", error.next_move)
        else:
            pairs = [(a, b, depth) for a, b, depth in touching if (a, b) in close and depth > OVERLAP_M]
    for first, second, depth in pairs:
        rows = [row for row in resolution.statements if row.subject in (first, second)]
        problems.add(
            "WP302",
            "overlap",
            f"`{first}` and `{second}` penetrate each other by {shown(depth)} m",
            f"move one of them by {shown(depth)} m or more: {'; '.join(map(str, rows[:4])) or 'see body_positions'}",
            _path(plan, second),
        )
    return len({pair[:2] for pair in overlapping(bounds, deeper_than_m=OVERLAP_M)})


def _supports(plan: Plan, resolution: Resolution, problems: Problems) -> None:
    """Loose objects that nothing holds when the world is let go."""
    held, hidden = jointed(plan), drawn_only(plan)
    movers = set(plan.movers())
    for placed in resolution.scene.objects:
        if placed.fixed or placed.name in held or placed.name in hidden or placed.supported_by:
            continue
        drop, below = _drop(placed, resolution.scene)
        if drop <= TOLERANCE_M:
            continue
        expected = placed.name in movers
        problems.add(
            "WP304",
            "unsupported",
            f"`{placed.name}` starts {shown(drop)} m above {below} and falls",
            "nothing to do: motion_expectations names it"
            if expected
            else "name it in motion_expectations if it should fall; else PLACE-ON something, or `fixed: true`",
            _path(plan, placed.name),
            severity="info" if expected else "warning",
        )


def _drop(placed: PlacedObject, scene: Scene) -> tuple[float, str]:
    """How far below an object's lowest point the next top face under its centre is, and whose."""
    low = placed.bounds()[0][2]
    best, name = 0.0, "the ground"
    x, y, _ = placed.position
    for other in scene.objects:
        if other.name == placed.name:
            continue
        (x0, y0, _), (x1, y1, top) = other.bounds()
        if x0 <= x <= x1 and y0 <= y <= y1 and best < top <= low + TOLERANCE_M:
            best, name = top, f"`{other.name}`"
    return low - best, name


def _stale(plan: Plan, resolution: Resolution, problems: Problems) -> None:
    """Poses in the plan that are not those its rows give."""
    placed = {o.name: o for o in resolution.scene.objects}
    for index, row in enumerate(plan.topology.scene_predicates):
        if row.subject not in placed or not isinstance(row.position, Position):
            continue
        now = placed[row.subject]
        x, y, z = now.position
        given = (x, y, z + resolution.boxes[row.subject].written_shift)
        away = max(abs(a - b) for a, b in zip(row.position.vector, given, strict=True))
        turned = abs(wrap(row.orientation.deg_z - now.deg_z)) if isinstance(row.orientation, Orientation) else 0.0
        if away > 2e-6 or turned > 2e-6:
            problems.add(
                "WP305",
                "stale_pose",
                f"the pose written for `{row.subject}` is {shown(away)} m and {shown(turned)} deg from what "
                "its rows give",
                "run `worldwright place resolve` again: rows own poses, the numbers are written from them",
                ("topology", "scene_predicates", index, "position"),
                severity="warning",
            )


def _path(plan: Plan, name: str) -> tuple[str | int, ...]:
    """The first row about an object."""
    for index, row in enumerate(plan.topology.scene_predicates):
        if row.subject == name:
            return ("topology", "scene_predicates", index)
    return ("topology",)


def flagged(findings: tuple[Finding, ...], names: list[str]) -> dict[str, str]:
    """The worst severity that a finding names each object with."""
    worst: dict[str, str] = {}
    for finding in findings:
        for name in names:
            if finding.severity != "info" and (
                f"`{name}`" in finding.message or finding.message.startswith(f"{name} ")
            ):
                worst[name] = "error" if "error" in (finding.severity, worst.get(name)) else "warning"
    return worst


__all__ = ["OVERLAP_M", "Statement", "check", "flagged"]
