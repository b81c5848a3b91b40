"""An asset becomes a body: drawn meshes and convex collision pieces apart, with the mass and inertia of the substance."""

import math
from typing import TYPE_CHECKING, Any

from ..bodies import placed
from ..joints import Joint, attach
from .catalog import find
from .entry import Asset, Piece

if TYPE_CHECKING:
    import mujoco

VISUAL_GROUP = 2
COLLISION_GROUP = 3  # not drawn by default (mjvOption.geomgroup shows 0, 1 and 2)


def add(
    spec: "mujoco.MjSpec",
    key: str,
    *,
    name: str,
    height: float,
    pos: tuple[float, float, float],
    yaw_deg: float = 0.0,
    fixed: bool = False,
    mass: float | None = None,
    surface: dict[str, Any] | None = None,
    look: str | None = None,
    parent: str | None = None,
    joint: "Joint | None" = None,
) -> "mujoco.MjsBody":
    """Add catalog asset `key` to the world as body `name` and return the body.

    Its frame is the centre of its bounding box; +X is its front. Drawn meshes are in geom group 2 and touch nothing;
    collision pieces are in group 3, which is hidden by default. The body's inertia is that of the substance it is made
    of (a mug is hollow, a basketball is a shell), scaled to its mass. Instances of one size share meshes and textures.

    Args:
        spec: the world under construction.
        key: catalog key, see `assets.keys()`.
        name: body name; a single collision geom gets it too, several are `name/piece`.
        height: metres, vertical extent of the bounding box; the other extents follow.
        pos: world position of the bounding box's centre, metres.
        yaw_deg: rotation about world z, degrees counter-clockwise from +X.
        fixed: part of the scenery, without a free joint.
        mass: kilograms; default `Asset.mass_at(height)`, or `surface["density"]` times the substance's volume.
        surface: keyword arguments for the collision geoms, from `worldkit.contacts.surface`; default the entry's own
            constants (a pool table's cushions differ from its bed).
        parent: name of the body it belongs to, which must be there already; None is the world.
        joint: how it moves against its parent; None for a loose asset means a free joint, for one with a parent none.
        look: one of the asset's own looks, else a name of `worldkit.materials` or `#rrggbb` for its main materials.

    Raises:
        UnknownAssetError, AssetError: no such asset, or a malformed one.
        ValueError: a height or mass that is not positive, an unknown look, or a parent that is not there.
    """
    asset = find(key)
    scale = asset.scale(height)
    surface = dict(surface) if surface is not None else None
    density = surface.pop("density", None) if surface is not None else None
    if mass is None:
        mass = density * asset.solid_volume * scale**3 if density else asset.mass_at(height)
    if not 0 < mass < math.inf:
        raise ValueError(f"asset {name} ({key}): mass must be a positive, finite number of kilograms, got {mass}")
    body = placed(spec, name, pos, yaw_deg, parent)
    body.mass = mass
    body.ipos = [scale * x for x in asset.inertia_com]
    body.fullinertia = [mass * scale**2 * x for x in asset.inertia_per_kg]
    body.explicitinertial = True
    if joint is not None:
        attach(body, joint)
    elif not fixed and parent is None:
        body.add_freejoint()
    worn = _materials(spec, asset, look)
    for mesh, material in asset.visual:
        body.add_geom(
            name=f"{name}/look_{mesh.stem}",
            type=_mujoco().mjtGeom.mjGEOM_MESH,
            meshname=_mesh(spec, asset, mesh.stem, mesh, height, shell=True),
            material=worn[material],
            pos=[scale * x for x in asset.visual_pos],
            contype=0,
            conaffinity=0,
            group=VISUAL_GROUP,
            mass=0,
        )
    pieces = asset.collision or (Piece("box", "box", extents=asset.native_extents),)
    for piece in pieces:
        contact = surface if surface is not None else _surface({**asset.contact, **piece.contact})
        label = name if len(pieces) == 1 else f"{name}/{piece.name}"
        body.add_geom(name=label, group=COLLISION_GROUP, **_shape(spec, asset, piece, height), **contact)
    return body


