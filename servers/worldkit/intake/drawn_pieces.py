"""What a mesh file draws: pieces of triangles, each with one material, in the file's own axes and unit.

The file is parsed by trimesh, USD by `usd_stage`, after `declared_sizes` has looked at it.
"""

import hashlib
import re
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import IntakeError
from . import collada_claims, declared_sizes, group_names, usd_stage

Array = np.ndarray
MOST_PIECES = 60
"""Of a file; each becomes a file, of which the confined process hands over at most 64 of a kind."""
MOST_PICTURED = 40
"""Of them those that keep a picture, where there are too many."""
LEAST_CORNERS = 4
"""MuJoCo takes no mesh of fewer."""
TEXTURE_PIXELS = 1024
"""Along the longer side of a texture that is kept."""
GAMMA = 2.2
"""sRGB's curve as a power, so that it goes for a factor on a picture, too."""
GREY = (0.7, 0.7, 0.7, 1.0)


@dataclass(frozen=True)
class Drawn:
    """One material's triangles.

    vertices: (V, 3). faces: (F, 3) into them, counter-clockwise from outside. uv: (V, 2), v up, or None. picture: (H, W, 3)
    sRGB uint8, or None. rgba: a factor on it, 0 to 1.
    """

    vertices: Array
    faces: Array
    uv: Array | None = None
    picture: Array | None = None
    rgba: tuple[float, float, float, float] = GREY
    roughness: float = 0.6
    metallic: float = 0.0
    part: str = ""
    """Which moving part it is of (`moving_parts`)."""

    def moved(self, turn: Array, shift: Array) -> "Drawn":
        """Every vertex turned by a matrix (3, 3) and then shifted (3,)."""
        return replace(self, vertices=self.vertices @ turn.T + shift)


def read(path: Path) -> tuple[list[Drawn], list[str]]:
    """The pieces of a file, and what is worth saying of them.

    Raises:
        IntakeError: it cannot be read as a mesh, or one of its numbers is none.
    """
    kind = path.suffix.lower()
    if kind in declared_sizes.USD:
        rows, said = usd_stage.pieces(path)
        if not rows:
            raise IntakeError("no_mesh", "there is no triangle in it", path.name, "export the object itself")
        return _bounded([_own(row, path.name, number) for number, row in enumerate(rows)], said)
    found = _parsed(path)
    pieces = [_piece(mesh, path.name, number, of_light=kind != ".dae") for number, mesh in enumerate(found)]
    by_vertex = any(getattr(mesh.visual, "kind", "") == "vertex" for mesh in found)
    return _bounded(pieces, ["colours by vertex became one colour a piece"] if by_vertex else [])


def _parsed(path: Path) -> list[Any]:
    """The meshes of a file, by trimesh."""
    import trimesh

    if path.suffix.lower() == ".dae":
        try:
            import collada  # noqa: F401 - trimesh reads COLLADA by it
        except ImportError as error:
            raise IntakeError(
                "no_reader", "COLLADA is read by pycollada, which is not installed", path.name,
                'pip install "worldwright[scenes]", or convert the file to GLB',
            ) from error  # fmt: skip
    try:
        scene: Any = trimesh.load_scene(**_source(path), process=False)
        total = sum(len(getattr(scene.geometry[scene.graph[n][1]], "faces", ())) for n in scene.graph.nodes_geometry)
        if total > declared_sizes.MOST_FACES:  # each is copied as often as it is drawn, from here on
            raise declared_sizes.too_many(total, path.name)
        found: list[Any] = [mesh for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces)]
    except (MemoryError, IntakeError):
        raise
    except Exception as error:  # a parser may raise anything on a stranger's file
        said = str(error).strip().splitlines()
        cause = f"it cannot be read: {said[0][:200] if said else type(error).__name__}"
        raise IntakeError(
            "unreadable", cause, path.name, "open it in a modelling program, and export it anew"
        ) from error
    if not found:
        raise IntakeError("no_mesh", "there is no triangle in it", path.name, "export the object itself")
    return found


