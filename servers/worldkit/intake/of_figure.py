"""A figure of sculpted parts as the files of an asset: drawn meshes, hulls, pictures, and `moving.xml` where its parts move.

All of them lie in the frame of the asset, the centre of the box around the figure. The rigid asset has the weight of all parts
as they stand; in `moving.xml`, which a plan names as a row of type mjcf, each part is a body with its joints.
"""

import re
import struct
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import IntakeError
from ..joints import Joint, attach
from ..model_looks import TABLE_LOOK
from ..sculpt.figure import Part, box_around, fill
from .drawn_pieces import Array
from .moving_parts import FILE
from .touchable import hull_text

if TYPE_CHECKING:
    import mujoco

MOST_TRIANGLES = 60_000
DRAWN_GROUP = 2
JAMMED = 0.002
"""Share of the figure's longest side by which hulls of two parts overlap as they stand that would else hold each other fast."""


def files(key: str, parts: Sequence[Part], said: dict[str, Any]) -> tuple[dict[str, bytes], dict[str, Any]]:
    """The files of an asset by name, and its facts as `asset.yaml` has them.

    Args:
        key: of the asset, and the name of the body that all others hang on.
        parts: one of them has no parent; densities or masses are their own.
        said: the facts that no shape tells: category, description, source, licence, creator, friction …

    Raises:
        IntakeError: not exactly one part stands by itself, or it is too much to be drawn.
    """
    roots = [part.name for part in parts if part.parent is None]
    if len(roots) != 1:
        cause = (
            f"one part stands by itself and the others hang on it by `parent`; here it is {', '.join(roots) or 'none'}"
        )
        raise IntakeError("several_roots", cause, key, "give every part but one a `parent`")
    parts = [_called(part, {key: f"{key}_part", roots[0]: key}) for part in parts]
    low, high = (np.round(corner, 7) for corner in box_around(parts))
    spec = _spec(key, parts, (low + high) / 2)
    made = _meshes(spec) | _pictures(spec)
    for one, other in _jammed(spec.compile(), max(high - low)):
        spec.add_exclude(bodyname1=one, bodyname2=other)
    model = spec.compile()
    total, com, inertia = _weight(model)
    volume = sum(part.made().volume for part in parts)
    size = [round(float(side), 6) for side in high - low]
    facts = {
        **said,
        "key": key,
        "facing": "+x",
        "native_extents": size,
        "metric_height": size[2],
        "mass": float(f"{total:.6g}"),
        "solid_volume": float(f"{volume:.6g}"),
        "inertia": {"com": [round(float(v), 7) + 0.0 for v in com], "per_kg": [float(f"{v:.6g}") + 0.0 for v in inertia]},
        "visual": [{"mesh": spec.mesh(g.meshname).file, "material": g.material} for g in _geoms(spec, drawn=True)],
        "materials": {material.name: _material(spec, material) for material in spec.materials},
        "collision": [{"type": "hull", "file": spec.mesh(g.meshname).file} for g in _geoms(spec, drawn=False)],
        "measured": {"triangles": sum(len(part.made().faces) for part in parts)},
    }  # fmt: skip
    facts["recolour"] = sorted(facts["materials"])
    if facts["measured"]["triangles"] > MOST_TRIANGLES:
        cause = f"it has {facts['measured']['triangles']:,} triangles; an asset is drawn by at most {MOST_TRIANGLES:,}"
        raise IntakeError("too_many_faces", cause, key, "give its parts fewer `triangles` in `make`")
    if model.njnt:
        made[FILE] = _text(spec).encode()
        facts["measured"]["moving"] = {model.joint(j).name: _range(model, j) for j in range(model.njnt)}
    return made, facts


def _called(part: Part, names: dict[str, str]) -> Part:
    return replace(part, name=names.get(part.name, part.name), parent=names.get(part.parent or "", part.parent))


def _spec(key: str, parts: Sequence[Part], centre: Array) -> "mujoco.MjSpec":
    """The figure as a model of its own, each part a body at the model's origin."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.modelname, spec.compiler.degree = key, False
    for part in parts:
        owner = spec.worldbody if part.parent is None else spec.body(part.parent)
        body = owner.add_body(name=part.name)
        given = () if part.joint is None or part.parent is None else part.joint
        for joint in given if isinstance(given, list | tuple) else (given,):
            attach(body, _moved(joint, centre))
        fill(spec, body, part, centre)
        if part.parent is not None:  # what touches at a joint overlaps as hulls do
            spec.add_exclude(bodyname1=part.parent, bodyname2=part.name)
    return spec


def _jammed(model: "mujoco.MjModel", side: float) -> list[tuple[str, str]]:
    """Pairs of bodies whose hulls overlap as the figure stands, though the parts do not: a hull fills hollows."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    deep = [contact.geom for contact in data.contact[: data.ncon] if contact.dist < -JAMMED * side]
    owners = sorted({tuple(sorted(int(model.geom_bodyid[geom]) for geom in pair)) for pair in deep})
    return [(model.body(one).name, model.body(other).name) for one, other in owners]


def _moved(joint: Joint, centre: Array) -> Joint:
    if joint.anchor is None:
        return joint
    x, y, z = (float(v) for v in np.asarray(joint.anchor, dtype=float) - centre)
    return replace(joint, anchor=(x, y, z))


