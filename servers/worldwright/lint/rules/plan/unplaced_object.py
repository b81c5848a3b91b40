"""An object has no place.

What it does: looks for every scene object and asset instance among the subjects of `scene_predicates`, in
`body_positions`, or as `body_a` of a geometry relation.

Why is this bad: without a relation there is no pose, and the program would have to invent one.

Use instead: a row in `topology.scene_predicates`, e.g. `PLACE-ON` its support.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP109"
SEVERITY = "error"
ROWS = [
    {"subject": "ramp", "predicate": "PLACE-ON-BASE"},
    {"subject": "crate", "predicate": "PLACE-ON", "object": "ramp"},
]
GOOD: Changes = (
    {},
    {"topology": {"scene_predicates": ROWS, "body_positions": {"mug": {"x": 0, "y": 0, "z": 0.5}}}},
    {
        "topology": {"scene_predicates": ROWS},
        "geometry_relations": [{"relation_name": "spawned_on_top", "body_a": "mug", "body_b": "ramp"}],
    },
)
BAD: Changes = (
    {"topology": {"scene_predicates": ROWS}},
    {
        "assets": [{"name": "mug", "filename": "mug", "count": 2}],
        "topology": {"scene_predicates": [*ROWS, {"subject": "mug_1", "predicate": "PLACE-ON", "object": "ramp"}]},
    },
)
EVIDENCE = Argued("everything without a place is built at the origin, inside everything else without one")


def check(view: PlanView) -> Iterator[Problem]:
    """Check every object; copies made by COPY-GROUP are placed by the group they are in."""
    topology = view.plan.topology
    placed = {row.subject for row in topology.scene_predicates} | set(topology.body_positions)
    placed |= {name for family in placed & set(view.plan.families) for name in view.plan.families[family]}
    placed |= {relation.body_a for relation in view.plan.geometry_relations}
    for row in topology.scene_predicates:
        for value in row.params.values():
            placed |= {
                item for item in (value if isinstance(value, list | tuple) else [value]) if isinstance(item, str)
            }
    for name in view.plan.object_names():
        asset = view.rows[name]
        if name not in placed and asset.name not in placed:
            fix = (
                f"add a row with subject `{name}` to topology.scene_predicates (`worldwright plan complete`: as built)"
            )
            yield view.at(view.place(name), f"`{name}` is not placed", fix)