def _bounded(pieces: list[Drawn], also: list[str]) -> tuple[list[Drawn], list[str]]:
    """At most so many pieces that the engine takes, and what was done for it, with what else is to be said."""
    pieces, said = _corners(pieces)
    if len(pieces) > MOST_PIECES:
        before, pieces = len(pieces), [_joined(group) for group in _by_look(pieces)]
        said.append(f"of {before} pieces those of one look became one")
        if len(pieces) > MOST_PIECES:
            said.append(
                f"of {len(pieces)} looks the smaller ones took on the nearest colour of the {MOST_PIECES} largest"
            )
            pieces = _few(pieces)
    return pieces, [*said, *also]


def _source(path: Path) -> dict[str, Any]:
    """What trimesh is to read: the file, or its bytes in the plain form that trimesh knows of its format."""
    import trimesh

    kind = path.suffix.lower()
    if kind == ".stl":
        with path.open("rb") as file:
            head = file.read(84)
            most = declared_sizes.stl_bytes(head) if len(head) == 84 else 0
            if 84 <= most < path.stat().st_size:  # without what lies behind the triangles
                return {"file_obj": BytesIO(head + file.read(most - 84)), "file_type": "stl"}
    if kind == ".obj":
        data = path.read_bytes()
        apart = {"split_groups": True, "split_objects": True} if group_names.MARK in data else {}
        if b"\t" in data or b"\\" in data:
            plain = re.sub(rb"\\\r?\n", b" ", data).replace(b"\t", b" ")
            beside = trimesh.visual.resolvers.FilePathResolver(str(path))
            return {"file_obj": BytesIO(plain), "file_type": "obj", "resolver": beside, **apart}
        return {"file_obj": path, **apart}
    if kind == ".dae":
        return {"file_obj": BytesIO(path.read_bytes()), "file_type": "dae", "resolver": Beside(path.parent)}
    return {"file_obj": path}


