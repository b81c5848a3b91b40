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
    hollow: all of the mass in the surface, as of a ball full of air; with `mass`, since a shell's density has another unit.
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
from .parts import laid_out, slabs_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco
    import numpy as np

    from .parts import Matrix, Part

DRAWN = {"contype": 0, "conaffinity": 0, "mass": 0.0, "group": 2}
"""Of geoms that are drawn and not simulated."""


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
    slabs = slabs_of(name, size, wall)
    body, properties = _body(spec, name, **common)
    if "quat" in properties:
        raise ValueError(f"container {name}: a container cannot be tilted; leave out tilt_deg")
    mass = properties.pop("mass", None)
    total = sum(half[0] * half[1] * half[2] for _, half in slabs.values())
    for side, (offset, half) in slabs.items():
        share = {} if mass is None else {"mass": mass * half[0] * half[1] * half[2] / total}
        _geom(body, f"{name}_{side}", "mjGEOM_BOX", half, pos=offset, **properties, **share)
    return body


def compound(
    spec: "mujoco.MjSpec", name: str, *, parts: "Sequence[Part]", mass: float | None = None, **common: Any
) -> "mujoco.MjsBody":
    """One rigid body of several primitives: a ladder of rails and rungs, a suitcase with wheels and a handle.

    Its origin is the centre of the box around all parts, after `tilt_deg`; its centre of mass and its inertia follow from
    the parts. Geoms are called `name/part`. `look` and `surface` are those of parts without their own.

    Args:
        spec: the world under construction.
        name: body name.
        parts: see `worldkit.parts.Part`.
        mass: kilograms of the whole; parts that give no mass of their own share what is left (`Whole.masses`).
        common: as for every body (`pos`, `yaw_deg`, `tilt_deg`, `fixed`, `parent`, `joint` …).

    Raises:
        ValueError: parts that cannot be laid out, or masses that contradict each other.
    """
    from . import materials

    surface, drawn = common.pop("surface", None) or {}, bool(common.get("visual_only"))
    whole = laid_out(name, parts, common.pop("tilt_deg", 0.0))
    try:
        masses = whole.masses(mass, common.pop("density", None) or surface.get("density"))
    except ValueError as error:
        raise ValueError(f"compound {name}: {error}") from error
    body, properties = _body(spec, name, **common)
    for solid, weight in zip(whole.solids, masses, strict=True):
        # A part's own surface replaces the body's whole: a contact without restitution must not inherit a spring.
        own = properties | (surface if solid.part.surface is None else solid.part.surface)
        own.pop("density", None)
        if solid.part.look is not None:
            own["material"] = materials.add(spec, solid.part.look)
        own |= DRAWN if drawn or solid.part.visual_only else {"mass": weight}
        pose = {"pos": solid.centre, "quat": _quat(solid.rotation)}
        _geom(body, solid.name, f"mjGEOM_{solid.shape.upper()}", solid.half, **own, **pose)
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
    hollow: bool = False,
    look: str = "plastic_white",
    surface: dict[str, Any] | None = None,
    fixed: bool = False,
    parent: str | None = None,
    joint: joints.Joint | None = None,
    visual_only: bool = False,
) -> "tuple[mujoco.MjsBody, dict[str, Any]]":
    """Create the body with its joint; returns it with the keyword arguments of its geoms."""
    import math

    import mujoco

    from . import materials

    body = placed(spec, name, pos, yaw_deg, parent)
    if joint is not None:
        joints.attach(body, joint)
    elif not fixed and not visual_only and parent is None:
        body.add_freejoint(name=name)
    properties: dict[str, Any] = {"material": materials.add(spec, look), **(surface or {})}
    if tilt_deg:
        turn = math.radians(tilt_deg) / 2
        properties["quat"] = (math.cos(turn), math.sin(turn), 0.0, 0.0)
    if visual_only:
        properties |= DRAWN
    elif mass is not None:
        properties["mass"] = mass
    elif density is not None:
        properties["density"] = density
    if hollow:
        if mass is None:
            raise ValueError(f"body {name}: a hollow body needs its mass; a density would be one per area")
        properties["typeinertia"] = mujoco.mjtGeomInertia.mjINERTIA_SHELL
    return body, properties


def placed(spec: "mujoco.MjSpec", name: str, pos: Vec3, yaw_deg: float, parent: str | None = None) -> "mujoco.MjsBody":
    """A new body, without geoms and joints, at a pose of the world frame.

    Raises:
        ValueError: the parent is not in the world; the message lists the bodies that are.
    """
    owner, local, quat = pose_below(spec, name, pos, yaw_deg, parent)
    body = owner.add_body(name=name, pos=local)
    body.quat = quat
    return body


def pose_below(
    spec: "mujoco.MjSpec", name: str, pos: Vec3, yaw_deg: float, parent: str | None
) -> "tuple[mujoco.MjsBody, np.ndarray, np.ndarray]":
    """The body that `name` belongs to, and the position (3,) and quaternion (4,) of a pose of the world in its frame.

    Raises:
        ValueError: the parent is not in the world; the message lists the bodies that are.
    """
    import math

    import numpy as np

    owner = spec.worldbody if parent is None else spec.body(parent)
    if owner is None:
        known = ", ".join(b.name for b in spec.bodies if b.name != "world")
        raise ValueError(f"body {name}: its parent {parent!r} is not in the world yet; known: {known or 'none'}")
    origin, rotation = world_pose(owner)
    half = math.radians(yaw_deg) / 2
    quat = _relative(rotation, (math.cos(half), 0.0, 0.0, math.sin(half)))
    return owner, rotation.T @ (np.asarray(pos, dtype=float) - origin), quat


def _relative(rotation: "np.ndarray", quat: tuple[float, float, float, float]) -> "np.ndarray":
    """A world-frame quaternion (wxyz) as seen from a frame with this rotation matrix."""
    import mujoco
    import numpy as np

    inverse, local = np.zeros(4), np.zeros(4)
    mujoco.mju_negQuat(inverse, _quat(rotation))
    mujoco.mju_mulQuat(local, inverse, np.asarray(quat))
    return local


def _quat(rotation: "np.ndarray | Matrix") -> "np.ndarray":
    """The quaternion (wxyz) of a rotation matrix."""
    import mujoco
    import numpy as np

    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.ascontiguousarray(rotation, dtype=float).ravel())
    return quat


def _geom(body: "mujoco.MjsBody", name: str, kind: str, half: tuple, **properties: Any) -> None:
    import mujoco

    body.add_geom(name=name, type=getattr(mujoco.mjtGeom, kind), size=half, **properties)
