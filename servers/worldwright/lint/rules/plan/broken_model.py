"""A model that the plan brings in cannot be used as the plan does.

What it does: opens the file of every asset of type `mjcf`, `urdf` or `sculpt`, and compares the names that the plan uses of it
(`initial_motion`, `actuators[].joint`, `motion_expectations`) and the mass that it gives it with what is inside.

Why is this bad: building the world fails there, or moves something else. URDF elements that do not exist are passed over by
the engine in silence: a mistyped tag is a part without a shape.

Use instead: a file beside plan.md or in the catalog, with exactly one root body; its own names, behind the asset's and `_`.
"""

from collections.abc import Iterator
from difflib import get_close_matches

from ....model.errors import PlanError
from ....model.plan.imported import all_of, is_model, is_road, is_sculpt, load, road_box, sculpture
from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP126"
SEVERITY = "error"
GOOD: Changes = ({},)
SCULPTED = {"name": "mug", "filename": "sculpt/mug.py", "type": "sculpt", "size": [0.08, 0.08, 0.1]}
BAD: Changes = (
    {"assets": [SCULPTED], "asset_dimensions": None},
    {"assets": [{"name": "mug", "filename": "no-such-arm.urdf", "type": "urdf"}], "asset_dimensions": None},
    {"assets": [{"name": "mug", "filename": "../../etc/hosts.xml", "type": "mjcf"}], "asset_dimensions": None},
    {"assets": [{"name": "mug", "filename": "mug", "type": "mjcf"}], "asset_dimensions": None},
)
EVIDENCE = Argued("what is not there, or cannot be read, cannot be run")
AGREES = 0.02


def check(view: PlanView) -> Iterator[Problem]:
    """Check each file, then the names and masses that the plan uses of it."""
    plan = view.plan
    for index, row in enumerate(plan.assets):
        if is_model(row) or is_sculpt(row) or is_road(row):
            try:
                (load if is_model(row) else road_box if is_road(row) else sculpture)(row, plan.folder)
            except PlanError as error:
                yield view.at(("assets", index, "filename"), error.cause, error.next_move)
    parameters = plan.simulation_parameters
    declared = {*plan.object_names(), *(j.name for j in plan.topology.joints), *(a.name for a in plan.assets)}
    for instance, row, model in all_of(plan):
        used: list[tuple[str, Place]] = [
            (name, ("simulation_parameters", "initial_motion", name)) for name in parameters.initial_motion
        ]
        used += [(a.joint, ("topology", "actuators", i, "joint")) for i, a in enumerate(plan.topology.actuators)]
        moving: list[tuple[str, Place]] = [
            (name, ("implementation_steps", i, "motion_expectations", k))
            for i, step in enumerate(plan.implementation_steps)
            for k, name in enumerate(step.motion_expectations)
        ]
        asked: list[tuple[str, Place]] = [
            (a.name, ("topology", "actuators", i, "name"))
            for i, a in enumerate(plan.topology.actuators)
            if a.kind == "imported"
        ]
        for kind, known, uses in (
            ("joint", list(model.joints), used),
            ("body", list(model.bodies), moving),
            ("actuator", list(model.actuators), asked),
        ):
            for name, place in uses:
                if name.startswith(f"{instance}_") and name not in declared and name not in known:
                    near = get_close_matches(name, known, n=1)
                    fix = (f"did you mean `{near[0]}`? " if near else "") + f"there are: {', '.join(known) or 'none'}"
                    yield view.at(place, f"{row.filename} has no {kind} `{name}`", fix)
        mass = parameters.masses.get(instance, parameters.masses.get(row.name))
        if mass is not None and abs(mass - model.mass_kg) > AGREES * model.mass_kg:
            message = f"`{instance}` weighs {model.mass_kg:.4g} kg by {row.filename}, not {mass:g} kg"
            yield view.at(
                ("simulation_parameters", "masses"), message, "what brings it in owns its masses: correct one of them"
            )