class Beside:
    """Gives trimesh the pictures that a scene names, as far as they lie below its folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def get(self, name: str) -> bytes:
        """The bytes of a file.

        Raises:
            FileNotFoundError: there is none.
        """
        found = collada_claims.below(self.folder, name)
        if found is None:
            raise FileNotFoundError(name)
        return found.read_bytes()


def _piece(mesh: Any, name: str, number: int, *, of_light: bool) -> Drawn:
    vertices, faces = np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int64)
    _sound(vertices, faces, name, number)
    uv, picture, rgba, rough, metal = _look(mesh, of_light)
    return Drawn(
        vertices, faces, uv, picture, rgba, rough, metal, group_names.part_of(str(mesh.metadata.get("name", "")))
    )


def _own(row: dict[str, Any], name: str, number: int) -> Drawn:
    """A piece of a stage, as `usd_stage.pieces` gives it, without the corners that other pieces of its mesh have."""
    _sound(row["vertices"], row["faces"], name, number)
    used, faces = np.unique(row["faces"], return_inverse=True)
    uv = row["uv"] if row["image"] is not None and row["uv"] is not None else None
    picture = _shrunk(row["image"]) if uv is not None else None
    look = (row["rgba"], row["roughness"], row["metallic"])
    return Drawn(row["vertices"][used], faces.reshape(-1, 3), None if uv is None else uv[used], picture, *look)


def _sound(vertices: Array, faces: Array, name: str, number: int) -> None:
    bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(bad):
        place = f"{name}, piece {number}, vertex {bad[0]}"
        raise IntakeError(
            "not_finite", f"{len(bad)} of {len(vertices)} vertices are no numbers", place, "export it anew without them"
        )
    if faces.min() < 0 or faces.max() >= len(vertices):
        place = f"{name}, piece {number}"
        raise IntakeError(
            "truncated", f"a face names vertex {faces.max()} of {len(vertices)}", place, "get the file once more"
        )


def _look(
    mesh: Any, of_light: bool
) -> tuple[Array | None, Array | None, tuple[float, float, float, float], float, float]:
    """uv, picture, colour, roughness and metalness of a piece; whatever of them cannot be read is left out.

    of_light: whether the factors of its physically based materials are of light, as glTF's are.
    """
    visual = mesh.visual
    if visual.kind == "vertex" or visual.kind == "face":
        colours = np.asarray(visual.vertex_colors if visual.kind == "vertex" else visual.face_colors, float) / 255
        return None, None, _colour(colours.mean(axis=0)), 0.6, 0.0
    material = getattr(visual, "material", None)
    if material is None:
        return None, None, GREY, 0.6, 0.0
    uv = getattr(visual, "uv", None)
    uv = None if uv is None else np.asarray(uv, float)
    if uv is not None and (uv.shape != (len(mesh.vertices), 2) or not np.isfinite(uv).all()):
        uv = None
    image = getattr(material, "baseColorTexture", None)
    image = getattr(material, "image", None) if image is None else image
    picture = _picture(image) if uv is not None and image is not None else None
    factor = getattr(material, "baseColorFactor", None)
    if factor is None and picture is None:
        factor = getattr(material, "diffuse", None)
    rough, metal = getattr(material, "roughnessFactor", None), getattr(material, "metallicFactor", None)
    pbr = hasattr(material, "baseColorFactor")
    colour = (1.0, 1.0, 1.0, 1.0)
    if factor is not None:
        colour = _colour(np.asarray(factor, float).ravel() / (255 if np.max(factor) > 1 else 1))
        if pbr and of_light:  # ours are of an sRGB value
            colour = _colour(np.array([*(share ** (1 / GAMMA) for share in colour[:3]), colour[3]]))
    said = getattr(material, "kwargs", {})  # of an OBJ: how opaque it is, and how sharply it mirrors
    opaque, sharp = _number(said.get("d")), _number(getattr(material, "glossiness", None))
    if opaque is not None and 0 < opaque < 1:
        colour = (*colour[:3], max(opaque, 0.15))
    if sharp is not None and sharp >= 0 and not pbr:
        rough = (2 / (sharp + 2)) ** 0.25  # B. Karis, "Specular BRDF reference" (2013): from Blinn's exponent
    return (
        uv if picture is not None else None, picture, colour,
        float(np.clip(rough if rough is not None else (1.0 if pbr else 0.6), 0.05, 1.0)),
        float(np.clip(metal if metal is not None else 0.0, 0.0, 1.0)),
    )  # fmt: skip


def _number(said: Any) -> float | None:
    """A number that a material says, alone or as a row of one."""
    try:
        found = float(np.ravel(np.asarray(said, float))[0])
    except (TypeError, ValueError, IndexError):
        return None
    return found if np.isfinite(found) else None


def _colour(values: Array) -> tuple[float, float, float, float]:
    full = np.clip(np.nan_to_num([*values[:4], *(1.0,) * max(0, 4 - len(values))]), 0.0, 1.0)
    return (float(full[0]), float(full[1]), float(full[2]), float(max(full[3], 0.05)))


def _picture(image: Any) -> Array | None:
    """A texture's pixels (H, W, 3), shrunk to what is kept; None where it cannot be decoded."""
    try:
        return _shrunk(np.asarray(image.convert("RGB"), np.uint8))
    except MemoryError:
        raise
    except Exception:  # a decoder may raise anything on a stranger's picture
        return None


def _shrunk(pixels: Array) -> Array:
    """Pixels (H, W, 3) of a texture of at most the size that is kept."""
    import cv2

    longer = max(pixels.shape[:2])
    if longer > TEXTURE_PIXELS:
        share = TEXTURE_PIXELS / longer
        size = max(1, round(pixels.shape[1] * share)), max(1, round(pixels.shape[0] * share))
        pixels = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), np.uint8)
    return pixels


