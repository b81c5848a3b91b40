"""A made shape becomes a body of the world: drawn, painted, colliding, with the mass and inertia of its solid."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..bodies import COLLIDES, DRAWN, placed
from ..joints import Ball, Hinge, Joint, Slide, attach
from ..naming import free
from ..parts import WATER
from .minting import Made, made
from .signed import Array, Shape, Vec3, rotation_about

if TYPE_CHECKING:
    import mujoco

    from .brushes import Paint
    from .crisp import Solid


@dataclass(frozen=True)
class Part:
    """A part of a figure, made in the figure's coordinates, with its own paint, substance and joint.

    `joint` is from `worldkit.joints`, its anchor and axis in the figure's coordinates; the part turns against `parent`,
    another part that stands before it. `make` are settings of `made`: cells, triangles, texels, hulls.
    """

    name: str
    shape: "Shape | Solid"
    parent: str | None = None
    joint: Joint | Sequence[Joint] | None = None
    paint: "Paint | None" = None
    look: str | None = None
    roughness: float = 0.6
    metallic: float = 0.0
    mass: float | None = None
    density: float | None = None
    surface: dict[str, Any] | None = None
    make: dict[str, Any] = field(default_factory=dict)

    def made(self) -> Made:
        """What comes of it, in the figure's coordinates."""
        return made(self.shape, paint=self.paint, **self.make)


def add(
    spec: "mujoco.MjSpec",
    shape: "Shape | Solid",
    *,
    name: str,
    pos: Vec3,
    yaw_deg: float = 0.0,
    mass: float | None = None,
    density: float | None = None,
    paint: "Paint | None" = None,
    look: str | None = None,
    roughness: float = 0.6,
    metallic: float = 0.0,
    surface: dict[str, Any] | None = None,
    fixed: bool = False,
    visual_only: bool = False,
    parent: str | None = None,
    joint: Joint | Sequence[Joint] | None = None,
    **make: Any,
) -> "mujoco.MjsBody":
    """Add a sculpted body, whose frame is the centre of the box around it; returns it.

    What is drawn is called `name/look`, `name/look2` … and touches nothing; what collides is called `name`, or `name/1` …
    where there are several pieces. Mass, centre of mass and inertia are those of the watertight solid.

    Args:
        spec: the world under construction.
        shape: from `worldkit.sculpt`.
        name: body name.
        pos: world position of the centre of the box around the shape, m.
        yaw_deg: rotation about world z, degrees counter-clockwise from +X.
        mass: kilograms; or `density`, kg/m^3 (that of water when neither is given, or the surface's).
        density: see `mass`.
        paint: see `worldkit.sculpt.brushes`.
        look: a name of `worldkit.materials` or `#rrggbb`, where there is no paint.
        roughness: of the paint, 0 (mirror) to 1 (chalk), where the paint itself tells none.
        metallic: of the paint, 0 or 1.
        surface: contact properties from `worldkit.contacts.surface`.
        fixed: part of the scenery, without joints.
        visual_only: drawn and not simulated.
        parent: name of the body it belongs to, which must be there already.
        joint: how it moves against its parent; None for a loose body means a free joint.
        make: `cells` (64), `triangles` (12000), `texels` (512), `hulls`; see `worldkit.sculpt.made`.

    Raises:
        ValueError: a mass that is not positive, a parent that is not there, or what `made` refuses.
    """
    solid = made(shape, paint=paint, **make)
    body = placed(spec, name, pos, yaw_deg, parent)
    if joint is not None:
        for one in joint if isinstance(joint, list | tuple) else (joint,):
            attach(body, one)
    elif not fixed and not visual_only and parent is None:
        body.add_freejoint(name=name)
    centre = (solid.low + solid.high) / 2
    _draw(spec, body, name, solid, centre, look, roughness, metallic)
    if not visual_only:
        _weigh(body, name, solid, centre, mass, density, surface)
        _collide(spec, body, name, solid, centre, surface)
    return body


