"""What rules share that compare a compiled world with its plan: cases, and where the plan puts things."""

import numpy as np

from ....model.plan.committed import Plan, Position
from ....model.plan.imported import inner
from ...compiled.view import ModelView

HEAD = "<mujoco><option timestep='0.002' integrator='implicitfast'/><worldbody><geom name='ground' type='plane' size='9 9 1'/>"
THREE = (
    HEAD + "<body name='ramp' pos='0 0 .1'><geom type='box' size='1 .5 .1'/></body>"
    "<body name='crate' pos='0 0 .3'><freejoint/><geom type='box' size='.2 .15 .1' density='700'/></body>"
    "<body name='mug' pos='.5 0 .25'><freejoint/><geom type='cylinder' size='.04 .05' mass='.35'/></body></worldbody>"
    "<keyframe><key name='start' qpos='0 0 .3 1 0 0 0 .5 0 .25 1 0 0 0' qvel='.5 0 0 0 0 0 0 0 0 0 0 0'/></keyframe></mujoco>"
)
"""The world of `case.SOUND_PLAN`."""


CART = (
    HEAD + "<body name='car' pos='0 0 .3'><freejoint/><geom type='box' size='.5 .2 .1' mass='10'/>"
    "<body name='wheel' pos='.3 .3 -.1'><joint name='axle' axis='0 1 0'/><geom type='ellipsoid' size='.2 .05 .2' mass='2'/>"
    "</body></body></worldbody></mujoco>"
)
"""A thing of the plan that carries another one on a joint."""
LADLE = (
    HEAD
    + "<body name='stick' pos='0 0 1'><joint name='pivot' axis='0 1 0'/><geom type='box' size='.01 .01 .3' mass='1'/>"
    "<body name='disc' pos='0 0 -.3'><geom type='cylinder' size='.1 .02' euler='90 0 0' mass='2'/></body></body></worldbody></mujoco>"
)
"""A thing of the plan that is welded to another one, and lies on its side."""
LADLE_PLAN: dict[str, object] = {
    "topology": {
        "joints": [
            {"name": "pivot", "type": "hinge", "child": "stick", "axis": [0, 1, 0]},
            {"name": "glue", "type": "weld", "parent": "stick", "child": "disc"},
        ]
    },
    "simulation_parameters": {"masses": {"stick": 1, "disc": 2}, "initial_motion": None, "materials": None},
    "scene_objects": [
        {"name": "stick", "primitive": "box", "size": [0.02, 0.02, 0.6]},
        {"name": "disc", "primitive": "cylinder", "size": [0.2, 0.2, 0.04], "deg_x": 90},
    ],
}
CART_PLAN: dict[str, object] = {
    "topology": {"joints": [{"name": "axle", "type": "hinge", "parent": "car", "child": "wheel", "axis": [0, 1, 0]}]},
    "simulation_parameters": {"masses": {"car": 10, "wheel": 2}, "initial_motion": None, "materials": None},
    "scene_objects": [
        {"name": "car", "primitive": "box", "size": [1, 0.4, 0.2]},
        {"name": "wheel", "primitive": "ellipsoid", "size": [0.4, 0.1, 0.4]},
    ],
}


def extent(view: ModelView, body: int) -> np.ndarray:
    """(3,) full extents of a body and what it carries, along its own axes, m; without parts that the plan sizes itself."""
    carried = parts(view, body)
    if any(view.body_weldid[part] == view.body_weldid[body] for part in carried):
        return view.bare_high[body] - view.bare_low[body]
    if carried:
        return view.own_high[body] - view.own_low[body]
    return view.body_high[body] - view.body_low[body]


def parts(view: ModelView, body: int) -> list[int]:
    """The bodies below this one that are objects of the plan with numbers of their own, the outermost only."""
    assert view.plan is not None
    names, found = frozenset(view.plan.object_names()), []
    for other in range(1, len(view.body_parentid)):
        above = other
        while above > 0 and above != body and (above == other or view.texts["names"]["body"][above] not in names):
            above = int(view.body_parentid[above])
        if above == body != other and view.texts["names"]["body"][other] in names:
            found.append(other)
    return found


def centre(view: ModelView, body: int) -> np.ndarray:
    """(3,) the centre of the box around a body, world frame, m."""
    return view.xpos[body] + view.xmat[body] @ ((view.body_high[body] + view.body_low[body]) / 2)


def home(view: ModelView, body: int) -> tuple[np.ndarray, np.ndarray]:
    """Origin and centre of a body, (3,) each, world frame, m, in the built pose, which the plan resolves.

    A joint of the plan with an initial position starts away from it, and takes along what hangs on it.
    """
    place, turn = view.home_xpos[body], view.home_xmat[body]
    return place, place + turn @ ((view.body_high[body] + view.body_low[body]) / 2)


def starts_away(view: ModelView, plan: Plan, body: int) -> bool:
    """Whether the plan lets a joint of the body, or of what carries it, start elsewhere than where it was built."""
    motions = plan.simulation_parameters.initial_motion
    moved = {j.child for j in plan.topology.joints if j.name in motions and motions[j.name].joint_position}
    names = view.texts["names"]["body"]
    while body > 0 and names[body] not in moved:
        body = int(view.body_parentid[body])
    return body > 0


def opened(plan: Plan, name: str) -> bool:
    """Whether the plan lets a joint inside a model or sculpture start away from its rest pose: the box around it is then another one."""
    if f"{name}_" not in inner(plan):
        return False
    motions = plan.simulation_parameters.initial_motion.items()
    return any(joint.startswith(f"{name}_") and start.joint_position for joint, start in motions)


def places(plan: Plan) -> dict[str, tuple[float, float, float]]:
    """The resolved centre of every placed object, world frame, m."""
    found = {
        row.subject: row.position.vector for row in plan.topology.scene_predicates if isinstance(row.position, Position)
    }
    found |= {n: p.vector for n, p in plan.topology.body_positions.items() if isinstance(p, Position)}
    return found


def free_joint(view: ModelView, body: int) -> int | None:
    """The free joint of a body, or None."""
    first, count = int(view.body_jntadr[body]), int(view.body_jntnum[body])
    return first if count == 1 and view.joint_kind[first] == "free" else None