def _by_look(pieces: list[Drawn]) -> list[list[Drawn]]:
    """Pieces of one picture and colour together; a picture is the same where its pixels are."""
    groups: dict[tuple[Any, ...], list[Drawn]] = {}
    digests: dict[int, bytes] = {}  # a picture that several pieces share is looked at once
    for piece in pieces:
        picture = piece.picture
        if picture is not None and id(picture) not in digests:
            digests[id(picture)] = hashlib.sha256(repr(picture.shape).encode() + picture.tobytes()).digest()
        look = digests[id(picture)] if picture is not None else b""
        groups.setdefault((piece.part, look, *(round(c, 2) for c in piece.rgba)), []).append(piece)
    return [*groups.values()]


def _corners(pieces: list[Drawn]) -> tuple[list[Drawn], list[str]]:
    """The pieces without single triangles, which join those of their look, else the plain one whose colour is nearest; and what to
    say of it."""
    single = [piece for piece in pieces if len(piece.vertices) < LEAST_CORNERS]
    if not single:
        return pieces, []
    groups: list[list[Drawn]] = []
    alone: list[Drawn] = []
    for look in _by_look(pieces):
        whole = [[piece] for piece in look if len(piece.vertices) >= LEAST_CORNERS]
        little = [piece for piece in look if len(piece.vertices) < LEAST_CORNERS]
        if whole or len(little) > 1:
            whole = whole or [[]]
            whole[0] += little
        else:
            alone += [_plain(piece) for piece in little]
        groups += whole
    said = f"{len(single)} pieces of one triangle each joined those of their look"
    plain = [group for group in groups if group[0].picture is None]
    if alone and plain:
        colours = np.array([group[0].rgba for group in plain])
        for piece in alone:
            plain[int(np.linalg.norm(colours - piece.rgba, axis=1).argmin())].append(piece)
        said += ", or of the nearest colour"
    elif len(alone) > 1:
        groups.append(alone)
        said = f"{len(single)} pieces of one triangle each joined, in one colour where their looks differ"
    elif alone and groups:
        said += "; one of a look of its own is left out"
    elif alone:
        return pieces, []  # nothing but a triangle: it has no volume, which is told
    return [_joined(group) for group in groups], [said]


def _few(pieces: list[Drawn]) -> list[Drawn]:
    """At most so many pieces: those of most triangles stay, the others join the plain one whose colour is nearest."""
    order = sorted(pieces, key=lambda piece: -len(piece.faces))
    pictured = [piece for piece in order if piece.picture is not None]
    plain = [piece for piece in order if piece.picture is None] + [_plain(piece) for piece in pictured[MOST_PICTURED:]]
    pictured = pictured[:MOST_PICTURED]
    plain.sort(key=lambda piece: -len(piece.faces))
    stay = MOST_PIECES - len(pictured)
    groups = [[piece] for piece in plain[:stay]]
    colours = np.array([piece.rgba for piece in plain[:stay]])
    for piece in plain[stay:]:
        groups[int(np.linalg.norm(colours - piece.rgba, axis=1).argmin())].append(piece)
    return [*pictured, *(_joined(group) for group in groups)]


def _plain(piece: Drawn) -> Drawn:
    """A piece in the mean colour of its picture instead of it."""
    if piece.picture is None:
        return piece
    mean = piece.picture.reshape(-1, 3).mean(axis=0) / 255 * piece.rgba[:3]
    return replace(piece, uv=None, picture=None, rgba=_colour(np.array([*mean, piece.rgba[3]])))


def _joined(group: list[Drawn]) -> Drawn:
    starts = np.cumsum([0, *(len(piece.vertices) for piece in group[:-1])])
    return replace(
        group[0],
        vertices=np.concatenate([piece.vertices for piece in group]),
        faces=np.concatenate([piece.faces + start for piece, start in zip(group, starts, strict=True)]),
        uv=None if group[0].uv is None else np.concatenate([piece.uv for piece in group if piece.uv is not None]),
    )