def _mujoco() -> Any:
    import mujoco

    return mujoco


def _surface(constants: dict[str, float]) -> dict[str, Any]:
    """The asset's constants as geom arguments."""
    from .. import contacts

    return contacts.surface(**constants)


def _shape(spec: "mujoco.MjSpec", asset: Asset, piece: Piece, height: float) -> dict[str, Any]:
    """Type, pose and size (MuJoCo's half sizes) of a collision piece at this height."""
    kinds = _mujoco().mjtGeom
    s = asset.scale(height)
    pose = {"pos": [s * x for x in piece.pos], "quat": piece.quat}
    if piece.file is not None:
        mesh = _mesh(spec, asset, f"hull_{piece.file.stem}", piece.file, height, shell=False)
        return {"type": kinds.mjGEOM_MESH, "meshname": mesh, **pose}
    if piece.extents is not None:
        return {"type": kinds.mjGEOM_BOX, "size": [s * x / 2 for x in piece.extents], **pose}
    radius = s * (piece.diameter or 0.0) / 2
    if piece.height is None:
        return {"type": kinds.mjGEOM_SPHERE, "size": [radius, 0, 0], **pose}
    if piece.type == "capsule":
        return {"type": kinds.mjGEOM_CAPSULE, "size": [radius, s * piece.height / 2 - radius, 0], **pose}
    return {"type": kinds.mjGEOM_CYLINDER, "size": [radius, s * piece.height / 2, 0], **pose}


def _mesh(spec: "mujoco.MjSpec", asset: Asset, stem: str, file: Any, height: float, *, shell: bool) -> str:
    """The mesh asset's name, added once per size. Drawn meshes may be open sheets, hence shell inertia."""
    name = f"{asset.key}.{stem}@{height:.9g}"
    if spec.mesh(name) is None:
        kinds = _mujoco().mjtMeshInertia
        spec.add_mesh(
            name=name,
            file=str(file),
            scale=[asset.scale(height)] * 3,
            inertia=kinds.mjMESH_INERTIA_SHELL if shell else kinds.mjMESH_INERTIA_CONVEX,
        )
    return name


def _materials(spec: "mujoco.MjSpec", asset: Asset, look: str | None) -> dict[str, str]:
    """The asset's material names mapped to those in the spec, added once per look."""
    own = look if look is not None else asset.default_look
    if own is not None and own not in asset.looks:
        from .. import materials

        try:
            painted = materials.add(spec, own)
        except ValueError as error:
            raise ValueError(
                f"asset {asset.key} has no look {own!r} ({', '.join(asset.looks) or 'none'}); {error}"
            ) from error
        main = asset.recolour or (asset.visual[0][1],)
        return {name: painted if name in main else _material(spec, asset, name, None) for name in asset.materials}
    return {name: _material(spec, asset, name, own) for name in asset.materials}


def _material(spec: "mujoco.MjSpec", asset: Asset, material: str, look: str | None) -> str:
    changes = asset.looks.get(look, {}).get(material, {}) if look is not None else {}
    if (table := {**asset.materials[material], **changes}.get("look")) is not None:
        from .. import materials

        return materials.add(spec, table)
    name = f"{asset.key}.{material}" + (f".{look}" if changes else "")
    if spec.material(name) is None:
        values = {**asset.materials[material], **changes}
        texture = values.pop("texture", None)
        added = spec.add_material(name=name, **values)
        if texture is not None:
            mujoco = _mujoco()
            label = f"{asset.key}.{texture.stem}"
            if spec.texture(label) is None:
                spec.add_texture(name=label, type=mujoco.mjtTexture.mjTEXTURE_2D, file=str(texture))
            added.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = label
    return name
