"""A joint cannot be built as it is written.

What it does: looks at `topology.joints`: an axis of length zero, a range that ends before it begins, a child that is its
own parent, a child that the plan fixes; a joint that closes a loop (its child hangs on an earlier one) and yet slides, has a
range, a spring, friction, a motor or an initial motion.

Why is this bad: the engine refuses it, or builds a joint that cannot move. What closes a loop is a constraint: it has no
coordinate that could be limited, driven or started.

Use instead: an axis such as `[0, 0, 1]`, a range `[low, high]`, and `fixed: false` on what should turn or slide. Of a
loop's joints list the one that slides, is limited or driven before the other joint of its child.
"""

from collections.abc import Iterator

from ....model.plan.committed import Joint
from ...case import Changes
from ...harm import Measured
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP119"
SEVERITY = "error"
HINGE = {"name": "swing", "type": "hinge", "child": "crate"}


def _with(**more: object) -> dict:
    return {"topology": {"joints": [{**HINGE, **more}]}}


GOOD: Changes = (
    _with(range=[-45, 45]),
    {},
    {"topology": {"joints": [HINGE, {"name": "pin", "type": "hinge", "parent": "mug", "child": "crate"}]}},
)
BAD: Changes = (
    _with(axis=[0, 0, 0]),
    _with(range=[45, -45]),
    _with(parent="crate"),
    _with(child="ramp"),
    {"topology": {"joints": [HINGE, {"name": "pin", "type": "slide", "parent": "mug", "child": "crate"}]}},
    {
        "topology": {
            "joints": [HINGE, {"name": "pin", "type": "hinge", "parent": "mug", "child": "crate"}],
            "actuators": [{"name": "drive", "joint": "pin"}],
        }
    },
)


def _compiles(change: dict) -> float:
    """1 when the engine compiles the case's joint, else 0."""
    import mujoco

    axis = " ".join(map(str, change["topology"]["joints"][0].get("axis", (0, 0, 1))))
    try:
        mujoco.MjModel.from_xml_string(
            f"<mujoco><worldbody><body><joint axis='{axis}'/><geom size='.1'/></body></worldbody></mujoco>"
        )
    except ValueError:
        return 0.0
    return 1.0


EVIDENCE = Measured("the engine refuses the axis", _compiles, 0.5)


def check(view: PlanView) -> Iterator[Problem]:
    """Check every joint of the plan."""
    for index, joint in enumerate(view.plan.topology.joints):
        place = ("topology", "joints", index)
        if not any(joint.axis) and joint.type in ("hinge", "slide"):
            yield view.at((*place, "axis"), f"the axis of {joint.name} has no direction", "write e.g. [0, 0, 1]")
        if joint.range is not None and joint.range[0] >= joint.range[1]:
            yield view.at((*place, "range"), f"the range of {joint.name} is empty", "write [low, high]")
        if joint.parent == joint.child:
            yield view.at((*place, "parent"), f"{joint.name} ties {joint.child} to itself", "name another parent")
        if joint in view.plan.topology.loops():
            yield from _loop(view, joint, place)
        row = view.rows.get(joint.child)
        if row is not None and row.fixed and joint.type != "weld":
            yield view.at((*place, "child"), f"{joint.child} has a joint and is fixed", "let it be `fixed: false`")


def _loop(view: PlanView, joint: Joint, place: Place) -> Iterator[Problem]:
    """Report what a joint that closes a loop cannot have."""
    plan = view.plan
    asked = [key for key in ("range", "stiffness", "damping", "frictionloss") if getattr(joint, key)]
    asked += ["type: slide"] if joint.type == "slide" else []
    asked += ["a motor"] if any(a.joint == joint.name for a in plan.topology.actuators) else []
    asked += ["an initial motion"] if joint.name in plan.simulation_parameters.initial_motion else []
    if asked:
        message = f"{joint.name} closes a loop on {joint.child}, and a constraint cannot have {', '.join(asked)}"
        first = next(one for one in plan.topology.joints if one.child == joint.child)
        other = f"{joint.child}, {first.name}, by which {first.parent} carries it"
        yield view.at(place, message, f"list it before the other joint of {other}: then that one closes the loop")
