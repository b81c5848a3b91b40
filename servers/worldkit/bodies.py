"""Rigid bodies from primitives, in the plan's convention: full extents, world-frame centres, yaw in degrees.

MuJoCo's own geoms take half sizes and parent-relative poses; this module is the one place where that conversion
happens. Every function returns the new `MjsBody`, so anything MuJoCo offers can still be added to it.

Common arguments:
    spec: the world under construction.
    name: the plan object's name; becomes the body's name, and its geom's.
    pos: centre, metres, world frame.
    yaw_deg: rotation about world z, degrees counter-clockwise from +X.
    tilt_deg: rotation of the shape about the body's own x, before the yaw (90 lays a cylinder along y); not for containers.
    mass: kilograms, or `density` in kg/m^3 (MuJoCo's default, 1000, when neither is given).
    look: a name from `worldkit.materials`, or `#rrggbb`.
    surface: contact properties from `worldkit.contacts.surface`.
    fixed: part of the scenery (no degrees of freedom).
    parent: name of the body it belongs to; None is the world.
    joint: how it moves against its parent; None for a loose body means a free joint.
    visual_only: drawn but not simulated (no mass, no contact); declare why in the plan.
"""

from typing import TYPE_CHECKING, Any

from . import joints
from .joints import Vec3

if TYPE_CHECKING:
    import mujoco
    import numpy as np


def box(spec: "mujoco.MjSpec", name: str, *, size: Vec3, **common: Any) -> "mujoco.MjsBody":
    """A box of full extents `size` (m)."""
    return _single(spec, name, "mjGEOM_BOX", tuple(extent / 2 for extent in size), **common)


def sphere(spec: "mujoco.MjSpec", name: str, *, diameter: float, **common: Any) -> "mujoco.MjsBody":
    """A ball of the given diameter (m)."""
    return _single(spec, name, "mjGEOM_SPHERE", (diameter / 2, 0, 0), **common)


def cylinder(spec: "mujoco.MjSpec", name: str, *, diameter: float, height: float, **common: Any) -> "mujoco.MjsBody":
    """An upright cylinder (m)."""
    return _single(spec, name, "mjGEOM_CYLINDER", (diameter / 2, height / 2, 0), **common)


def capsule(spec: "mujoco.MjSpec", name: str, *, diameter: float, height: float, **common: Any) -> "mujoco.MjsBody":
    """An upright capsule; `height` includes both caps (m)."""
    if height < diameter:
        raise ValueError(
            f"capsule {name}: its height {height} m includes both caps, so it cannot be under {diameter} m"
        )
    return _single(spec, name, "mjGEOM_CAPSULE", (diameter / 2, (height - diameter) / 2, 0), **common)


def ellipsoid(spec: "mujoco.MjSpec", name: str, *, size: Vec3, **common: Any) -> "mujoco.MjsBody":
    """An ellipsoid of full extents `size` (m)."""
    return _single(spec, name, "mjGEOM_ELLIPSOID", tuple(extent / 2 for extent in size), **common)


def container(spec: "mujoco.MjSpec", name: str, *, size: Vec3, wall: float, **common: Any) -> "mujoco.MjsBody":
    """An open box: a floor and four walls of thickness `wall` inside the outer extents `size` (m).

    A given mass is shared between the five slabs in proportion to their volumes.
    """
    x, y, z = (extent / 2 for extent in size)
    t = wall / 2
    if not 0 < wall < min(x, y, 2 * z):
        raise ValueError(f"container {name}: walls of {wall} m do not fit into {size} m")
    slabs = {
        "floor": ((0, 0, t - z), (x, y, t)),
        "front": ((x - t, 0, t), (t, y, z - t)),
        "back": ((t - x, 0, t), (t, y, z - t)),
        "left": ((0, y - t, t), (x - wall, t, z - t)),
        "right": ((0, t - y, t), (x - wall, t, z - t)),
    }
    body, properties = _body(spec, name, **common)
    if "quat" in properties:
        raise ValueError(f"container {name}: a container cannot be tilted; leave out tilt_deg")
    mass = properties.pop("mass", None)
    total = sum(half[0] * half[1] * half[2] for _, half in slabs.values())
    for side, (offset, half) in slabs.items():
        share = {} if mass is None else {"mass": mass * half[0] * half[1] * half[2] / total}
        _geom(body, f"{name}_{side}", "mjGEOM_BOX", half, pos=offset, **properties, **share)
    return body


