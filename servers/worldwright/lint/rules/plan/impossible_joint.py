"""A joint cannot be built as it is written.

What it does: looks at `topology.joints`: an axis of length zero, a range that ends before it begins, a child that is its
own parent, a child that the plan fixes.

Why is this bad: the engine refuses it, or builds a joint that cannot move.

Use instead: an axis such as `[0, 0, 1]`, a range `[low, high]`, and `fixed: false` on what should turn or slide.
"""

from collections.abc import Iterator

from ...case import Changes
from ...plan_view import PlanView
from ...problem import Problem
from ...proof import Measured

CODE = "WP119"
SEVERITY = "error"
HINGE = {"name": "swing", "type": "hinge", "child": "crate"}


def _with(**more: object) -> dict:
    return {"topology": {"joints": [{**HINGE, **more}]}}


GOOD: Changes = (_with(range=[-45, 45]), {})
BAD: Changes = (
    _with(axis=[0, 0, 0]),
    _with(range=[45, -45]),
    _with(parent="crate"),
    _with(child="ramp"),
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
    """Every joint of the plan."""
    for index, joint in enumerate(view.plan.topology.joints):
        place = ("topology", "joints", index)
        if not any(joint.axis) and joint.type in ("hinge", "slide"):
            yield view.at((*place, "axis"), f"the axis of {joint.name} has no direction", "write e.g. [0, 0, 1]")
        if joint.range is not None and joint.range[0] >= joint.range[1]:
            yield view.at((*place, "range"), f"the range of {joint.name} is empty", "write [low, high]")
        if joint.parent == joint.child:
            yield view.at((*place, "parent"), f"{joint.name} ties {joint.child} to itself", "name another parent")
        row = view.rows.get(joint.child)
        if row is not None and row.fixed and joint.type != "weld":
            yield view.at((*place, "child"), f"{joint.child} has a joint and is fixed", "let it be `fixed: false`")
