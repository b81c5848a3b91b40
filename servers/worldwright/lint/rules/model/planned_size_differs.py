"""A compiled body has another size than the plan gives it.

What it does: compares the box around each body with the plan's `size` (full extents along its own axes), or the height
of an asset with `asset_dimensions`: more than 3 % and 1 mm apart.

Why is this bad: everything that was placed, sized or argued in the plan is about another thing. A factor of two is a
half size taken for a full one.

Use instead: the plan's size; `worldkit.bodies` take full extents, MuJoCo's geoms half of them.
"""

from collections.abc import Iterator

import numpy as np

from ....model.plan.formed import BY_POINTS
from ...compiled.view import ModelView
from ...harm import Measured, model_of
from ...problem import Problem
from ._planned import CART, CART_PLAN, LADLE, LADLE_PLAN, THREE, extent

CODE = "WM151"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE, (CART, CART_PLAN), (LADLE, LADLE_PLAN))
BAD = (
    THREE.replace("size='.2 .15 .1'", "size='.4 .3 .2'"),
    THREE.replace("size='.04 .05'", "size='.04 .1'"),
    (CART.replace("size='.5 .2 .1'", "size='.5 .35 .2'"), CART_PLAN),
)
EVIDENCE = Measured("the crate is eight times as heavy", lambda s: float(model_of(s).body_mass[2]), 50.0, "kg")
SHARE, LEAST_M = 0.03, 1e-3
DERIVED = ("compound", *BY_POINTS)
"""What has no size of its own in the plan."""
MEND = "build it in the plan's size, or {change}"
MEND_POINTS = "its size is that of its law's points at the start, and of their radius: {change}"
"""Nobody builds what shows an author's law: the law's file lays its points, and says by its spacing how large they are drawn."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check scene objects by their three extents (upright or not is the layout's matter), assets by their height, sculptures by all three."""
    assert view.plan is not None
    laws = {
        row.solver.shown_by for row in view.plan.simulation_parameters.interventions if row.solver and row.solver.file
    }
    for row in view.plan.scene_objects:
        body = view.root_named(row.name)
        if body is None or row.primitive == "plane":
            continue
        built, where = extent(view, body), "" if row.primitive in DERIVED or row.deg_x else "size"
        if row.primitive == "sphere" and np.ptp(built) > LEAST_M:
            where = "primitive: ellipsoid, size"
        yield from _compared(view, body, np.array(row.extents), built, where, MEND_POINTS if row.name in laws else MEND)
    for asset in view.plan.assets:
        height = view.plan.asset_dimensions.get(asset.name)
        for name in asset.instances:
            body = view.root_named(name)
            if body is not None and height is not None:
                where = f"asset_dimensions.{asset.name}"
                yield from _compared(view, body, np.array([height]), extent(view, body)[2:], where)
            if body is not None and asset.size is not None:
                yield from _compared(view, body, np.array(asset.size), extent(view, body), "size")


def _compared(
    view: ModelView, body: int, planned: np.ndarray, built: np.ndarray, where: str, fix: str = MEND
) -> Iterator[Problem]:
    apart = np.abs(built - planned)
    if not np.isfinite(built).all() or (apart <= np.maximum(SHARE * planned, LEAST_M)).all():
        return
    words = [" x ".join(f"{v:.4g}" for v in values) for values in (built, planned)]
    ratio = built / planned
    hint = next((f" (all times {f:g})" for f in (2.0, 0.5) if np.allclose(ratio, f, rtol=0.02)), "")
    message = f"{view.name('body', body)} measures {words[0]} m, the plan says {words[1]} m{hint}"
    numbers = ", ".join(f"{v:.4g}" for v in built)
    change = (
        f"write `{where}: {f'[{numbers}]' if len(built) > 1 else numbers}` in the plan" if where else "change the plan"
    )
    yield view.at("body", body, message, fix.format(change=change))