def world_pose(body: "mujoco.MjsBody") -> "tuple[np.ndarray, np.ndarray]":
    """World position (3,) and rotation matrix (3, 3) of a body of a spec, from the poses of its ancestors."""
    import mujoco
    import numpy as np

    position, rotation = np.zeros(3), np.eye(3)
    chain = []
    node = body
    while node is not None and node.name != "world":
        chain.append(node)
        node = node.parent
    for link in reversed(chain):
        local = np.zeros(9)
        mujoco.mju_quat2Mat(local, np.asarray(link.quat, dtype=float))
        position = position + rotation @ np.asarray(link.pos, dtype=float)
        rotation = rotation @ local.reshape(3, 3)
    return position, rotation


def _single(spec: "mujoco.MjSpec", name: str, kind: str, half: tuple, **common: Any) -> "mujoco.MjsBody":
    body, properties = _body(spec, name, **common)
    _geom(body, name, kind, half, **properties)
    return body


def _body(
    spec: "mujoco.MjSpec",
    name: str,
    *,
    pos: Vec3,
    yaw_deg: float = 0.0,
    tilt_deg: float = 0.0,
    mass: float | None = None,
    density: float | None = None,
    look: str = "plastic_white",
    surface: dict[str, Any] | None = None,
    fixed: bool = False,
    parent: str | None = None,
    joint: joints.Joint | None = None,
    visual_only: bool = False,
) -> "tuple[mujoco.MjsBody, dict[str, Any]]":
    """Create the body with its joint; returns it with the keyword arguments of its geoms."""
    import math

    import numpy as np

    from . import materials

    owner = spec.worldbody if parent is None else spec.body(parent)
    if owner is None:
        known = ", ".join(b.name for b in spec.bodies if b.name != "world")
        raise ValueError(f"body {name}: its parent {parent!r} is not in the world yet; known: {known or 'none'}")
    origin, rotation = world_pose(owner)
    half = math.radians(yaw_deg) / 2
    body = owner.add_body(name=name, pos=rotation.T @ (np.asarray(pos, dtype=float) - origin))
    body.quat = _relative(rotation, (math.cos(half), 0.0, 0.0, math.sin(half)))
    if joint is not None:
        joints.attach(body, joint)
    elif not fixed and not visual_only and parent is None:
        body.add_freejoint(name=name)
    properties: dict[str, Any] = {"material": materials.add(spec, look), **(surface or {})}
    if tilt_deg:
        turn = math.radians(tilt_deg) / 2
        properties["quat"] = (math.cos(turn), math.sin(turn), 0.0, 0.0)
    if visual_only:
        properties |= {"contype": 0, "conaffinity": 0, "mass": 0.0, "group": 2}
    elif mass is not None:
        properties["mass"] = mass
    elif density is not None:
        properties["density"] = density
    return body, properties


def _relative(rotation: "np.ndarray", quat: tuple[float, float, float, float]) -> "np.ndarray":
    """A world-frame quaternion (wxyz) as seen from a frame with this rotation matrix."""
    import mujoco
    import numpy as np

    frame, inverse, local = np.zeros(4), np.zeros(4), np.zeros(4)
    mujoco.mju_mat2Quat(frame, rotation.ravel())
    mujoco.mju_negQuat(inverse, frame)
    mujoco.mju_mulQuat(local, inverse, np.asarray(quat))
    return local


def _geom(body: "mujoco.MjsBody", name: str, kind: str, half: tuple, **properties: Any) -> None:
    import mujoco

    body.add_geom(name=name, type=getattr(mujoco.mjtGeom, kind), size=half, **properties)
