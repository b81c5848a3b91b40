"""A USD stage, opened bounded and in its place, and the meshes that it draws as pieces of one material each.

Subdivision surfaces are taken as their cages, and colours as the preview surface has them. Read by `usd-core` (the extra `scenes`).
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import IntakeError
from . import collada_claims, declared_sizes

Array = np.ndarray
GREY = (0.7, 0.7, 0.7, 1.0)
GAMMA = 2.2
"""USD's colours are of light; ours are sRGB values."""
SHAPES = ("Cube", "Sphere", "Cylinder", "Cone", "Capsule")
FIRST_MOMENT = "it changes with time: its first moment was taken"
ANEW = "open it in a modelling program, and export it anew, as USD or as GLB"


def frame(path: Path) -> tuple[str, float]:
    """The up axis, `Y` or `Z`, and metres in a unit, 0 where the file does not say."""
    stage, usd = _opened(path)
    up = str(usd.UsdGeom.GetStageUpAxis(stage))
    told = usd.UsdGeom.StageHasAuthoredMetersPerUnit(stage)
    unit = float(usd.UsdGeom.GetStageMetersPerUnit(stage)) if told else 0.0
    return ("Z" if up == "Z" else "Y"), (unit if 1e-9 < unit < 1e6 else 0.0)


def pieces(path: Path) -> tuple[list[dict[str, Any]], list[str]]:
    """Each piece with `vertices`, `faces`, `uv`, `image` (H, W, 3) or None, `rgba`, `roughness`, `metallic`; and what to say.

    Raises:
        IntakeError: it cannot be opened, reads what lies outside of its folder, or holds too much.
    """
    stage, usd = _opened(path)
    first = usd.Usd.TimeCode.EarliestTime()  # what has values by time alone has none at USD's default time
    poses = usd.UsdGeom.XformCache(first)
    found: list[dict[str, Any]] = []
    pictures: dict[str, Array | None] = {}
    said: dict[str, None] = {}
    total = 0
    for prim in usd.Usd.PrimRange(stage.GetPseudoRoot(), usd.Usd.TraverseInstanceProxies()):
        if prim.IsA(usd.UsdGeom.PointInstancer):
            said["what it scatters by a point instancer is left out"] = None
        if not (prim.IsA(usd.UsdGeom.Mesh) or prim.GetTypeName() in SHAPES):
            continue
        shown = usd.UsdGeom.Imageable(prim)
        if _moves(prim, usd):
            said[FIRST_MOMENT] = None
        if shown.ComputeVisibility(first) == usd.UsdGeom.Tokens.invisible:
            continue
        if shown.ComputePurpose() in (usd.UsdGeom.Tokens.guide, usd.UsdGeom.Tokens.proxy):
            continue
        mesh = _mesh(prim, usd, path.name, said) if prim.IsA(usd.UsdGeom.Mesh) else _shape(prim, usd, said)
        if mesh is None:
            continue
        total += len(mesh["faces"])
        if total > declared_sizes.MOST_FACES:
            raise declared_sizes.too_many(total, path.name)
        matrix = np.array(poses.GetLocalToWorldTransform(prim), float)
        mesh["vertices"] = mesh["vertices"] @ matrix[:3, :3] + matrix[3, :3]
        if np.linalg.det(matrix[:3, :3]) < 0:
            mesh["faces"] = mesh["faces"][:, ::-1]
        found += _dressed(prim, mesh, usd, path.parent, pictures, said)
    return found, [*said]


def _opened(path: Path) -> tuple[Any, Any]:
    try:
        import pxr.Usd
        import pxr.UsdGeom
        import pxr.UsdShade
    except ImportError as error:
        raise IntakeError(
            "no_reader", "USD is read by usd-core, which is not installed", path.name,
            'pip install "worldwright[scenes]", or convert the file to GLB',
        ) from error  # fmt: skip
    try:
        stage = pxr.Usd.Stage.Open(str(path))
    except Exception as error:  # a parser may raise anything on a stranger's file
        cause = _cause(str(error), path) or type(error).__name__
        raise IntakeError("unreadable", f"it cannot be read: {cause}", path.name, ANEW) from error
    root = path.parent.resolve()
    for layer in stage.GetUsedLayers():
        if layer.realPath and not Path(layer.realPath).resolve().is_relative_to(root):
            raise IntakeError(
                "climbs_out", f"it reads the layer {layer.identifier[-80:]}, which lies outside of its folder", path.name,
                "flatten it into one file (`usdcat --flatten`), then add that",
            )  # fmt: skip
    return stage, pxr


def _cause(said: str, path: Path) -> str:
    """What the reader says first of an error, without the folders of this machine."""
    told = re.search(r"Error in .*? : '(.+)", said)
    words = told[1] if told else next((line for line in said.splitlines() if line.strip()), "")
    words = words.replace(f"{path.parent}/", "").replace(f"{path.parent.resolve()}/", "")
    return re.sub(r"(?<![\w:/<])/(?:[^\s/'\"@]+/)+", "", words).strip().rstrip("'")[:200]


