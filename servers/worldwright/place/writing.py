"""Resolved poses back into the plan: each row of a subject gets its final pose and what the row contributed."""

from typing import Any

from ..model.plan import TO_CLARIFY
from ..model.plan_text import PlanDocument
from .anchors import CannotResolveError, shown
from .engine import Resolution

Path = tuple[str | int, ...]


def changes(document: PlanDocument, resolution: Resolution) -> list[tuple[Path, Any]]:
    """The edits that bind every row to its subject's pose; nothing for rows that are still TO_CLARIFY."""
    placed = {o.name: o for o in resolution.scene.objects}
    rows = {row.path: row for row in resolution.statements}
    found: list[tuple[Path, Any]] = []
    for index, row in enumerate(document.plan.topology.scene_predicates):
        path: Path = ("topology", "scene_predicates", index)
        if row.subject not in placed or path not in rows or TO_CLARIFY in (row.position, row.orientation):
            continue
        now = placed[row.subject]
        x, y, z = now.position
        found += [
            ((*path, "position"), {"x": x, "y": y, "z": z}),
            ((*path, "orientation"), {"deg_z": now.deg_z}),
            ((*path, "provenance"), _provenance(resolution, path)),
        ]
    return found


def _provenance(resolution: Resolution, path: Path) -> str:
    """The formulas a row contributed, or the margin by which it holds when it only demands something."""
    if formulas := resolution.derived.get(path):
        return "; ".join(formulas)
    row = next(row for row in resolution.statements if row.path == path)
    reference = resolution.reference(row)
    try:
        margin = row.entry.holds(resolution.boxes[row.subject], reference, row.params)
    except CannotResolveError as error:
        return f"sets nothing; cannot hold: {error}"
    return f"sets nothing; holds by {shown(margin)} {row.entry.UNIT}"
