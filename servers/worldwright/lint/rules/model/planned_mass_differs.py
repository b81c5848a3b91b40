"""A compiled body weighs something else than the plan says.

What it does: compares the mass of each body, with all it carries, with the plan's `masses`, or with those of a compound's
parts: more than 2 % apart.

Why is this bad: every collision and every load comes out differently. Geoms that are only drawn weigh as much as any,
unless their mass is zero.

Use instead: `mass=` on one geom and `mass=0` on those that are only drawn.
"""

from collections.abc import Iterator

from ....model.plan.committed import Plan
from ....model.plan.weights import weight
from ...compiled.view import ModelView
from ...harm import Measured, model_of
from ...problem import Problem
from ._planned import CART, CART_PLAN, THREE, parts

CODE = "WM154"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE, (CART, CART_PLAN))
BAD = (
    THREE.replace("mass='.35'/>", "mass='.35'/><geom size='.04' contype='0' conaffinity='0'/>"),
    THREE.replace("mass='.35'", "mass='350'"),
    (CART.replace("mass='10'", "mass='12'"), CART_PLAN),
)
EVIDENCE = Measured("what is only drawn adds its weight", lambda s: float(model_of(s).body_mass[3]), 0.1, "kg")
SHARE = 0.02


def check(view: ModelView) -> Iterator[Problem]:
    """Check every mass of the plan; a row's mass is that of each of its instances."""
    assert view.plan is not None
    instances = {a.name: a.instances for a in view.plan.assets}
    for row, planned in (*view.plan.simulation_parameters.masses.items(), *_compound_masses(view.plan)):
        for name in instances.get(row, (row,)):
            body = view.root_named(name)
            if body is None or not view.moving[body]:
                continue
            built = float(view.body_subtreemass[body] - sum(view.body_subtreemass[part] for part in parts(view, body)))
            if abs(built - planned) > SHARE * planned:
                message = f"{name} weighs {built:.4g} kg, the plan says {planned:.6g} kg"
                yield view.at("body", body, message, "give the mass to one geom, and none to what is only drawn")


def _compound_masses(plan: Plan) -> Iterator[tuple[str, float]]:
    """Compounds that weigh what their parts do."""
    for row in plan.scene_objects:
        if row.parts and row.name not in plan.simulation_parameters.masses:
            yield row.name, weight(plan, row).mass_kg