def _geoms(spec: "mujoco.MjSpec", *, drawn: bool) -> "list[mujoco.MjsGeom]":
    return [geom for geom in spec.geoms if (geom.group == DRAWN_GROUP) == drawn]


def _meshes(spec: "mujoco.MjSpec") -> dict[str, bytes]:
    """Every mesh of the spec turned into an OBJ file of its own, by the file's name."""
    made: dict[str, bytes] = {}
    drawn = {geom.meshname for geom in _geoms(spec, drawn=True)}
    for mesh in spec.meshes:
        kind = "look" if mesh.name in drawn else "hull"
        name = f"{kind}_{sum(other.startswith(kind) for other in made):02d}.obj"
        if kind == "look":
            made[name] = _obj(spec.assets.pop(mesh.file)).encode()
        else:
            made[name] = hull_text(np.round(np.array(mesh.uservert).reshape(-1, 3), 6)).encode()
            mesh.uservert = []
        spec.assets[name], mesh.file = made[name], name
    return made


def _obj(content: bytes) -> str:
    """A mesh in the engine's binary form as OBJ text, to hundredths of a millimetre."""
    vertices, normals, places, faces = struct.unpack_from("<4i", content)
    floats = np.frombuffer(content, "<f4", 3 * vertices + 3 * normals + 2 * places, 16)
    index = np.frombuffer(content, "<i4", 3 * faces, 16 + 4 * len(floats)).reshape(-1, 3) + 1
    points, ways, uv = np.split(floats, np.cumsum([3 * vertices, 3 * normals]))
    told, where = np.unique(np.round(ways.reshape(-1, 3), 2) + 0.0, axis=0, return_inverse=True)
    rows = [f"v {x:.5f} {y:.5f} {z:.5f}" for x, y, z in points.reshape(-1, 3)]
    rows += [f"vn {x:.2f} {y:.2f} {z:.2f}" for x, y, z in told]
    rows += [f"vt {u:.4f} {1 - v:.4f}" for u, v in uv.reshape(-1, 2)]  # OBJ counts rows of a picture from below
    normal = where.ravel() + 1

    def corner(v: int) -> str:
        return f"{v}/{v}/{normal[v - 1]}" if places else f"{v}//{normal[v - 1]}"

    return "\n".join([*rows, *("f " + " ".join(map(corner, face)) for face in index)]) + "\n"


def _pictures(spec: "mujoco.MjSpec") -> dict[str, bytes]:
    """The pictures of painted parts as PNG files; looks of the table are named, and need none."""
    import cv2
    import mujoco

    role = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)
    made: dict[str, bytes] = {}
    for number, material in enumerate(spec.materials):
        texture = spec.texture(material.textures[role]) if material.textures[role] else None
        painted = material.name.startswith("sculpt_")
        name = f"picture_{number:02d}" if painted else f"{TABLE_LOOK}{material.name}"
        if painted and texture is not None and not texture.file:
            pixels = np.frombuffer(texture.data, np.uint8).reshape(texture.height, texture.width, 3)
            ok, data = cv2.imencode(".png", pixels[..., ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 9])
            made[f"{name}.png"] = spec.assets[f"{name}.png"] = data.tobytes() if ok else b""
            texture.file = f"{name}.png"
        for geom in spec.geoms:
            geom.material = name if geom.material == material.name else geom.material
        if not painted:
            material.textures = [""] * len(material.textures)
            if texture is not None:
                spec.delete(texture)
        material.name = name
    return made


def _material(spec: "mujoco.MjSpec", material: Any) -> dict[str, Any]:
    import mujoco

    if material.name.startswith(TABLE_LOOK):
        return {"look": material.name.removeprefix(TABLE_LOOK)}
    picture = material.textures[int(mujoco.mjtTextureRole.mjTEXROLE_RGB)]
    rest = {
        name: round(float(getattr(material, name)), 3) for name in ("roughness", "metallic", "specular", "shininess")
    }
    return {"texture": spec.texture(picture).file, **rest}


def _weight(model: "mujoco.MjModel") -> tuple[float, Array, Array]:
    """Mass, kg, centre of mass (3,), and inertia about it for one kilogram (xx, yy, zz, xy, xz, yz), all parts together."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mass = model.body_mass[1:]
    com = mass @ data.xipos[1:] / mass.sum()
    second = np.zeros((3, 3))
    for weight, at, frame, own in zip(mass, data.xipos[1:], data.ximat[1:], model.body_inertia[1:], strict=True):
        away, turn = at - com, frame.reshape(3, 3)
        second += turn @ np.diag(own) @ turn.T + weight * (away @ away * np.eye(3) - np.outer(away, away))
    return float(mass.sum()), com, second[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] / mass.sum()


def _range(model: "mujoco.MjModel", joint: int) -> list[float]:
    """Its range, degrees or m; a joint that turns for ever has 0 to 0."""
    import mujoco

    turns = model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_SLIDE
    return [
        round(float(np.degrees(end) if turns else end), 3) for end in model.jnt_range[joint] * model.jnt_limited[joint]
    ]


def _text(spec: "mujoco.MjSpec") -> str:
    """The model as the engine writes it, without what a plan's world owns."""
    return re.sub(r' (?:content_type|colorspace)="[^"]*"', "", spec.to_xml())