def dress(
    spec: "mujoco.MjSpec",
    name: str | Sequence[str],
    shape: "Shape | Solid",
    *,
    pos: Vec3 = (0.0, 0.0, 0.0),
    paint: "Paint | None" = None,
    look: str | None = None,
    roughness: float = 0.6,
    metallic: float = 0.0,
    blend: float | None = None,
    **make: Any,
) -> None:
    """Draw a sculpted skin in place of bodies' own geoms, which go on to collide and weigh, unseen.

    So a plan owns bodies of primitives (`worldkit.bodies`), and the program what they look like. One skin over several bodies
    bends where they do: a hand opens, an arm bends, without a seam. What is sculpted already is not replaced: a glove, then
    a ring over it.

    Args:
        spec: the world under construction; bodies stand as the shape is drawn, joints at zero.
        name: of the body, or of the bodies, which are there already.
        shape: from `worldkit.sculpt`.
        pos: where the centre of the box around the shape lies in the (first) body's frame, m.
        paint: as of `add`, with `look`, `roughness`, `metallic` and `make`.
        look: see `paint`.
        roughness: see `paint`; a skin over several bodies has this one all over, or the mean of what the paint tells.
        metallic: see `paint`.
        blend: length, m, over which a skin flows from one body into the next; None: by its size.
        make: see `paint`.

    Raises:
        ValueError: there is no such body, or what `made` refuses.
    """
    names = [name] if isinstance(name, str) else list(name)
    known = [body.name for body in spec.bodies if body.name != "world"]
    if unknown := [one for one in names if one not in known] or ([] if names else [""]):
        raise ValueError(f"there is no body {unknown[0]!r} to dress; known: {', '.join(known) or 'none'}")
    solid = made(shape, paint=paint, hulls="convex", **make)
    for one in names:
        own = list(spec.body(one).geoms)
        if not any(geom.meshname.startswith("sculpt_") and geom.group == DRAWN["group"] for geom in own):
            for geom in own:
                geom.group = COLLIDES["group"]
    if len(names) > 1:
        from .. import materials
        from .blended import bind

        level = float(solid.roughness.mean()) if len(solid.roughness) else roughness
        painted = len(solid.picture)
        drawn = _material(spec, solid, level, metallic) if painted else materials.add(spec, look or "plastic_white")
        bind(spec, names, solid, np.asarray(pos, dtype=float), blend, drawn)
        return
    centre = (solid.low + solid.high) / 2 - np.asarray(pos, dtype=float)
    _draw(spec, spec.body(names[0]), names[0], solid, centre, look, roughness, metallic)


def assemble(
    spec: "mujoco.MjSpec",
    parts: Sequence[Part],
    *,
    pos: Vec3,
    yaw_deg: float = 0.0,
    origin: Vec3 | None = None,
    fixed: bool = False,
    density: float | None = None,
    surface: dict[str, Any] | None = None,
    placed_joints: "dict[str, Joint | Sequence[Joint]] | None" = None,
) -> "dict[str, mujoco.MjsBody]":
    """Add a figure of several parts, each a body of its own name; returns them by name.

    The figure's point `origin` (the centre of the box around all parts, if not given) comes to lie at `pos`, m, the figure
    turned by `yaw_deg` about it. Parts without a parent are loose unless `fixed`; a part with a parent and no joint is
    fastened to it. `density` and `surface` are those of parts without their own; `placed_joints`, by part, are joints in
    coordinates of the world.

    Raises:
        ValueError: two parts of one name, a parent that does not stand before its part, or what `add` refuses.
    """
    names = [part.name for part in parts]
    for number, part in enumerate(parts):
        if part.name in names[:number]:
            raise ValueError(f"assemble: two parts are called {part.name!r}")
        if part.parent in names[number:]:
            raise ValueError(f"assemble: {part.name} hangs on {part.parent!r}, which must stand before it")
    solids = {part.name: part.made() for part in parts}
    low, high = box_around(parts)
    pivot = (low + high) / 2 if origin is None else np.asarray(origin, dtype=float)
    turn, there = rotation_about(yaw_deg, "z"), np.asarray(pos, dtype=float)

    def world(point: Any) -> Vec3:
        x, y, z = (float(v) for v in there + turn @ (np.asarray(point, dtype=float) - pivot))
        return (x, y, z)

    bodies = {}
    for part in parts:
        solid = solids[part.name]
        given = part.joint
        listed = () if given is None else given if isinstance(given, list | tuple) else (given,)
        bodies[part.name] = add(
            spec, part.shape, name=part.name, pos=world((solid.low + solid.high) / 2), yaw_deg=yaw_deg, mass=part.mass,
            density=part.density or density, paint=part.paint, look=part.look, roughness=part.roughness,
            metallic=part.metallic, surface=part.surface or surface, fixed=fixed, parent=part.parent,
            joint=(placed_joints or {}).get(part.name) or [_turned(one, world, turn) for one in listed] or None, **part.make,
        )  # fmt: skip
    return bodies


def fill(spec: "mujoco.MjSpec", body: "mujoco.MjsBody", part: Part, centre: Array) -> None:
    """Draw and weigh a part in a body that is there, and let it collide; the body's origin is the figure's point `centre` (3,), m."""
    solid = part.made()
    _draw(spec, body, part.name, solid, centre, part.look, part.roughness, part.metallic)
    _weigh(body, part.name, solid, centre, part.mass, part.density, part.surface)
    _collide(spec, body, part.name, solid, centre, part.surface)


def box_around(parts: Sequence[Part]) -> tuple[Array, Array]:
    """Lowest and highest corner (3,) of the box around parts, in the figure's coordinates, m."""
    solids = [part.made() for part in parts]
    return np.min([solid.low for solid in solids], axis=0), np.max([solid.high for solid in solids], axis=0)


def _turned(joint: Joint, world: Any, turn: Array) -> Joint:
    """A joint of the figure's coordinates in those of the world."""
    anchor = None if joint.anchor is None else world(joint.anchor)
    if isinstance(joint, Ball):
        return replace(joint, anchor=anchor)
    assert isinstance(joint, Hinge | Slide)
    x, y, z = (float(v) for v in turn @ np.asarray(joint.axis, dtype=float))
    return replace(joint, anchor=anchor, axis=(x, y, z))


