"""A joint acts otherwise than the plan's, or is not the plan's at all.

What it does: compares every joint with the one of that name in the world of the plan's draft: kind, axis, place, range,
stiffness and its rest, damping, friction, armature, yield, and the limits on what actuators may do; free joints too. Finds
joints that the plan does not have, and those of the plan that are not there; a thing that is built as a flex needs no free joint.

Why is this bad: a free body with damping slows down in empty air; a hinge with a spring returns by itself; armature makes it
heavy for no visible reason.

Use instead: `worldkit.joints` with the numbers of the plan's `topology.joints`.
"""

from collections.abc import Iterator

import numpy as np

from worldkit.contacts import restitution_of

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import (
    SOUND,
    changed,
    compared,
    flexed,
    missing,
    named,
    names,
    rebounds_otherwise,
    sheet,
    shown,
    sprung,
    twins,
    unplanned,
    yields,
)  # fmt: skip

CODE = "WM164"
SEVERITY = "error"
SCOPE = "acts"
BRAKE = "spec.joint('crate').damping[0] = 40"


def _bouncing(restitution: float, time_constant: float) -> tuple[str, dict[str, object]]:
    """A case with a stop like this, whose plan has one of 0.6 and 10 ms."""
    stop = f"contacts.surface(restitution={restitution}, time_constant={time_constant})"
    text, plan = changed(
        f"spec.joint('pivot').solref_limit = {stop}['solref']", f"spec.joint('pivot').solimp_limit = {stop}['solimp']"
    )
    pivot = {**plan["topology"]["joints"][0], "stop": {"time_constant": 0.01, "restitution": 0.6}}  # type: ignore[index]
    return text, plan | {"topology": {**plan["topology"], "joints": [pivot]}}  # type: ignore[dict-item]


def _hung(anchor: float) -> tuple[str, dict[str, object]]:
    """A case with an arm on a ball joint at this height above it, m; by the plan it is 0.5 m."""
    text, plan = changed(
        "spec.delete(spec.actuator('push'))",
        "spec.delete(spec.joint('pivot'))",
        f"spec.body('arm').add_joint(name='hook', type=mujoco.mjtJoint.mjJNT_BALL, pos=(0, 0, {anchor}))",
    )
    hook = {"name": "hook", "type": "ball", "child": "arm", "anchor": [1.5, 0, 1.0]}
    return text, plan | {"topology": {**plan["topology"], "joints": [hook], "actuators": None}}  # type: ignore[dict-item]


GOOD = (*SOUND, _bouncing(0.6, 0.01), _hung(0.5), sheet())
BAD = (
    _hung(0.31),
    _bouncing(0.1, 0.01),
    _bouncing(0.8, 0.01),
    _bouncing(0.6, 0.025),
    changed(BRAKE),
    changed("spec.joint('pivot').stiffness[0] = 30"),
    changed("spec.joint('pivot').damping[1] = 3"),
    changed("spec.joint('pivot').armature = 2"),
    changed("spec.joint('pivot').frictionloss = 1"),
    changed("spec.joint('pivot').range = (-0.5, 0.5)"),
    changed("spec.joint('pivot').solimp_limit = (0.01, 0.02, 0.001, 0.5, 2)"),
    changed("spec.joint('pivot').axis = (0, 1, 0)"),
    changed("spec.joint('pivot').pos = (0.3, 0, 0)"),
    changed("spec.body('arm').add_joint(name='more', axis=(1, 0, 0))"),
)
EVIDENCE = Measured(
    "the crate stops in the air's stead",
    lambda s: float(after(s, 0.05)[1].qvel[0]),
    0.03,
    "m/s",
    bad=changed(BRAKE)[0],
    good=changed()[0],
)
SPRING = (("jnt_stiffness", "stiffness"), ("jnt_stiffnesspoly", "further stiffness"))
LOSSES = (
    ("dof_damping", "damping"),
    ("dof_dampingpoly", "further damping"),
    ("dof_frictionloss", "friction"),
    ("dof_armature", "armature"),
)
LIMIT = (("jnt_range", "range (rad or m)"), ("jnt_margin", "margin of the range"))
SOFTER, NEAR, TURNED = 1.05, 2e-3, 0.9998
"""m, and the cosine of one degree."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check joints of both worlds, then those of one."""
    assert view.planned is not None and view.plan is not None
    for index, twin in twins(view, "joint"):
        yield from _compared(view, index, twin)
    for index in unplanned(view, "joint"):
        name = (
            names(view, "joint")[index]
            or f"a {view.joint_kind[index]} joint of {view.name('body', int(view.jnt_bodyid[index]))}"
        )
        if int(view.jnt_bodyid[index]) not in {int(b) for b in view.flex_vertbodyid}:
            message = f"{name} is a joint that the plan does not have"
            yield view.at(
                "joint",
                index,
                message,
                "add it to topology.joints (`worldwright plan complete` writes it down), or leave it out",
            )
    soft = flexed(view)  # its points move by themselves, so nothing of it has the free joint of a solid one
    free = {
        name for name, kind in zip(names(view.planned, "joint"), view.planned.joint_kind, strict=True) if kind == "free"
    }
    for name in missing(view, "joint"):
        if name in soft and name in free:
            continue
        yield view.of_world(f"the plan's joint {name} is not there", "build it under that name", name)


