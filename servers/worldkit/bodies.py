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
    joint: how it moves against its parent, or several joints, the one that moves first in front; None for a loose body means a free joint.
    visual_only: drawn but not simulated (no mass, no contact); declare why in the plan.
"""

import hashlib
from typing import TYPE_CHECKING, Any

from . import joints
from .joints import Vec3
from .parts import WATER, laid_out, slabs_of
from .poses import world_pose

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco
    import numpy as np

    from .forms import Form
    from .parts import Part

DRAWN = {"contype": 0, "conaffinity": 0, "mass": 0.0, "group": 2}
"""Keyword arguments of geoms that are drawn and not simulated."""
COLLIDES = {"mass": 0.0, "group": 3}
"""Keyword arguments of the pieces of a form, whose weight is its body's own; group 3 is not drawn by default."""


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
    from .turning import quaternion

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
        pose = {"pos": solid.centre, "quat": quaternion(solid.rotation)}
        _geom(body, solid.name, f"mjGEOM_{solid.shape.upper()}", solid.half, **own, **pose)
    return body


def formed(spec: "mujoco.MjSpec", name: str, *, form: "Form", **common: Any) -> "mujoco.MjsBody":
    """A body of a `worldkit.forms` shape: a cone, a ring, a bowl, a pipe, a hill.

    Its origin is the centre of the box around it, after `tilt_deg`. It is drawn as a mesh (`name/look`, without contact) and
    collides as convex pieces (`name`, or `name/1` … when there are several), which leave its cavities open. Mass, centre of
    mass and inertia are those of the solid that is drawn.

    Args:
        spec: the world under construction.
        name: body name.
        form: from `worldkit.forms`.
        common: as for every body (`pos`, `yaw_deg`, `tilt_deg`, `mass`, `look`, `surface` …); `hollow` is not among them.

    Raises:
        ValueError: `hollow` is asked for: a vessel or a pipe has a wall instead.
    """
    import numpy as np

    if common.pop("hollow", False):
        raise ValueError(f"body {name}: a form cannot be hollow; give a lathe or a tube a wall")
    shape = form.tilted(common.pop("tilt_deg", 0.0))
    body, properties = _body(spec, name, **common)
    material = properties.pop("material")
    vertices, normals, faces = shape.drawn()
    drawn = mesh(spec, vertices, normals, faces)
    look = {**DRAWN, "contype": 0, "conaffinity": 0, "material": material}
    _geom(body, f"{name}/look", "mjGEOM_MESH", (0, 0, 0), meshname=drawn, **look)
    if common.get("visual_only"):
        return body
    mass = properties.pop("mass", None)
    density = properties.pop("density", WATER)
    body.mass = shape.volume * density if mass is None else mass
    body.ipos = shape.centre_of_mass
    six = shape.inertia[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]
    body.fullinertia = body.mass * six
    body.explicitinertial = True
    for number, piece in enumerate(shape.pieces, start=1):
        label = name if len(shape.pieces) == 1 else f"{name}/{number}"
        if isinstance(piece, np.ndarray):
            _geom(body, label, "mjGEOM_MESH", (0, 0, 0), meshname=mesh(spec, piece), **properties, **COLLIDES)
            continue
        ball = not (piece.end - piece.start).any()
        kind = "mjGEOM_SPHERE" if ball else "mjGEOM_CAPSULE" if piece.capped else "mjGEOM_CYLINDER"
        ends = {"pos": piece.start} if ball else {"fromto": [*piece.start, *piece.end]}
        _geom(body, label, kind, (piece.radius, 0, 0), **properties, **COLLIDES, **ends)
    return body


def mesh(spec: "mujoco.MjSpec", vertices: "np.ndarray", normals: "np.ndarray | None" = None, faces: Any = None) -> str:
    """The name of a mesh asset of these vertices (N, 3), m, added once; without faces it is their convex hull."""
    import mujoco
    import numpy as np

    exact = np.round(vertices, 9) + 0.0
    called = f"{'drawn' if faces is not None else 'hull'}_{hashlib.sha256(exact.tobytes()).hexdigest()[:16]}"
    if spec.mesh(called) is None:
        made = spec.add_mesh(name=called, uservert=exact.ravel())
        made.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
        if faces is not None and normals is not None:
            made.usernormal, made.userface, made.userfacenormal = normals.ravel(), faces.ravel(), faces.ravel()
            made.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    return called


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
    joint: "joints.Joint | Sequence[joints.Joint] | None" = None,
    visual_only: bool = False,
) -> "tuple[mujoco.MjsBody, dict[str, Any]]":
    """Create the body with its joint; returns it with the keyword arguments of its geoms."""
    import math

    import mujoco

    from . import materials

    body = placed(spec, name, pos, yaw_deg, parent)
    if joint is not None:
        for one in joint if isinstance(joint, list | tuple) else (joint,):
            joints.attach(body, one)
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

    from .turning import about, conjugate, product, quaternion

    owner = spec.worldbody if parent is None else spec.body(parent)
    if owner is None:
        known = ", ".join(b.name for b in spec.bodies if b.name != "world")
        raise ValueError(f"body {name}: its parent {parent!r} is not in the world yet; known: {known or 'none'}")
    origin, rotation = world_pose(owner)
    quat = product(conjugate(quaternion(rotation)), about((0.0, 0.0, 1.0), math.radians(yaw_deg)))
    return owner, rotation.T @ (np.asarray(pos, dtype=float) - origin), quat


def _geom(body: "mujoco.MjsBody", name: str, kind: str, half: tuple, **properties: Any) -> None:
    import mujoco

    body.add_geom(name=name, type=getattr(mujoco.mjtGeom, kind), size=half, **properties)
