"""Something fixed is set in motion, or expected to move.

What it does: compares `initial_motion` and the steps' `motion_expectations` with the objects' `fixed` and `dynamic`.

Why is this bad: a fixed body has no degrees of freedom: the velocity is dropped or the program fails, and the expected
motion can only be had by faking it.

Use instead: make the object dynamic, or take it out of the motion.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP110"
SEVERITY = "error"
GOOD: Changes = (
    {},
    {
        "topology": {"joints": [{"name": "lid", "type": "hinge", "child": "ramp"}]},
        "simulation_parameters": {"initial_motion": {"lid": {"joint_velocity": 1.0}}},
    },
)
STEP = {"description": "Build.", "cameras": ["perspective", "top_down"]}
BAD: Changes = (
    {"simulation_parameters": {"initial_motion": {"ramp": {"linear": [1, 0, 0]}}}},
    {"implementation_steps": [{**STEP, "motion_expectations": ["ramp"]}]},
    {
        "assets": [{"name": "mug", "filename": "mug", "fixed": True}],
        "implementation_steps": [{**STEP, "motion_expectations": ["mug"]}],
    },
)
EVIDENCE = Argued("a body without a joint keeps no velocity: there is nothing to measure")


def check(view: PlanView) -> Iterator[Problem]:
    """Check initial motion, then expected motion; a fixed object on a joint moves after all."""
    rows = view.rows
    jointed = {joint.child for joint in view.plan.topology.joints if joint.type != "weld"}
    for name in view.plan.simulation_parameters.initial_motion:
        if name in rows and name not in jointed and not view.moves(rows[name]):
            place: Place = ("simulation_parameters", "initial_motion", name)
            yield view.at(
                place, f"`{name}` is fixed but has an initial motion", "make it dynamic, or remove the motion"
            )
    for index, step in enumerate(view.plan.implementation_steps):
        for number, name in enumerate(step.motion_expectations):
            if name in rows and name not in jointed and not view.moves(rows[name]):
                place = ("implementation_steps", index, "motion_expectations", number)
                yield view.at(place, f"`{name}` is fixed but expected to move", "make it dynamic, or expect it to stay")
