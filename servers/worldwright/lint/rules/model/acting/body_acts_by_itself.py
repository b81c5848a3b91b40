"""A body is held, driven or braked by a property of its own.

What it does: finds bodies with gravity compensation, mocap bodies, bodies that start asleep, plug-ins and geoms with fluid
forces, unless the world of the plan's draft has them, or the plan names the body in an intervention.

Why is this bad: none of these shows in the motion as a force that somebody applied: a compensated body floats, a mocap body
pushes with any strength, a body that starts asleep hangs in the air.

Use instead: leave them out, or declare an intervention in the plan that names the body.
"""

from collections.abc import Iterator

import numpy as np

from .....model.plan import law_words
from .....model.plan.committed import Plan
from ....compiled.view import ModelView
from ....harm import Measured, height_after
from ....problem import Problem
from ._twins import SOUND, acted_on, changed, holder

CODE = "WM163"
SEVERITY = "error"
SCOPE = "acts"
FLOATS = "spec.body('arm').add_body(name='arm_tip').gravcomp = 1"
GOOD = SOUND
BAD = (
    changed("spec.body('crate').gravcomp = 0.5"),
    changed("spec.worldbody.add_body(name='hand', mocap=True).add_geom(size=(.1, 0, 0))"),
    changed("spec.body('crate').sleep = mujoco.mjtSleepPolicy.mjSLEEP_INIT"),
    changed("spec.geom('crate').fluid_ellipsoid = 1", "spec.option.density = 1.2"),
)
UP = "<mujoco><worldbody><body pos='0 0 1' gravcomp='{}'><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
EVIDENCE = Measured("the body does not fall", height_after, 0.5, "m", bad=UP.format(1), good=UP.format(0))
INIT = 5
"""`mjSLEEP_INIT`."""
FIX = "leave it out, or name the body in an intervention of the plan"


def check(view: ModelView) -> Iterator[Problem]:
    """Check body by body; then plug-ins."""
    assert view.planned is not None and view.plan is not None
    planned = view.planned
    moved, afloat = acted_on(view.plan, "mocap", "pose"), acted_on(view.plan, "force", "solver")
    index = {name: i for i, name in enumerate(planned.texts["names"]["body"])}
    for body, name in enumerate(view.texts["names"]["body"]):
        if body == 0:
            continue
        twin = index.get(name)
        gravcomp = 0.0 if twin is None else float(planned.body_gravcomp[twin])
        excused = _lifted(view, view.plan, {name, holder(view, body)}, body)
        if not np.isclose(view.body_gravcomp[body], gravcomp) and view.moving[body] and not excused:
            share = float(view.body_gravcomp[body])
            yield view.at("body", body, f"{share:.4g} of the weight of {view.name('body', body)} is taken away", FIX)
        guided = not {name, holder(view, body)}.isdisjoint(moved)
        if view.body_mocapid[body] >= 0 and not guided and (twin is None or planned.body_mocapid[twin] < 0):
            yield view.at("body", body, f"{view.name('body', body)} is a mocap body: it moves as it is told", FIX)
        tree = int(view.body_treeid[body])
        first = tree >= 0 and int(view.tree_bodyadr[tree]) == body
        if first and int(view.tree_sleep_policy[tree]) == INIT and "sleep" in (*view.enabled, "sleep"):
            yield view.at("body", body, f"{view.name('body', body)} starts asleep", "let it start awake")
    for geom in np.flatnonzero(np.abs(view.geom_fluid).reshape(len(view.geom_bodyid), -1).any(axis=1)):
        name = holder(view, int(view.geom_bodyid[geom]))
        medium = view.option["density"] or view.option["viscosity"]
        if medium and name not in afloat and not planned.geom_fluid.any():
            yield view.at("geom", int(geom), f"a fluid acts on {name} by a model of its own (fluidshape)", FIX)
    if len(view.plugin) > len(planned.plugin):
        yield view.of_world("a plug-in acts on the world", "leave it out: no field of a plan can speak of it", "plugin")


def _lifted(view: ModelView, plan: Plan, names: set[str], body: int) -> bool:
    """Whether the plan declares a force on the body that is as large as the weight which is taken away."""
    weight = abs(float(view.body_gravcomp[body] * view.body_mass[body])) * float(np.linalg.norm(view.gravity))
    laws = [
        r.law for r in plan.simulation_parameters.interventions if r.kind == "force" and not names.isdisjoint(r.bodies)
    ]
    return any(np.isclose(law_words.limit(law, "force") or 0.0, weight, rtol=0.05) for law in laws)
