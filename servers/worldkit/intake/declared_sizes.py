"""What a mesh file claims, looked at before anything is made of it: how many faces, how large its pictures, whether it is whole.

A header is cheap to read and cheap to forge: too much is refused by the claim alone, and a claim that the file's length does
not bear out is a file that was cut off.
"""

import json
import struct
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ..errors import IntakeError
from . import collada_claims

USD = (".usd", ".usda", ".usdc")
SUFFIXES = (".glb", ".obj", ".stl", ".ply", ".off", ".dae", *USD)
FIRST_AS_GLB = (".gltf", ".3mf")
"""What becomes a GLB file before anything else is asked of it: `as_glb`."""
PICTURES = (".png", ".jpg", ".jpeg")
MOST_BYTES = 512 << 20
MOST_FACES = 2_000_000
MOST_PIXELS = 8_192
"""Along one side of a picture."""
HEADER_BYTES = 1 << 16
FEWER = "reduce it to fewer faces in a modelling program, then add it again"
SMALLER = f"shrink the picture to at most {MOST_PIXELS} pixels along a side, then add the file again"
AGAIN = "get the file once more: it is not whole"
COMPONENT = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
PLY_BYTES = {
    "char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8,
    "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "float32": 4, "float64": 8,
}  # fmt: skip


def check(path: Path) -> int:
    """How many triangles a file claims, at most.

    Raises:
        IntakeError: it claims too much, is not whole, or is none of `SUFFIXES`.
    """
    size = path.stat().st_size
    if size == 0:
        raise IntakeError("truncated", "the file is empty", path.name, AGAIN)
    if size > MOST_BYTES:
        raise IntakeError("too_large", f"it is larger than {MOST_BYTES >> 20} MB", path.name, FEWER)
    reader = {
        ".glb": _glb, ".obj": _obj, ".stl": _stl, ".ply": _ply, ".off": _off, ".dae": _dae, **dict.fromkeys(USD, _usd),
    }.get(path.suffix.lower())  # fmt: skip
    if reader is None:
        known = ", ".join((*SUFFIXES, *FIRST_AS_GLB))
        raise IntakeError(
            "unknown_format", f"{path.suffix or 'no ending'} is none of {known}", path.name, "convert it to one of them"
        )
    return reader(path, size)


def too_many(count: int, place: str) -> IntakeError:
    """The refusal of so many faces."""
    return IntakeError("too_many_faces", f"it claims {count:,} faces, more than {MOST_FACES:,}", place, FEWER)


def _few(count: int, place: str) -> int:
    if count > MOST_FACES:
        raise too_many(count, place)
    return count


def _cut(path: Path, said: str, needs: int, has: int) -> IntakeError:
    return IntakeError("truncated", f"{said}, which needs {needs:,} bytes, and the file has {has:,}", path.name, AGAIN)


# -- GLB -------------------------------------------------------------------------------------------------------------


def _glb(path: Path, size: int) -> int:
    with path.open("rb") as file:
        head = file.read(20)
        if len(head) < 20 or head[:4] != b"glTF":
            raise IntakeError("no_mesh", "it does not begin as a GLB file does", path.name, "export it as binary glTF")
        version, length, text_length, kind = struct.unpack("<IIII", head[4:])
        if version != 2:
            raise IntakeError("unknown_format", f"it is of glTF version {version}", path.name, "export it as glTF 2.0")
        if length > size or 20 + text_length > size:
            raise _cut(path, "its header speaks of a longer file", max(length, 20 + text_length), size)
        if kind != 0x4E4F534A or text_length > 64 << 20:
            raise IntakeError("no_mesh", "its first chunk is no description of at most 64 MB", path.name, AGAIN)
        text = file.read(text_length)
        rest = file.read(8)
        data = struct.unpack("<I", rest[:4])[0] if len(rest) == 8 else 0
        start = 28 + text_length
        if data and start + data > size:
            raise _cut(path, f"its data are said to be {data:,} bytes", start + data, size)
        try:
            scene = json.loads(text)
            if not isinstance(scene, dict):
                raise ValueError("it is no object")
        except (ValueError, RecursionError) as error:
            raise IntakeError("no_mesh", f"its description is no JSON: {error}", path.name, AGAIN) from error
        packed = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"} & set(_rows(scene, "extensionsRequired"))
        if packed:
            raise IntakeError(
                "unknown_format",
                f"its meshes are packed ({', '.join(sorted(packed))})",
                path.name,
                "export it without compression",
            )
        total = _glb_faces(path, scene, data)
        _glb_pictures(path, scene, file, start)
    return total


