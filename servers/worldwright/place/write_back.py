"""Write resolved poses back into the plan: each row gets its subject's final pose and what the row contributed."""

from typing import Any

from ..model.plan.committed import TO_CLARIFY
from ..model.plan.plan_text import PlanDocument
from .anchors import CannotResolveError, shown
from .resolution import Resolution
from .vocabulary import ask

Path = tuple[str | int, ...]


def changes(document: PlanDocument, resolution: Resolution) -> list[tuple[Path, Any]]:
    """The edits that give every row its subject's pose; rows that are still TO_CLARIFY get none."""
    placed = {o.name: o for o in resolution.scene.objects}
    found: list[tuple[Path, Any]] = []
    for index, row in enumerate(document.plan.topology.scene_predicates):
        path: Path = ("topology", "scene_predicates", index)
        if row.subject in document.plan.families and path in resolution.rows_at:
            found.append(((*path, "provenance"), _provenance(resolution, path)))
            continue
        if row.subject not in placed or path not in resolution.rows_at or TO_CLARIFY in (row.position, row.orientation):
            continue
        now = placed[row.subject]
        x, y, z = now.position
        z = (
            round(z + resolution.boxes[row.subject].written_shift, 6) + 0.0
        )  # a generated boundary is placed by its floor
        found += [
            ((*path, "position"), {"x": x, "y": y, "z": z}),
            ((*path, "orientation"), {"deg_z": now.deg_z}),
            ((*path, "provenance"), _provenance(resolution, path)),
        ]
    return found


def _provenance(resolution: Resolution, path: Path) -> str:
    """The formulas that a row contributed, or the margin by which it holds if it only demands something.

    A row that places several objects has their poses, since they have no rows of their own.
    """
    rows = resolution.rows_at[path]
    if len(rows) > 1 and resolution.derived.get(path):
        return "; ".join(_pose(resolution, row.subject) for row in rows)
    if formulas := resolution.derived.get(path):
        return "; ".join(formulas)
    try:
        margin = min(
            ask(row.entry, "holds", resolution.boxes[row.subject], resolution.reference(row), row.params)
            for row in rows
            if resolution.measurable(row)
        )
    except CannotResolveError as error:
        return f"sets nothing; cannot hold: {error}"
    return f"sets nothing; holds by {shown(margin)} {rows[0].entry.UNIT}"


def _pose(resolution: Resolution, name: str) -> str:
    placed = resolution.scene[name]
    x, y, z = (shown(v) for v in placed.position)
    return f"{name} at ({x}, {y}, {z}), deg_z {shown(placed.deg_z)}"