def _moves(prim: Any, usd: Any) -> bool:
    """Whether it goes somewhere else in time, or is hidden, itself or by what it is in."""
    while prim and not prim.IsPseudoRoot():
        if usd.UsdGeom.Xformable(prim) and usd.UsdGeom.Xformable(prim).TransformMightBeTimeVarying():
            return True
        if usd.UsdGeom.Imageable(prim) and usd.UsdGeom.Imageable(prim).GetVisibilityAttr().ValueMightBeTimeVarying():
            return True
        prim = prim.GetParent()
    return False


def _first(attribute: Any, usd: Any, said: dict[str, None]) -> Any:
    """The value of an attribute at its first moment, None where it has none; what to say is added."""
    if attribute.ValueMightBeTimeVarying():
        said[FIRST_MOMENT] = None
    return attribute.Get(usd.Usd.TimeCode.EarliestTime())


def _mesh(prim: Any, usd: Any, name: str, said: dict[str, None]) -> dict[str, Any] | None:
    mesh = usd.UsdGeom.Mesh(prim)
    points, counts, corners = (
        np.array(_first(attribute, usd, said) or [], kind)
        for attribute, kind in (
            (mesh.GetPointsAttr(), float), (mesh.GetFaceVertexCountsAttr(), np.int64), (mesh.GetFaceVertexIndicesAttr(), np.int64),
        )
    )  # fmt: skip
    if not len(points) or not len(counts):
        return None
    place = f"{name}, {prim.GetPath()}"
    if counts.min() < 0 or counts.sum() != len(corners) or ((corners < 0) | (corners >= len(points))).any():
        raise IntakeError("truncated", "its faces name corners that are not there", place, declared_sizes.AGAIN)
    if int(np.maximum(counts - 2, 0).sum()) > declared_sizes.MOST_FACES:
        raise declared_sizes.too_many(int((counts - 2).sum()), place)
    scheme = mesh.GetSubdivisionSchemeAttr()
    if scheme.HasAuthoredValue() and _first(scheme, usd, said) != "none":
        said["a subdivision surface is taken as its cage"] = None
    fan, owner = triangulated(counts)
    if _first(mesh.GetOrientationAttr(), usd, said) == "leftHanded":
        fan = fan[:, ::-1]
    uv = _uv(prim, usd, len(points), corners, said)
    if uv is not None and len(uv) == len(corners) != len(points):  # by corner: each corner becomes a vertex of its own
        points, faces = points[corners], fan
    else:
        faces = corners[fan]
    return {"vertices": points, "faces": faces, "uv": uv, "owner": owner}


def triangulated(counts: Array) -> tuple[Array, Array]:
    """Fans (T, 3) into the corners of polygons of so many corners each, and the polygon (T,) that each triangle is of."""
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    fans, owners = [], []
    for sides in np.unique(counts[counts >= 3]):
        own = np.flatnonzero(counts == sides)
        for k in range(1, int(sides) - 1):
            fans.append(np.stack([starts[own], starts[own] + k, starts[own] + k + 1], axis=1))
            owners.append(own)
    if not fans:
        return np.zeros((0, 3), np.int64), np.zeros(0, np.int64)
    return np.concatenate(fans), np.concatenate(owners)


def _uv(prim: Any, usd: Any, count: int, corners: Array, said: dict[str, None]) -> Array | None:
    for primvar in usd.UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
        if str(primvar.GetTypeName()) not in ("texCoord2f[]", "texCoord2d[]", "texCoord2h[]", "float2[]"):
            continue
        if primvar.ValueMightBeTimeVarying():
            said[FIRST_MOMENT] = None
        uv = np.array(primvar.ComputeFlattened(usd.Usd.TimeCode.EarliestTime()) or [], float)
        if uv.shape in ((len(corners), 2), (count, 2)) and np.isfinite(uv).all():
            return uv
    return None


def _shape(prim: Any, usd: Any, said: dict[str, None]) -> dict[str, Any]:
    """A shape that USD knows by name, along its axis."""
    import trimesh

    def of(name: str, otherwise: float) -> float:
        value = _first(prim.GetAttribute(name), usd, said) if prim.HasAttribute(name) else None
        return float(value) if value is not None else otherwise

    kind, high, radius = prim.GetTypeName(), of("height", 2.0), of("radius", 1.0)
    if kind == "Cube":
        made = trimesh.creation.box([of("size", 2.0)] * 3)
    elif kind == "Sphere":
        made = trimesh.creation.icosphere(3, radius)
    elif kind == "Cone":
        made = trimesh.creation.cone(radius, high)
        made.apply_translation((0, 0, -high / 2))
    elif kind == "Capsule":
        made = trimesh.creation.capsule(of("height", 1.0), of("radius", 0.5))
        made.apply_translation((0, 0, -made.bounds.mean(axis=0)[2]))
    else:
        made = trimesh.creation.cylinder(radius, high)
    axis = _first(prim.GetAttribute("axis"), usd, said) if prim.HasAttribute("axis") else "Z"
    turn = {"X": (2, 0, 1), "Y": (1, 2, 0)}.get(str(axis), (0, 1, 2))
    points = np.asarray(made.vertices, float)[:, turn]
    faces = np.asarray(made.faces, np.int64)
    return {"vertices": points, "faces": faces, "uv": None, "owner": np.arange(len(faces))}


