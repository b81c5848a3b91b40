"""A moving object has no mass the plan would answer for.

What it does: looks for a mass or a material density for every scene object that moves.

Why is this bad: MuJoCo then assumes 1000 kg/m^3, the density of water, for cardboard and steel alike: momentum, impact
and what holds what all follow from it.

Use instead: an entry in `simulation_parameters.masses`, or a `material` with a `density` and its source.
"""

from collections.abc import Iterator

from ...case import Changes
from ...plan_view import PlanView
from ...problem import Problem
from ...proof import Argued

CODE = "WP108"
SEVERITY = "error"
BOX = {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2]}
RAMP = {"name": "ramp", "primitive": "box", "size": [2, 1, 0.2], "fixed": True, "dynamic": False}
GOOD: Changes = (
    {},
    {"scene_objects": [RAMP, BOX], "simulation_parameters": {"masses": {"crate": 3.0}}},
    {"scene_objects": [RAMP, {**BOX, "visual_only": "a marker"}]},
)
BAD: Changes = (
    {"scene_objects": [RAMP, BOX]},
    {
        "scene_objects": [RAMP, {**BOX, "material": "wood"}],
        "simulation_parameters": {"materials": {"wood": {"density": None}}},
    },
    {"simulation_parameters": {"masses": {"crate": 0.0}}},
)
EVIDENCE = Argued("the engine would use the density of water without a word; that it is wrong, only a source tells")


def check(view: PlanView) -> Iterator[Problem]:
    """Moving scene objects (assets bring the catalog's mass), then masses that are none."""
    parameters = view.plan.simulation_parameters
    for name, mass in parameters.masses.items():
        if not 0 < mass < float("inf"):
            yield view.at(
                ("simulation_parameters", "masses", name), f"`{name}` has a mass of {mass:g} kg", "give its mass"
            )
    for index, row in enumerate(view.plan.scene_objects):
        if not view.moves(row) or row.name in parameters.masses:
            continue
        material = parameters.materials.get(row.material or "")
        if material is None or material.density is None:
            fix = f"add `{row.name}: <kg>` to simulation_parameters.masses, or give its material a density"
            yield view.at(("scene_objects", index), f"moving object `{row.name}` has neither mass nor density", fix)
