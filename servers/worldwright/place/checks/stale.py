"""The poses written in the plan are those that its rows give."""

import math

from ...model.plan.committed import Orientation, Position
from ..anchors import shown, wrap
from ..settling import MOST_DEG, MOST_M
from .checked_layout import CheckedLayout

PLACED_M, PLACED_DEG = 5e-3, 1.0
"""A program that stands farther from the written pose is not the planned world (`WM152`): such a plan is neither approved nor run."""


def check(layout: CheckedLayout) -> None:
    """Report WP305 for a written pose that is older than its rows."""
    for name, offset in layout.plan.topology.settled.items():
        far = math.hypot(offset.x, offset.y, offset.z)
        if name not in layout.plan.object_names() or far > MOST_M or abs(offset.deg_z) > MOST_DEG:
            layout.problems.add(
                "WP305",
                "stale_pose",
                f"topology.settled moves `{name}` by {shown(far)} m and {shown(abs(offset.deg_z))} deg: settling writes "
                f"objects of the plan, and at most {MOST_M} m and {MOST_DEG} deg",
                "remove it; rows place, `worldwright place settle --write` writes only what settles",
                ("topology", "settled", name),
            )
    for index, row in enumerate(layout.plan.topology.scene_predicates):
        now = layout.placed.get(row.subject)
        if now is None or not isinstance(row.position, Position):
            continue
        x, y, z = now.position  # settling added this
        given = (x, y, z + layout.resolution.boxes[row.subject].written_shift)
        away = max(abs(a - b) for a, b in zip(row.position.vector, given, strict=True))
        turned = abs(wrap(row.orientation.deg_z - now.deg_z)) if isinstance(row.orientation, Orientation) else 0.0
        if away > 2e-6 or turned > 2e-6:
            layout.problems.add(
                "WP305",
                "stale_pose",
                f"the pose written for `{row.subject}` is {shown(away)} m and {shown(turned)} deg from what "
                "its rows give",
                f"`worldwright place resolve {layout.problems.file}`: rows own poses, the numbers are written from them",
                ("topology", "scene_predicates", index, "position"),
                severity="error" if away > PLACED_M or turned > PLACED_DEG else "warning",
            )
