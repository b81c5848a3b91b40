"""What a 3MF file has a printer build, as GLB: its unit, its parts where they stand, and their colours.

By the 3MF core specification 1.3, the materials' and the production extension: a package of model parts, in each of which objects
are meshes or are put together of objects; z is up, the unit is the model's own.
"""

import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

import numpy as np

from ..errors import IntakeError
from .declared_sizes import AGAIN, FEWER, MOST_BYTES, MOST_FACES, too_many

Array = np.ndarray
UNITS = {"micron": 1e-6, "millimeter": 1e-3, "centimeter": 1e-2, "inch": 0.0254, "foot": 0.3048, "meter": 1.0}
ROOT = "3D/3dmodel.model"
"""Where nearly every program puts the part that says what is built."""
MOST_PLACED, MOST_DEPTH, MOST_PARTS = 20_000, 64, 2_000
GREY = "#B3B3B3"
COLOURED = {"base": "displaycolor", "color": "color"}
"""An element of a list of colours, and its attribute that says one."""
Key = tuple[str, str]
"""The part, and the id in it."""


@dataclass
class _Object:
    corners: list[list[float]] = field(default_factory=list)
    faces: list[list[int]] = field(default_factory=list)
    colours: list[str] = field(default_factory=list)
    """Of each face."""
    holds: list[tuple[Key, Array]] = field(default_factory=list)
    """What it is put together of, and how each is placed."""


@dataclass
class _Read:
    objects: dict[Key, _Object] = field(default_factory=dict)
    colours: dict[Key, list[str]] = field(default_factory=dict)
    builds: dict[str, list[tuple[Key, Array]]] = field(default_factory=dict)
    units: dict[str, float] = field(default_factory=dict)
    faces: int = 0


def as_glb(path: Path) -> tuple[bytes, list[str]]:
    """A GLB file, in metres but with the axes of the 3MF, of what is built; and what is worth saying of it.

    Raises:
        IntakeError: it is no 3MF, is not whole, or holds too much.
    """
    import trimesh

    read = _Read()
    try:
        with zipfile.ZipFile(path) as held:
            _models(held, read, path.name)
    except (zipfile.BadZipFile, OSError, RuntimeError, NotImplementedError, EOFError, ValueError) as error:
        raise IntakeError("truncated", f"it cannot be unpacked: {error}", path.name, AGAIN) from error
    root = next((part for part in read.builds if part == ROOT), next(iter(read.builds), ""))
    scene = trimesh.Scene()
    for points, thing in _placed(read, read.builds.get(root, []), path.name):
        metres = points * read.units[root]
        faces, colours = np.array(thing.faces), np.array(thing.colours)
        if faces.min() < 0 or faces.max() >= len(points):
            raise IntakeError("truncated", f"a triangle names vertex {faces.max()} of {len(points)}", path.name, AGAIN)
        for colour in dict.fromkeys(thing.colours):
            look = trimesh.visual.material.PBRMaterial(baseColorFactor=_light(colour), roughnessFactor=0.6)
            visual = trimesh.visual.TextureVisuals(material=look)
            mesh = trimesh.Trimesh(metres, faces[colours == colour], process=False, visual=visual)
            mesh.remove_unreferenced_vertices()
            scene.add_geometry(mesh)
    if not scene.geometry:
        raise IntakeError("no_mesh", "it has nothing built", path.name, "export the object itself")
    return scene.export(file_type="glb"), []


def _models(held: zipfile.ZipFile, read: _Read, name: str) -> None:
    """Read every model part of a package."""
    parts = [row for row in held.infolist() if row.filename.lower().endswith(".model")]
    if not parts or len(parts) > MOST_PARTS:
        raise IntakeError("no_mesh", f"there are {len(parts)} models in it", name, "export it as 3MF")
    left = MOST_BYTES
    for row in parts:
        with held.open(row) as member:
            content = member.read(left + 1)  # whatever its entry claims
        left -= len(content)
        if left < 0:
            raise IntakeError("too_large", f"it unpacks to more than {MOST_BYTES >> 20} MB", name, FEWER)
        try:
            _model(content, row.filename.lstrip("/"), read, name)
        except (expat.ExpatError, KeyError, ValueError, IndexError) as error:
            cause = f"{row.filename[:80]} cannot be read: {type(error).__name__}: {error}"
            raise IntakeError("truncated", cause[:300], name, AGAIN) from error