def _glb_faces(path: Path, scene: dict[str, Any], data: int) -> int:
    accessors, views = _rows(scene, "accessors"), _rows(scene, "bufferViews")
    for number, row in enumerate(accessors):
        count = int(row.get("count") or 0)
        place = f"{path.name}, accessor {number}"
        _few(count // 3, place)
        view = row.get("bufferView")
        if view is None:
            continue
        if not (isinstance(view, int) and 0 <= view < len(views)):
            raise IntakeError("truncated", f"it reads view {view!r} of {len(views)}", place, AGAIN)
        needs = count * COMPONENT.get(row.get("componentType"), 1) * WIDTH.get(row.get("type"), 1)
        offset = int(views[view].get("byteOffset") or 0) + int(row.get("byteOffset") or 0)
        if offset < 0 or offset + needs > data:
            raise IntakeError(
                "truncated", f"it reads {needs:,} bytes at {offset:,}, and there are {data:,}", place, AGAIN
            )
    used = [node.get("mesh") for node in _rows(scene, "nodes") if isinstance(node, dict)]
    total = 0
    for number, mesh in enumerate(_rows(scene, "meshes")):
        own = 0
        for part in _rows(mesh, "primitives"):
            index = part.get("indices", (part.get("attributes") or {}).get("POSITION"))
            if isinstance(index, int) and 0 <= index < len(accessors):
                own += int(accessors[index].get("count") or 0) // 3
        total = _few(total + own * max(used.count(number), 1), path.name)
    if not total:
        raise IntakeError(
            "no_mesh",
            "there is no triangle in it",
            path.name,
            "export the object itself, not the scene's lights or curves",
        )
    return total


def _glb_pictures(path: Path, scene: dict[str, Any], file: Any, start: int) -> None:
    import base64

    views = _rows(scene, "bufferViews")
    for number, row in enumerate(_rows(scene, "images")[:256]):
        view, uri = row.get("bufferView"), row.get("uri", "")
        if isinstance(view, int) and 0 <= view < len(views):
            file.seek(start + max(int(views[view].get("byteOffset") or 0), 0))
            picture(file.read(HEADER_BYTES), f"{path.name}, image {number}")
        elif isinstance(uri, str) and uri.startswith("data:"):
            said = uri[: 2 * HEADER_BYTES].partition(",")[2]
            picture(base64.b64decode(said[: len(said) // 4 * 4]), f"{path.name}, image {number}")


def _rows(where: Any, key: str) -> list[Any]:
    rows = where.get(key) if isinstance(where, dict) else None
    return rows if isinstance(rows, list) else []


# -- pictures ----------------------------------------------------------------------------------------------------------


def picture(head: bytes, place: str) -> tuple[int, int]:
    """Width and height of a picture by its first bytes, pixels; (0, 0) where they do not tell.

    Raises:
        IntakeError: it is larger than may be decoded.
    """
    width, height = _sides(head)
    if max(width, height) > MOST_PIXELS:
        raise IntakeError("picture_too_large", f"a picture of {width:,} x {height:,} pixels", place, SMALLER)
    return width, height


def _sides(head: bytes) -> tuple[int, int]:
    if head[:8] == b"\x89PNG\r\n\x1a\n" and len(head) >= 24:
        return struct.unpack(">II", head[16:24])
    if head[:2] != b"\xff\xd8":
        return (0, 0)
    at = 2
    while at + 9 < len(head):
        if head[at] != 0xFF:
            return (0, 0)
        mark, length = head[at + 1], struct.unpack(">H", head[at + 2 : at + 4])[0]
        if 0xC0 <= mark <= 0xCF and mark not in (0xC4, 0xC8, 0xCC):
            height, width = struct.unpack(">HH", head[at + 5 : at + 9])
            return width, height
        at += 2 + length
    return (0, 0)


# -- STL, PLY, OFF -----------------------------------------------------------------------------------------------------


def stl_bytes(head: bytes) -> int:
    """How long a binary STL of these first 84 bytes is, by what it claims."""
    return 84 + 50 * struct.unpack("<I", head[80:84])[0]


def _stl(path: Path, size: int) -> int:
    with path.open("rb") as file:
        head = file.read(84)
        count = struct.unpack("<I", head[80:84])[0] if len(head) == 84 else 0
        if len(head) == 84 and size >= stl_bytes(head):  # some programs write a little more behind the triangles
            return _few(count, path.name)
        if head.lstrip()[:5].lower() != b"solid":
            _few(count, path.name)
            raise _cut(path, f"its header speaks of {count:,} triangles", 84 + 50 * count, size)
        file.seek(0)
        faces, last = 0, b""
        for line in file:
            faces += line.lstrip()[:5].lower() == b"facet"
            last = line.strip() or last
            if faces > MOST_FACES:
                _few(faces, path.name)
    if not last.lower().startswith(b"endsolid"):
        raise IntakeError(
            "truncated", f"it ends within a triangle, at {last[:40].decode(errors='replace')!r}", path.name, AGAIN
        )
    return faces


def _ply(path: Path, size: int) -> int:
    with path.open("rb") as file:
        lines: list[list[str]] = []
        while not lines or lines[-1] != ["end_header"]:
            line = file.readline(1024)
            if not line or file.tell() > HEADER_BYTES:
                raise IntakeError("truncated", "its header has no end", path.name, AGAIN)
            lines.append(line.decode("ascii", errors="replace").split())
        body = size - file.tell()
    if lines[0] != ["ply"]:
        raise IntakeError("no_mesh", "it does not begin as a PLY file does", path.name, "export it as PLY")
    binary, needs, faces, element, count = True, 0, 0, "", 0
    for words in lines[1:]:
        if words[:1] == ["format"]:
            binary = words[1:2] != ["ascii"]
        elif words[:1] == ["element"] and len(words) == 3 and words[2].isdigit():
            element, count = words[1], int(words[2])
            faces += count if element == "face" else 0
            _few(count if element == "face" else count // 6, f"{path.name}, element {element}")
        elif words[:2] == ["property", "list"] and len(words) == 5:
            needs += count * (PLY_BYTES.get(words[2], 1) + 3 * PLY_BYTES.get(words[3], 1) if element == "face" else 1)
        elif words[:1] == ["property"] and len(words) == 3:
            needs += count * PLY_BYTES.get(words[1], 1)
    if not faces:
        raise IntakeError("no_mesh", "it has points and no faces", path.name, "make a surface of the points first")
    needs = needs if binary else 2 * 3 * faces  # of a text, the least that can name three corners a face
    if body < needs:
        raise _cut(path, f"its header speaks of {faces:,} faces", size - body + needs, size)
    return faces


def _off(path: Path, size: int) -> int:
    with path.open("rb") as file:
        head = file.read(HEADER_BYTES).decode("ascii", errors="replace")
    words = " ".join(line.partition("#")[0] for line in head.splitlines()[:200]).split()
    if (
        not words
        or not words[0].upper().endswith("OFF")
        or not all(word.isdigit() for word in words[1:3])
        or len(words) < 4
    ):
        raise IntakeError("no_mesh", "it does not begin as an OFF file does", path.name, "export it as OFF")
    points, faces = int(words[1]), int(words[2])
    _few(max(faces, points // 6), path.name)
    if size < 6 * points + 8 * faces:
        raise _cut(path, f"its header speaks of {faces:,} faces", 6 * points + 8 * faces, size)
    return faces


# -- COLLADA and USD -------------------------------------------------------------------------------------------------------


def _usd(path: Path, size: int) -> int:
    """Refuse what does not begin as USD does; how many faces there are is told once it is open."""
    with path.open("rb") as file:
        head = file.read(8)
    if not head.startswith((b"PXR-USDC", b"#usda ")):
        raise IntakeError("no_mesh", "it does not begin as a USD file does", path.name, "export it as USD")
    if head == b"PXR-USDC" and size < 88:
        raise IntakeError("truncated", "it ends within its header", path.name, AGAIN)
    return 0


def _dae(path: Path, _size: int) -> int:
    claims = collada_claims.scan(path)
    for name in claims.pictures[:256]:
        if (found := collada_claims.below(path.parent, name)) is not None:
            with found.open("rb") as file:
                picture(file.read(HEADER_BYTES), found.name)
    if not claims.faces:
        raise IntakeError("no_mesh", "there is no face in it", path.name, "export the object itself")
    return _few(claims.faces, path.name)


# -- OBJ -----------------------------------------------------------------------------------------------------------------


def _obj(path: Path, _size: int) -> int:
    points = faces = highest = where = 0
    libraries: list[str] = []
    with path.open("rb") as file:
        for number, line in _lines(file):
            if line[:2] in (b"v ", b"v\t"):
                points += 1
            elif line[:2] in (b"f ", b"f\t"):
                corners = line.split()[1:]
                faces += max(len(corners) - 2, 0)
                try:
                    top = max((int(corner.partition(b"/")[0]) for corner in corners), default=0)
                except ValueError:
                    raise IntakeError(
                        "truncated", "a corner of a face is no number", f"{path.name}:{number}", AGAIN
                    ) from None
                if top > highest:
                    highest, where = top, number
                if faces > MOST_FACES:
                    _few(faces, f"{path.name}:{number}")
            elif line[:6] == b"mtllib":
                libraries.append(line[6:].strip().decode(errors="replace"))
            if points > 3 * MOST_FACES:
                _few(points // 3, f"{path.name}:{number}")
    if highest > points:
        raise IntakeError("truncated", f"a face names corner {highest:,} of {points:,}", f"{path.name}:{where}", AGAIN)
    if not faces:
        raise IntakeError("no_mesh", "there is no face in it", path.name, "export the object itself")
    for name in libraries[:8]:
        _library(path.parent / name)
    return faces


def _lines(file: Iterable[bytes]) -> Iterator[tuple[int, bytes]]:
    """Lines with their number from 1; one that ends in a backslash goes on in the next."""
    held: list[bytes] = []
    number = 0
    for number, line in enumerate(file, 1):
        text = line.rstrip(b"\r\n")
        if text.endswith(b"\\"):
            held.append(text[:-1])
        elif held:
            yield number - len(held), b" ".join([*held, text])
            held.clear()
        else:
            yield number, line
    if held:
        yield number - len(held) + 1, b" ".join(held)


def _library(path: Path) -> None:
    """The pictures that a material library beside the mesh names, as far as they lie below its folder."""
    if not path.is_file() or path.stat().st_size > 1 << 20:
        return
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        words = line.split()
        if words and words[0].lower().startswith("map_"):
            found = (path.parent / words[-1].replace("\\", "/")).resolve()
            if found.is_file() and found.is_relative_to(path.parent.resolve()):
                with found.open("rb") as file:
                    picture(file.read(HEADER_BYTES), found.name)
