"""The poses written in the plan are those that its rows give."""

from ...model.plan import Orientation, Position
from ..anchors import shown, wrap
from .layout import Layout


def check(layout: Layout) -> None:
    """WP305 for a written pose that is older than its rows."""
    for index, row in enumerate(layout.plan.topology.scene_predicates):
        now = layout.placed.get(row.subject)
        if now is None or not isinstance(row.position, Position):
            continue
        x, y, z = now.position
        given = (x, y, z + layout.resolution.boxes[row.subject].written_shift)
        away = max(abs(a - b) for a, b in zip(row.position.vector, given, strict=True))
        turned = abs(wrap(row.orientation.deg_z - now.deg_z)) if isinstance(row.orientation, Orientation) else 0.0
        if away > 2e-6 or turned > 2e-6:
            layout.problems.add(
                "WP305",
                "stale_pose",
                f"the pose written for `{row.subject}` is {shown(away)} m and {shown(turned)} deg from what "
                "its rows give",
                "run `worldwright place resolve` again: rows own poses, the numbers are written from them",
                ("topology", "scene_predicates", index, "position"),
                severity="warning",
            )