def _dressed(
    prim: Any, mesh: dict[str, Any], usd: Any, folder: Path, pictures: dict[str, Array | None], said: dict[str, None]
) -> Iterator[dict[str, Any]]:
    """The mesh by material: its own, and those of the subsets that have one."""
    binding = usd.UsdShade.MaterialBindingAPI(prim)
    left = np.ones(len(mesh["owner"]), bool)
    groups = []
    for subset in binding.GetMaterialBindSubsets():
        own = np.isin(mesh["owner"], np.array(_first(subset.GetIndicesAttr(), usd, said) or [], np.int64)) & left
        left &= ~own
        groups.append((subset.GetPrim(), own))
    for holder, own in [*groups, (prim, left)]:
        if not own.any():
            continue
        look = _look(holder, prim, usd, folder, pictures, said)
        yield {"vertices": mesh["vertices"], "faces": mesh["faces"][own], "uv": mesh["uv"], **look}


def _look(
    holder: Any, prim: Any, usd: Any, folder: Path, pictures: dict[str, Array | None], said: dict[str, None]
) -> dict[str, Any]:
    look: dict[str, Any] = {"image": None, "rgba": GREY, "roughness": 0.6, "metallic": 0.0}
    material = usd.UsdShade.MaterialBindingAPI(holder).ComputeBoundMaterial()[0]
    shader = material.ComputeSurfaceSource()[0] if material else None
    if not shader:
        tint = _first(usd.UsdGeom.Gprim(prim).GetDisplayColorAttr(), usd, said)
        if tint:
            look["rgba"] = _seen(np.mean(np.array(tint, float), axis=0), 1.0)
        return look
    colour, picture = _input(shader, "diffuseColor", usd, said)
    opacity, _ = _input(shader, "opacity", usd, said)
    look["rgba"] = _seen(
        np.array(colour if colour is not None else (0.18,) * 3, float), float(1.0 if opacity is None else opacity)
    )
    if picture:
        if picture not in pictures:
            pictures[picture] = _picture(folder, picture)
        look["image"] = pictures[picture]
        if look["image"] is None:
            said[f"its picture {picture[-80:]} is not beside it, or cannot be read"] = None
        else:
            look["rgba"] = (1.0, 1.0, 1.0, look["rgba"][3])
    for name, otherwise in (("roughness", 0.5), ("metallic", 0.0)):
        value, _ = _input(shader, name, usd, said)
        look[name] = float(np.clip(otherwise if value is None else value, 0.0, 1.0))
    look["roughness"] = max(look["roughness"], 0.05)
    return look


def _input(shader: Any, name: str, usd: Any, said: dict[str, None]) -> tuple[Any, str]:
    """The value of an input of a preview surface, and the file of a picture that is plugged into it."""
    entry = shader.GetInput(name)
    if not entry:
        return None, ""
    for source in entry.GetValueProducingAttributes():
        owner = usd.UsdShade.Shader(source.GetPrim())
        if owner and owner.GetPrim() != shader.GetPrim() and _first(owner.GetIdAttr(), usd, said) == "UsdUVTexture":
            file = owner.GetInput("file")
            path = _first(file.GetAttr(), usd, said) if file else None
            return None, str(path.path) if path else ""
        return _first(source, usd, said), ""
    return None, ""


def _seen(colour: Array, opacity: float) -> tuple[float, float, float, float]:
    red, green, blue = (float(c) for c in np.clip(np.nan_to_num(colour), 0.0, 1.0) ** (1 / GAMMA))
    return red, green, blue, float(np.clip(opacity, 0.05, 1.0))


def _picture(folder: Path, named: str) -> Array | None:
    """A picture's pixels (H, W, 3), RGB, by the name that the file gives it; None where it is not there or is none."""
    import cv2

    found = collada_claims.below(folder, named)
    if found is None or found.stat().st_size > declared_sizes.MOST_BYTES:
        return None
    data = found.read_bytes()
    declared_sizes.picture(data[: declared_sizes.HEADER_BYTES], found.name)
    pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    return None if pixels is None else np.asarray(pixels[:, :, ::-1], np.uint8)
