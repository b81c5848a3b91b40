"""Joints that close a loop: the last pin of a four-bar linkage, as equality constraints between bodies that are there.

MuJoCo's joints make a tree; where a body hangs on a second joint, that one is a constraint. It has no coordinate, hence no
range, spring or motor: give those to a joint of the tree.

    loops.hinge(spec, "pin", child="rocker", parent="coupler", anchor=(0.4, 0, 0.3), axis=(0, 1, 0))

Anchors and axes are in the world's frame, in the pose in which the world is built, as for `worldkit.joints`. The two bodies do
not collide with each other, as a parent and its child would not.
"""

from typing import TYPE_CHECKING, Any

from .joints import Vec3

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SOLREF = (0.004, 1.0)
"""Time constant (s) and damping ratio: raised to twice the time step by the engine where that is longer."""
SOLIMP = (0.99, 0.999, 0.001, 0.5, 2.0)
"""A pin gives way by microns, not by the millimetre that MuJoCo's default allows."""
SHARE = 0.5
"""A hinge is two points on its axis; each lies this share of the child's size from the anchor."""


def ball(
    spec: "mujoco.MjSpec", name: str, *, child: str, parent: str | None = None, anchor: Vec3 | None = None
) -> "list[mujoco.MjsEquality]":
    """A point of `child` stays on a point of `parent` (None: the world); anchor: default the child's origin.

    Raises:
        ValueError: a body that is not in the world.
    """
    return [_connect(spec, name, child, parent, _anchor(spec, child, anchor))]


def hinge(
    spec: "mujoco.MjSpec",
    name: str,
    *,
    child: str,
    parent: str | None = None,
    anchor: Vec3 | None = None,
    axis: Vec3 = (0.0, 0.0, 1.0),
) -> "list[mujoco.MjsEquality]":
    """Two points on an axis stay together: `child` turns about it against `parent` (None: the world).

    Returns:
        two constraints, called `name` and `name_2`.

    Raises:
        ValueError: a body that is not in the world, or an axis without a direction.
    """
    import numpy as np

    middle, along = _anchor(spec, child, anchor), np.asarray(axis, dtype=float)
    length = float(np.linalg.norm(along))
    if not length:
        raise ValueError(f"loop {name}: its axis has no direction; write e.g. (0, 1, 0)")
    arm = along / length * _arm(spec, child)
    return [_connect(spec, label, child, parent, middle + s * arm) for label, s in ((name, 1), (f"{name}_2", -1))]


def weld(spec: "mujoco.MjSpec", name: str, *, child: str, parent: str | None = None) -> "list[mujoco.MjsEquality]":
    """`child` keeps its pose against `parent` (None: the world).

    Raises:
        ValueError: a body that is not in the world.
    """
    import mujoco

    tie = _tie(spec, name, mujoco.mjtEq.mjEQ_WELD, child, parent)
    data = [0.0] * len(tie.data)  # a relative pose of zeros is that of the pose in which the world is built
    data[10] = 1.0  # a torque counts as much as a force
    tie.data = data
    return [tie]


def _connect(
    spec: "mujoco.MjSpec", name: str, child: str, parent: str | None, point: "np.ndarray"
) -> "mujoco.MjsEquality":
    """Connect one point; its anchor is stored in the child's frame, and the engine finds the parent's at the built pose."""
    import mujoco

    from .poses import world_pose

    tie = _tie(spec, name, mujoco.mjtEq.mjEQ_CONNECT, child, parent)
    origin, rotation = world_pose(spec.body(child))
    data = [0.0] * len(tie.data)
    data[:3] = rotation.T @ (point - origin)
    data[10] = (
        1.0  # a connection does not use it, but MJCF reads it back as one, and the world must survive being written
    )
    tie.data = data
    return tie


def _tie(spec: "mujoco.MjSpec", name: str, kind: Any, child: str, parent: str | None) -> "mujoco.MjsEquality":
    import mujoco

    for body in (child, parent):
        if body is not None and spec.body(body) is None:
            known = ", ".join(b.name for b in spec.bodies if b.name != "world")
            raise ValueError(f"loop {name}: there is no body {body!r}; known: {known or 'none'}")
    tie = spec.add_equality(
        name=name, type=kind, objtype=mujoco.mjtObj.mjOBJ_BODY, name1=child, name2=parent or "world"
    )
    tie.solref, tie.solimp = SOLREF, SOLIMP
    pair = {child, parent}
    if parent is not None and not any({e.bodyname1, e.bodyname2} == pair for e in spec.excludes):
        spec.add_exclude(bodyname1=child, bodyname2=parent)
    return tie


def _anchor(spec: "mujoco.MjSpec", child: str, anchor: Vec3 | None) -> "np.ndarray":
    """The anchor (3,), m, in the world frame."""
    import numpy as np

    from .poses import world_pose

    body = spec.body(child)
    if anchor is not None or body is None:
        return np.zeros(3) if anchor is None else np.asarray(anchor, dtype=float)
    return world_pose(body)[0]


def _arm(spec: "mujoco.MjSpec", child: str) -> float:
    """Half the distance between the two points of a hinge, m: of the order of the body, so that they hold it upright."""
    import numpy as np

    body = spec.body(child)
    sizes = [float(np.max(geom.size)) for geom in body.geoms if np.isfinite(geom.size).all()] if body else []
    return SHARE * max(sizes, default=0.05) or 0.05
