"""Bodies overlap before anything moves.

What it does: looks at the contacts of the start (keyframe "start" if there is one): deeper than 1 mm and than 5 % of the
smaller of the two, and than the plan lets two things that belong together (`topology.overlaps`), at most half of the thinner.

Why is this bad: the solver drives them apart within a few steps. Things jump up, fly off, or settle elsewhere than they
were put; the energy comes from nowhere.

Use instead: resolve the layout again (`worldwright place resolve`), or leave a gap of a millimetre: gravity closes it.
"""

import math
from collections.abc import Iterator

from ....model.plan.belonging import Belonging
from ...compiled.view import ModelView
from ...harm import Measured, fastest
from ...problem import Problem

CODE = "WM112"
SEVERITY = "error"
SCOPE = "any"
STACK = (
    "<mujoco><worldbody><geom type='plane' size='5 5 .1'/><body name='crate' pos='0 0 {0}'><freejoint/>"
    "<geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>"
)
GOOD = (STACK.format("0.1"), STACK.format("0.0995"))
BAD = (STACK.format("0.06"),)
EVIDENCE = Measured("the crate jumps", fastest, 0.4, "m/s")
LEAST_M, SHARE = 1e-3, 0.05


def check(view: ModelView) -> Iterator[Problem]:
    """Check the deepest contact of each pair of bodies."""
    names = [view.name("body", body) for body in range(len(view.body_parentid))]
    belonging = Belonging(
        view.plan, {name: names[above] for name, above in zip(names, view.body_parentid, strict=True)}
    )
    worst: dict[tuple[int, int], float] = {}
    for (one, other), depth in zip(view.contact_geom, view.contact_depth, strict=True):
        if one < 0 or other < 0:
            continue
        radii = [float(view.geom_rbound[g]) for g in (one, other) if view.geom_rbound[g] > 0]
        if depth > max(LEAST_M, SHARE * min(radii, default=0.0)):
            bodies = sorted((int(view.geom_bodyid[one]), int(view.geom_bodyid[other])))
            pair = (bodies[0], bodies[1])
            allowed = belonging.allowed_m(names[pair[0]], names[pair[1]])
            if depth > min(allowed, _half_m(view, one), _half_m(view, other)):
                worst[pair] = max(worst.get(pair, 0.0), float(depth))
    for (low, high), depth in worst.items():
        message = f"{view.name('body', high)} starts {depth * 1e3:.1f} mm deep in {view.name('body', low)}"
        yield view.at("body", high, message, "place it clear of the other; a gap of 1 mm closes by itself")


def _half_m(view: ModelView, geom: int) -> float:
    """Half the thickness of a geom, m: the least half extent of its box; inf of a plane."""
    return math.inf if view.geom_rbound[geom] <= 0 else float(view.geom_aabb[geom, 3:].min())
