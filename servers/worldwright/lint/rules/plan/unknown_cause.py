"""An objective's cause names nothing that the plan has.

What it does: resolves every `cause` of an objective: objects, asset rows, joints, tendons, actuators, `gravity`, `wind`,
`control`, or `kind:target` of an intervention; of a body also `.velocity` (the one it starts with) and `.weight`. Several may
be joined by `+`.

Why is this bad: the causal audit takes the cause away and looks whether the effect vanishes. What is not there cannot be
taken away, so the objective stays without that proof.

Use instead: the plan's own names; declare an intervention before naming it as a cause.
"""

from collections.abc import Iterator
from difflib import get_close_matches

from ....model.plan.imported import all_of
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP115"
SEVERITY = "warning"
CLAIM = {"claim": "It slides.", "expect": [{"moves": {"body": "crate", "min_m": 0.1}}]}
PUSH = {"interventions": [{"kind": "force", "bodies": ["crate"], "law": "F = 3 N", "source": "catalogue of the winch"}]}


def _tow(name: str) -> dict:
    return {"name": name, "ends": [{"body": "crate"}, {"offset": [3.0, 0.0, 0.2]}], "slack": 0.5}


GOOD: Changes = (
    {"objectives": [{**CLAIM, "cause": "gravity"}]},
    {"objectives": [{**CLAIM, "cause": ["ramp + gravity"]}]},
    {"objectives": [{**CLAIM, "cause": "crate.velocity"}]},
    {"objectives": [{**CLAIM, "cause": "force:crate"}], "simulation_parameters": PUSH},
    {"objectives": [{**CLAIM, "cause": "tow+tow_2"}], "topology": {"tendons": [_tow("tow"), _tow("tow_2")]}},
)
BAD: Changes = (
    {"objectives": [{**CLAIM, "cause": "slope"}]},
    {"objectives": [{**CLAIM, "cause": "force:crate"}]},
    {"objectives": [{**CLAIM, "cause": ["gravity + wnid"]}]},
    {"objectives": [{**CLAIM, "cause": "crate.colour"}]},
    {"objectives": [{**CLAIM, "cause": "gravity.velocity"}]},
)
EVIDENCE = Argued("no run can be made without a thing that is not in it; the audit refuses the name")
WORLD = ("gravity", "wind", "control")
ASPECTS = ("velocity", "weight")
"""Properties that can be taken away from a body while the body stays."""
BUILT = ("actuator", "constraint", "equality", "tendon", "body", "geom", "joint", "flex")
"""Kinds that only the program declares: `actuator:winch` is believed."""


def check(view: PlanView) -> Iterator[Problem]:
    """Check each part of each cause."""
    plan = view.plan
    bodies = {*plan.object_names(), *(a.name for a in plan.assets)}
    known = {*WORLD, *plan.object_names(), *(a.name for a in plan.assets), *(j.name for j in plan.topology.joints)}
    known |= {row.name for row in plan.topology.tendons} | {row.name for row in plan.topology.actuators}
    known |= {name for _, _, model in all_of(plan) for name in model.names()}
    for item in plan.simulation_parameters.interventions:
        known |= {f"{item.kind}:{target}" for target in item.bodies} | {item.kind, *item.bodies}
    for index, objective in enumerate(plan.objectives):
        for cause in objective.cause:
            for part in (p.strip() for p in cause.split("+")):
                kind = part.partition(":")[0]
                whole, _, aspect = part.rpartition(".")
                if part in known or (":" in part and kind in BUILT) or (whole in bodies and aspect in ASPECTS):
                    continue
                near = get_close_matches(part, sorted(known), n=3, cutoff=0.5)
                fix = (
                    "did you mean " + ", ".join(near) + "?" if near else "name one of: " + ", ".join(sorted(known)[:30])
                )
                yield view.at(("objectives", index, "cause"), f"the cause `{part}` is not in the plan", fix)
