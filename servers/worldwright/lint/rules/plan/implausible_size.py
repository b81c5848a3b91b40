"""An object is of a size that only a wrong unit explains.

What it does: looks for sizes above 200 m and below 0.3 mm, in `size` and in `asset_dimensions`.

Why is this bad: the plan is in metres. A mug of 95 is as tall as a tower, and time steps, contacts and cameras are all
chosen for another scale.

Use instead: metres: 95 mm is 0.095.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP117"
SEVERITY = "warning"
ROW = {"name": "ramp", "primitive": "box", "fixed": True, "dynamic": False}
CRATE = {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2], "material": "wood"}
GOOD: Changes = ({}, {"scene_objects": [{**ROW, "size": [100.0, 100.0, 0.02]}, CRATE]})
BAD: Changes = (
    {"asset_dimensions": {"mug": 950.0}},
    {"scene_objects": [{**ROW, "size": [2000, 1000, 200]}, CRATE]},
    {"asset_dimensions": {"mug": 0.0001}},
)
EVIDENCE = Argued("the engine knows no scale; that a mug is not as tall as a tower, only the world tells")
LEAST_M, MOST_M = 3e-4, 200.0


def check(view: PlanView) -> Iterator[Problem]:
    """Check scene objects but endless planes, then asset heights."""
    for index, row in enumerate(view.plan.scene_objects):
        odd = [extent for extent in row.size if not LEAST_M <= extent <= MOST_M]
        if odd and row.primitive != "plane":
            yield view.at(("scene_objects", index, "size"), f"{row.name} measures {odd[0]:g} m", "give sizes in metres")
        for number, part in enumerate(row.parts):
            odd = [extent for extent in part.size if not LEAST_M <= extent <= MOST_M]
            if odd:
                place = ("scene_objects", index, "parts", number, "size")
                yield view.at(place, f"part {part.name} of {row.name} measures {odd[0]:g} m", "give sizes in metres")
    for name, height in view.plan.asset_dimensions.items():
        if not LEAST_M <= height <= MOST_M:
            yield view.at(("asset_dimensions", name), f"{name} is {height:g} m tall", "give heights in metres")
