"""A moving object has no mass the plan would answer for.

What it does: looks for a mass or a material density for every scene object and sculpture that moves, and for every part of a compound
without a mass as a whole; and for the mass of every `hollow` one, since a shell's density is not its substance's.

Why is this bad: MuJoCo then assumes 1000 kg/m^3, the density of water, for cardboard and steel alike: momentum, impact
and what holds what all follow from it.

Use instead: an entry in `simulation_parameters.masses`, or a `material` with a `density` and its source.
"""

from collections.abc import Iterator

from ....model.plan.imported import is_sculpt
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP108"
SEVERITY = "error"
BOX = {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2]}
RAMP = {"name": "ramp", "primitive": "box", "size": [2, 1, 0.2], "fixed": True, "dynamic": False}
BARBELL = {
    "name": "crate",
    "primitive": "compound",
    "parts": [
        {"name": "bar", "primitive": "cylinder", "size": [0.03, 0.03, 0.4], "deg_y": 90, "mass": 2.0},
        {"name": "plate", "primitive": "sphere", "size": [0.2, 0.2, 0.2], "repeat": {"count": 2, "step": [0.4, 0, 0]}},
    ],
}
GOOD: Changes = (
    {"scene_objects": [RAMP, BARBELL], "simulation_parameters": {"masses": {"crate": 12.0}}},
    {"scene_objects": [RAMP, {**BARBELL, "material": "wood"}]},
    {},
    {"scene_objects": [RAMP, BOX], "simulation_parameters": {"masses": {"crate": 3.0}}},
    {"scene_objects": [RAMP, {**BOX, "visual_only": "a marker"}]},
    {"scene_objects": [RAMP, {**BOX, "hollow": True}], "simulation_parameters": {"masses": {"crate": 3.0}}},
)
HARE = {"name": "hare", "type": "sculpt", "filename": "sculpt/hare.py", "size": [0.4, 0.2, 0.5]}
BAD: Changes = (
    {"assets": [HARE], "asset_dimensions": None},
    {"scene_objects": [RAMP, BARBELL]},
    {"scene_objects": [RAMP, BOX]},
    {"scene_objects": [RAMP, {**BOX, "material": "wood", "hollow": True}]},
    {
        "scene_objects": [RAMP, {**BOX, "material": "wood"}],
        "simulation_parameters": {"materials": {"wood": {"density": None}}},
    },
    {"simulation_parameters": {"masses": {"crate": 0.0}}},
)
EVIDENCE = Argued("the engine would use the density of water without a word; that it is wrong, only a source tells")


def check(view: PlanView) -> Iterator[Problem]:
    """Check moving scene objects (catalog and model files bring their mass), then masses that are none."""
    parameters = view.plan.simulation_parameters
    for name, mass in parameters.masses.items():
        if not 0 < mass < float("inf"):
            yield view.at(
                ("simulation_parameters", "masses", name), f"`{name}` has a mass of {mass:g} kg", "give its mass"
            )
    for index, asset in enumerate(view.plan.assets):
        loose = is_sculpt(asset) and asset.is_dynamic and not asset.fixed
        if loose and not parameters.masses.keys() & {asset.name, *asset.instances} and not _dense(view, asset.material):
            fix = f"add `{asset.name}: <kg>` to simulation_parameters.masses, or give its material a density"
            yield view.at(("assets", index), f"moving sculpture `{asset.name}` has neither mass nor density", fix)
    for index, row in enumerate(view.plan.scene_objects):
        if not view.moves(row) or row.name in parameters.masses:
            continue
        if row.parts:
            yield from _parts(view, index)
            continue
        if row.hollow:
            fix = f"add `{row.name}: <kg>` to simulation_parameters.masses"
            yield view.at(("scene_objects", index), f"hollow object `{row.name}` has no mass", fix)
        elif not _dense(view, row.material):
            fix = f"add `{row.name}: <kg>` to simulation_parameters.masses, or give its material a density"
            yield view.at(("scene_objects", index), f"moving object `{row.name}` has neither mass nor density", fix)


def _parts(view: PlanView, index: int) -> Iterator[Problem]:
    """Parts of a compound without a mass as a whole."""
    row = view.plan.scene_objects[index]
    for number, part in enumerate(row.parts):
        if part.mass is None and part.visual_only is None and not _dense(view, part.material or row.material):
            fix = f"give it `mass` or a material with a density, or all of `{row.name}` a mass in masses"
            message = f"part `{part.name}` of moving object `{row.name}` has neither mass nor density"
            yield view.at(("scene_objects", index, "parts", number), message, fix)


def _dense(view: PlanView, material: str | None) -> bool:
    found = view.plan.simulation_parameters.materials.get(material or "")
    return found is not None and found.density is not None
