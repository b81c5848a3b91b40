"""A body of the plan is not drawn, or is drawn as next to nothing.

What it does: compares what is drawn of each of the plan's objects, opaquely enough to be seen (alpha of 0.2 or more), with what
the plan's draft draws of it: it has to be at least a quarter as long. Flexes and skins count as drawn.

Why is this bad: the pictures then show something else in its place, a static twin or a decoration, and nobody sees what happened
to the body that the claims are about; a speck on a clear body passes for a drawn one.

Use instead: draw it. An object that nobody should see, such as a stop, gets a look of clear acrylic in the plan.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np

from worldkit.filming.film_bounds import SEEN

from ....compiled.view import ModelView
from ....harm import Measured, outcome_of
from ....problem import Problem
from ._twins import SOUND, changed, holder

CODE = "WM174"
SEVERITY = "error"
SCOPE = "acts"
CLEAR = "[setattr(g, 'material', '') or setattr(g, 'rgba', (1, 0, 0, {})) for g in spec.body('crate').geoms]"
DOT = "spec.body('crate').add_geom(size=(.001, 0, 0), contype=0, conaffinity=0, mass=0)"
BOX = (
    "spec.body('crate').add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.2, .15, .1), contype=0, conaffinity=0, mass=0)"
)
OWN = "[setattr(g, 'rgba', {}) for g in spec.body('crate').geoms]"
PANE = (
    "spec.add_material(name='pane', rgba=(1, 1, 1, 0))",
    "[setattr(g, 'material', 'pane') for g in spec.body('crate').geoms]",
)
"""A clear material, over which a colour of its own wins."""
GOOD = (*SOUND, changed(CLEAR.format(0), BOX), changed(CLEAR.format(0.25)), changed(*PANE, OWN.format("(1, 0, 0, 1)")))
BAD = (
    changed(CLEAR.format(0)),
    changed(CLEAR.format(0.1)),
    changed(CLEAR.format(0), DOT),
    changed(*PANE),
    changed(OWN.format("(1, 0, 0, 0.1)")),
    changed("[setattr(g, 'group', 4) for g in spec.body('crate').geoms]"),
)
LEAST = 0.25
"""Of the plan's length, so much is drawn at least."""
FIX = "draw it as the plan says; what is drawn in its place shows nothing of it"


def check(view: ModelView) -> Iterator[Problem]:
    """Check each object of the plan that the plan's own world draws."""
    planned, plan = view.planned, view.plan
    assert planned is not None and plan is not None
    here, there = _by_name(view), _by_name(planned)
    others = {holder(view, int(body)) for body in (*view.flex_vertbodyid, *np.flatnonzero(view.skinned))}
    others |= {row.name for row in plan.scene_objects if row.visual_only}  # a law may show it in a way of its own
    for name in plan.object_names():
        body = view.root_named(name)
        wanted = drawn_m(planned, there.get(name, []))
        if body is None or name in others or wanted <= 0:
            continue
        long = drawn_m(view, here.get(name, []))
        if long < LEAST * wanted:
            said = f"only {long:.2g} m of it are" if long else "none of it is"
            yield view.at("body", body, f"{name} is {wanted:.2g} m long, and {said} drawn so that it is seen", FIX)


def _by_name(view: ModelView) -> dict[str, list[int]]:
    """The geoms of each thing of the plan, in a world."""
    found: dict[str, list[int]] = {}
    for geom, body in enumerate(view.geom_bodyid.tolist()):
        found.setdefault(holder(view, body), []).append(geom)
    return found


def drawn_m(view: ModelView, geoms: list[int]) -> float:
    """The longest side, m, of the box around those of some geoms that can be seen; planes have none."""
    corners = [np.zeros((0, 3))]
    for geom in geoms:
        if view.visible[geom] and view.geom_alpha[geom] >= SEEN and view.geom_kind[geom] != "plane":
            box = view.geom_aabb[geom].reshape(2, 3)
            local = box[0] + box[1] * np.array(list(product((-1, 1), repeat=3)))
            corners.append(local @ view.geom_xmat[geom].T + view.geom_xpos[geom])
    points = np.concatenate(corners)
    return float(np.ptp(points, axis=0).max()) if len(points) else 0.0


def _crate_m(source: str) -> float:
    view = ModelView(outcome_of(source))
    return drawn_m(view, np.flatnonzero(view.geom_bodyid == view.root_named("crate")).tolist())


EVIDENCE = Measured("nobody sees the crate", _crate_m, 0.3, "m", bad=2)