def _compared(view: ModelView, index: int, twin: int) -> Iterator[Problem]:
    planned = view.planned
    assert planned is not None and view.plan is not None
    kind, wanted = view.joint_kind[index], planned.joint_kind[twin]
    if kind != wanted:
        yield view.at(
            "joint",
            index,
            f"joint {names(view, 'joint')[index]} is a {kind}, by the plan a {wanted}",
            f"make it a {wanted}",
        )
        return
    yield from compared(view, "joint", SPRING, index, twin)
    if view.jnt_stiffness[index] or np.any(view.jnt_stiffnesspoly[index]):
        first = (int(view.jnt_qposadr[index]), int(planned.jnt_qposadr[twin]))
        yield from compared(view, "joint", (("qpos_spring", "rest of the spring"),), index, twin, of=first)
        yield from compared(view, "joint", (("jnt_springyield", "yield"),), index, twin)
    dofs = (int(view.jnt_dofadr[index]), int(planned.jnt_dofadr[twin]))
    for field, word in LOSSES:
        value = float(np.ravel(getattr(view, field)[dofs[0]])[0])
        names_of = (names(view, "joint")[index], view.texts["names"]["body"][int(view.jnt_bodyid[index])])
        # Armature has no field of its own: a constant belongs to this joint if it is named after it, or after what it
        # carries.
        if kind == "free" or not named(view.plan, value, *(f"{owner}_{word}" for owner in names_of)):
            yield from compared(view, "joint", ((field, word),), index, twin, of=dofs)
    grip = (planned.dof_solref[dofs[1]], planned.dof_solimp[dofs[1]])
    if np.any(view.dof_frictionloss[dofs[0]]) and yields(view.dof_solref[dofs[0]], view.dof_solimp[dofs[0]], grip):
        message = f"the dry friction of joint {names(view, 'joint')[index]} gives way more than the plan's"
        yield view.at("joint", index, message, "leave solref_friction and solimp_friction alone")
    yield from compared(view, "joint", (("jnt_limited", "range"),), index, twin)
    if view.jnt_limited[index] and planned.jnt_limited[twin]:
        yield from compared(view, "joint", LIMIT, index, twin)
        limit = (planned.jnt_solref[twin], planned.jnt_solimp[twin])
        if yields(view.jnt_solref[index], view.jnt_solimp[index], limit):
            message = f"the limit of joint {names(view, 'joint')[index]} gives way more than the plan's, or bounces"
            yield view.at("joint", index, message, "leave solref_limit and solimp_limit as worldkit.joints sets them")
        elif message := _stopped(view, planned, index, twin):
            yield view.at("joint", index, message, "leave it to worldkit.joints: stop_s and stop_restitution")
    for field, word in (
        ("jnt_actfrclimited", "limit on its actuators"),
        ("jnt_actgravcomp", "compensation by actuators"),
    ):
        yield from compared(view, "joint", ((field, word),), index, twin)
    if kind != "free":
        yield from _placed(view, planned, index, twin)


def _stopped(view: ModelView, planned: ModelView, index: int, twin: int) -> str:
    """How the range of a joint stops it otherwise than the `stop` of its row; empty without one, or when it does not."""
    assert view.plan is not None
    name = names(view, "joint")[index]
    if not any(row.name == name and row.stop is not None for row in view.plan.topology.joints):
        return ""
    (time, ratio), (wanted, there) = sprung(view.jnt_solref[index]), sprung(planned.jnt_solref[twin])
    if rebounds_otherwise(ratio, there):
        return f"the stop of joint {name} throws back {restitution_of(ratio):.2f} of a speed, by the plan {restitution_of(there):.2f}"
    if time > SOFTER * wanted:
        return (
            f"the stop of joint {name} gives way within {time * 1e3:.3g} ms, by the plan within {wanted * 1e3:.3g} ms"
        )
    return ""


def _placed(view: ModelView, planned: ModelView, index: int, twin: int) -> Iterator[Problem]:
    """Compare axis and anchor (m), world frame, in the built pose: of a hinge its line, of a ball its centre."""
    axis, anchor = _axis_line(view, index)
    wanted, there = _axis_line(planned, twin)
    name, kind = names(view, "joint")[index], view.joint_kind[index]
    if kind != "ball" and axis @ wanted < TURNED:
        yield view.at(
            "joint",
            index,
            f"joint {name} turns or slides about {shown(axis)}, by the plan about {shown(wanted)}",
            "give the plan's axis",
        )
    off = anchor - there
    if kind == "hinge":
        off = off - (off @ wanted) * wanted
    if kind != "slide" and np.linalg.norm(off) > NEAR:
        yield view.at(
            "joint",
            index,
            f"joint {name} is at {shown(anchor)} m, by the plan at {shown(there)} m",
            "give the plan's anchor",
        )


def _axis_line(view: ModelView, joint: int) -> tuple[np.ndarray, np.ndarray]:
    body = int(view.jnt_bodyid[joint])
    turn = view.home_xmat[body]
    return turn @ view.jnt_axis[joint], view.home_xpos[body] + turn @ view.jnt_pos[joint]