def _model(content: bytes, part: str, read: _Read, name: str) -> None:
    """Read one model part."""
    thing, plain, group = _Object(), GREY, [GREY]
    reader = expat.ParserCreate(namespace_separator=" ")
    read.builds[part], read.units[part] = [], UNITS["millimeter"]

    def begin(tag: str, said: dict[str, str]) -> None:
        nonlocal thing, plain, group
        tag = tag.rpartition(" ")[2]
        own = {key.rpartition(" ")[2]: value for key, value in said.items()}
        if tag == "vertex":
            thing.corners.append([float(own[axis]) for axis in "xyz"])
        elif tag == "triangle":
            read.faces += 1
            if read.faces > MOST_FACES:
                raise too_many(read.faces, name)
            thing.faces.append([int(own[corner]) for corner in ("v1", "v2", "v3")])
            listed = read.colours.get((part, own["pid"]), [GREY]) if "pid" in own else group
            thing.colours.append(listed[int(own["p1"])] if "p1" in own and int(own["p1"]) < len(listed) else plain)
        elif tag == "object":
            thing = read.objects[part, own["id"]] = _Object()
            group = read.colours.get((part, own.get("pid", "")), [GREY])
            plain = group[min(int(own.get("pindex", 0)), len(group) - 1)]
        elif tag in ("component", "item"):
            where = own.get("path", part).lstrip("/")
            row = ((where, own["objectid"]), _transform(own.get("transform", "")))
            (thing.holds if tag == "component" else read.builds[part]).append(row)
        elif tag in ("basematerials", "colorgroup"):
            group = read.colours[part, own["id"]] = []
        elif tag in COLOURED:
            group.append(own[COLOURED[tag]])
        elif tag == "model":
            read.units[part] = UNITS[own.get("unit", "millimeter")]

    def entity(*_: Any) -> None:
        raise ValueError("it declares entities, which no program that writes 3MF does")

    reader.StartElementHandler, reader.EntityDeclHandler = begin, entity
    reader.Parse(content, True)


def _transform(said: str) -> Array:
    """(4, 3): a row of points, with 1 behind each, is multiplied by it.

    Raises:
        ValueError: it is not twelve finite numbers.
    """
    if not said.strip():
        return np.eye(4)[:, :3]
    rows = np.array(said.split(), float).reshape(4, 3)
    if not np.isfinite(rows).all():
        raise ValueError("a transform is no number")
    return rows


def _placed(read: _Read, rows: list[tuple[Key, Array]], name: str) -> list[tuple[Array, _Object]]:
    """Each mesh that is built, as often as it is, with its corners (V, 3) where they are.

    Raises:
        IntakeError: it holds itself, draws too much, or names what is not there.
    """
    found: list[tuple[Array, _Object]] = []
    waiting = [(key, at, 0) for key, at in reversed(rows)]
    faces = seen = 0
    while waiting:
        key, at, depth = waiting.pop()
        thing = read.objects.get(key)
        seen += 1
        if thing is None:
            raise IntakeError("truncated", f"it builds object {key[1][:40]}, which is not in it", name, AGAIN)
        if depth > MOST_DEPTH or seen > MOST_PLACED:
            raise IntakeError("too_large", "its objects hold each other without end, or far too often", name, FEWER)
        if thing.faces:
            faces += len(thing.faces)
            if faces > MOST_FACES:
                raise too_many(faces, name)
            corners = np.array(thing.corners, float).reshape(-1, 3)
            found.append((corners @ at[:3] + at[3], thing))
        for inner, own in reversed(thing.holds):
            waiting.append((inner, np.vstack([own[:3] @ at[:3], own[3] @ at[:3] + at[3]]), depth + 1))
    return found


def _light(colour: str) -> list[float]:
    """The factors of light of a colour such as #RRGGBB or #RRGGBBAA, as glTF has them.

    Raises:
        ValueError: it is none.
    """
    plain = colour.removeprefix("#")
    values = [int(plain[at : at + 2], 16) / 255 for at in range(0, len(plain), 2)]
    if len(values) not in (3, 4):
        return _light(GREY)
    return [*(value**2.2 for value in values[:3]), values[3] if len(values) == 4 else 1.0]
