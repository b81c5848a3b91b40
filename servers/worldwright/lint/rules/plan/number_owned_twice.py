"""A number has two owners.

What it does: finds sizes given a second time (in predicate parameters, or in `asset_dimensions` for a scene object),
masses given for a row and its instances, or for a compound and its parts, and positions given both by `body_positions` and
by predicates.

Why is this bad: when they differ, nobody knows which one is meant, and an edit changes only one of them.

Use instead: sizes in `scene_objects[].size` and `asset_dimensions`; masses once; one way of placing an object.
"""

from collections.abc import Iterator
from functools import cache

from ....model.plan.weights import weight
from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP112"
SEVERITY = "error"
ON = {"subject": "crate", "predicate": "PLACE-ON", "object": "ramp"}
REST = [
    {"subject": "ramp", "predicate": "PLACE-ON-BASE"},
    {"subject": "mug", "predicate": "PLACE-ON", "object": "ramp"},
]
LEADS = {"subject": "crate", "predicate": "GROUP", "params": {"members": ["mug"], "within": 3.0}}
GOOD: Changes = (
    {},
    {"topology": {"scene_predicates": [{**ON, "params": {"gap": 0.01}}, *REST]}},
    {"topology": {"scene_predicates": [LEADS, *REST], "body_positions": {"crate": {"x": 0, "y": 0, "z": 1}}}},
)
SCULPTED = {"name": "mug", "type": "sculpt", "filename": "sculpt/mug.py", "size": [0.08, 0.08, 0.1]}
BAD: Changes = (
    {"assets": [SCULPTED]},
    {"asset_dimensions": {"crate": 0.2}},
    {"topology": {"scene_predicates": [{**ON, "params": {"size": [0.4, 0.3, 0.2]}}, *REST]}},
    {"topology": {"body_positions": {"crate": {"x": 0, "y": 0, "z": 1}}}},
    {
        "assets": [{"name": "mug", "filename": "mug", "count": 2}],
        "simulation_parameters": {"masses": {"mug": 0.3, "mug_1": 0.4}},
    },
    {
        "scene_objects": [
            {"name": "ramp", "primitive": "box", "size": [2.0, 1.0, 0.2], "fixed": True, "dynamic": False},
            {
                "name": "crate",
                "primitive": "compound",
                "parts": [{"name": "lid", "primitive": "box", "size": [0.4, 0.3, 0.2], "mass": 2.0}],
            },
        ],
        "simulation_parameters": {"masses": {"crate": 3.0}},
    },
)
EVIDENCE = Argued("either number simulates; which one was meant, nobody can tell")
SIZES = frozenset({"size", "extents", "dimensions", "radius", "diameter", "width", "depth", "length"})


def check(view: PlanView) -> Iterator[Problem]:
    """Check sizes, masses, positions."""
    plan = view.plan
    for name in plan.asset_dimensions:
        if any(row.name == name for row in plan.scene_objects):
            place: Place = ("asset_dimensions", name)
            yield view.at(place, f"the size of scene object `{name}` is given twice", "keep `size` in scene_objects")
        if any(row.name == name and row.size is not None for row in plan.assets):
            place = ("asset_dimensions", name)
            yield view.at(place, f"the size of `{name}` is given twice", "keep its `size` in assets")
    for index, row in enumerate(plan.topology.scene_predicates):
        for key in SIZES & set(row.params):
            place = ("topology", "scene_predicates", index, "params", key)
            yield view.at(place, f"`{key}` of `{row.subject}` has its owner elsewhere", "sizes live with the object")
        if row.subject in plan.topology.body_positions and row.predicate not in _grouping():
            place = ("topology", "body_positions", row.subject)
            yield view.at(place, f"`{row.subject}` is placed twice", "keep the predicates, or the absolute position")
    for index, item in enumerate(plan.scene_objects):
        if item.parts:
            try:
                weight(plan, item)
            except ValueError as error:
                message = f"the mass of `{item.name}` contradicts those of its parts: {error}"
                yield view.at(
                    ("scene_objects", index, "parts"), message, "give the whole or the parts a mass, or correct one"
                )
    masses = plan.simulation_parameters.masses
    for asset in plan.assets:
        if asset.count > 1 and asset.name in masses:
            for name in set(asset.instances) & set(masses):
                place = ("simulation_parameters", "masses", name)
                yield view.at(place, f"the mass of `{name}` is also given for all `{asset.name}`", "give one of them")


@cache
def _grouping() -> tuple[str, ...]:
    """The predicates that place nothing: they only name a leader and its members."""
    from ....place.tools import vocabulary

    return vocabulary()["grouping"]