def _draw(
    spec: "mujoco.MjSpec",
    body: "mujoco.MjsBody",
    name: str,
    solid: Made,
    centre: Array,
    look: str | None,
    roughness: float,
    metallic: float,
) -> None:
    import mujoco

    from .. import materials

    moved = np.round(centre - (solid.low + solid.high) / 2, 7)
    shines = _shines(solid)
    levels = np.unique(shines) if len(shines) else np.array([roughness])
    for number, level in enumerate(levels):
        faces = solid.faces[shines == level] if len(shines) else solid.faces
        label = free(f"{name}/look", {geom.name for geom in body.geoms})
        mesh = _mesh_file(spec, f"sculpt_{solid.signature[:16]}_{number}" + _away(moved), solid, faces, centre)
        if len(solid.picture):
            material = _material(spec, solid, float(level), metallic)
        else:
            material = materials.add(spec, look or "plastic_white")
        body.add_geom(name=label, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh, material=material, **DRAWN)


def _away(moved: Array) -> str:
    """The end of a mesh's name that tells where it lies in its body, if not in the middle."""
    return "" if not moved.any() else "_" + "_".join(f"{v:g}" for v in moved)


def _material(spec: "mujoco.MjSpec", solid: Made, roughness: float, metallic: float) -> str:
    """The name of a material that shows the picture, added once."""
    import mujoco

    texture = f"sculpt_{solid.signature[:16]}"
    if spec.texture(texture) is None:
        side = len(solid.picture)
        added = spec.add_texture(name=texture, type=mujoco.mjtTexture.mjTEXTURE_2D, width=side, height=side, nchannel=3)
        added.data = solid.picture.tobytes()
    name = f"{texture}_{roughness:.2f}_{metallic:.2f}"
    if spec.material(name) is None:
        shine = (1.0 - roughness) ** 2
        material = spec.add_material(
            name=name,
            rgba=(1, 1, 1, 1),
            roughness=roughness,
            metallic=metallic,
            shininess=shine,
            specular=0.25 + 0.5 * shine,
        )
        roles = [""] * int(mujoco.mjtTextureRole.mjNTEXROLE)
        roles[int(mujoco.mjtTextureRole.mjTEXROLE_RGB)] = texture
        material.textures = roles
    return name


def _shines(solid: Made) -> Array:
    """The roughness of each face (F,), of which none is that of so few that they make no mesh: fewer than four corners."""
    shines = np.array(solid.roughness)
    levels = list(np.unique(shines))
    for level in list(levels):
        few = shines == level
        if len(levels) > 1 and len(np.unique(solid.faces[few])) < 4:
            levels.remove(level)
            shines[few] = min(levels, key=lambda other: abs(other - level))
    return shines


def _mesh_file(spec: "mujoco.MjSpec", name: str, solid: Made, faces: Array, centre: Array) -> str:
    """The name of a drawn mesh, added once, as a binary file in the spec's memory.

    Source: MuJoCo manual, XML reference, `asset/mesh`, the MSH format.
    """
    import mujoco

    if spec.mesh(name) is not None:
        return name
    used, index = np.unique(faces, return_inverse=True)
    uv = solid.uv[used] if len(solid.uv) else np.zeros((0, 2))
    arrays = [np.round(solid.vertices[used] - centre, 7), solid.normals[used], uv]
    content = struct.pack("<4i", len(used), len(used), len(uv), len(faces))
    content += b"".join(array.astype("<f4").tobytes() for array in arrays) + index.astype("<i4").tobytes()
    spec.assets[f"{name}.msh"] = content
    spec.add_mesh(name=name, file=f"{name}.msh", inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
    return name


def _weigh(
    body: "mujoco.MjsBody",
    name: str,
    solid: Made,
    centre: Array,
    mass: float | None,
    density: float | None,
    surface: dict[str, Any] | None,
) -> None:
    given = density if density is not None else (surface or {}).get("density", WATER)
    weight = solid.volume * given if mass is None else mass
    if not 0 < weight < np.inf:
        raise ValueError(f"body {name}: its mass must be a positive, finite number of kilograms, got {weight}")
    body.mass = weight
    body.ipos = solid.centre_of_mass - centre
    body.fullinertia = weight * solid.inertia[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]
    body.explicitinertial = True


def _collide(
    spec: "mujoco.MjSpec",
    body: "mujoco.MjsBody",
    name: str,
    solid: Made,
    centre: Array,
    surface: dict[str, Any] | None,
) -> None:
    import mujoco

    contact = {key: value for key, value in (surface or {}).items() if key != "density"}
    for number, corners in enumerate(solid.hulls, start=1):
        mesh = f"sculpt_{solid.signature[:16]}_hull{number}"
        if spec.mesh(mesh) is None:
            points = np.round(corners - centre, 7)
            spec.add_mesh(name=mesh, uservert=points.ravel(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
        label = name if len(solid.hulls) == 1 else f"{name}/{number}"
        body.add_geom(name=label, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh, **COLLIDES, **contact)
