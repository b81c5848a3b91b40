"""An asset has no real-world height.

What it does: compares the rows of `assets` with `asset_dimensions`, which owns their metric scale, and flags heights no
object of a room or a street has.

Why is this bad: catalog meshes carry no scale of their own choosing; without a height there is no size, no mass and no
place to put it.

Use instead: one entry `name: height in metres` per asset row.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP107"
SEVERITY = "error"
GOOD: Changes = ({},)
BAD: Changes = (
    {"asset_dimensions": {"mug": None}},
    {"asset_dimensions": {"mug": 95.0}},
    {"asset_dimensions": {"mug": -0.1}},
)
EVIDENCE = Argued("a mesh has no metric size of its own: any number would compile")


def check(view: PlanView) -> Iterator[Problem]:
    """Check every asset row, then every height."""
    heights = view.plan.asset_dimensions
    for index, row in enumerate(view.plan.assets):
        if row.name not in heights and row.type == "mesh":
            yield view.at(
                ("assets", index),
                f"asset `{row.name}` has no height",
                f"add `- {row.name}: <metres>` to asset_dimensions",
            )
    for name, height in heights.items():
        place = ("asset_dimensions", name)
        if not 0 < height < float("inf"):
            yield view.at(place, f"`{name}` has a height of {height:g} m", "give its real-world height in metres")
        elif not 0.002 <= height <= 60:
            message = f"`{name}` has a height of {height:g} m, which no catalog object has"
            yield view.at(place, message, "give metres, not centimetres or millimetres", severity="warning")
