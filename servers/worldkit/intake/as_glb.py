"""A `.gltf` with the files that it names, or a `.3mf`, becomes one GLB file: what is said of GLB then holds for them."""

import base64
import binascii
import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote_to_bytes

from ..errors import IntakeError
from . import collada_claims, printed_objects
from .declared_sizes import AGAIN, FEWER, MOST_BYTES, picture

MOST_TEXT, MOST_FILES = 64 << 20, 512
WHITE = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4////fwAJ+wP9KobjigAAAABJRU5ErkJggg=="
)
"""A picture of one white pixel, in place of one that is not there."""


def axes(path: Path, asked: dict[str, Any]) -> dict[str, Any]:
    """What is asked of a file, with the axes that its format prescribes where they are not asked for: 3MF's, which its GLB keeps."""
    if path.suffix.lower() != ".3mf" or asked.get("up"):
        return asked
    return {**asked, "up": "+z", "front": asked.get("front") or "-y"}


def written(path: Path, folder: Path) -> tuple[Path, list[str]]:
    """The same things as a GLB file in a folder, and what is worth saying of it; any other file as it is.

    Raises:
        IntakeError: it is none, is not whole, or holds too much.
    """
    maker = {".gltf": of_gltf, ".3mf": printed_objects.as_glb}.get(path.suffix.lower())
    if maker is None:
        return path, []
    data, said = maker(path)
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / f"{path.stem}.glb"
    made.write_bytes(data)
    return made, said


def of_gltf(path: Path) -> tuple[bytes, list[str]]:
    """The GLB of a `.gltf`, its buffers and pictures within it; those are read from the file itself or from beside it.

    Raises:
        IntakeError: it is no glTF 2.0, or a buffer that it names is not there.
    """
    if path.stat().st_size > MOST_BYTES:
        raise IntakeError("too_large", f"it is larger than {MOST_BYTES >> 20} MB", path.name, FEWER)
    try:
        scene = json.loads(path.read_bytes())
        version = str(scene["asset"]["version"])
    except (ValueError, RecursionError, KeyError, TypeError) as error:
        raise IntakeError("no_mesh", f"it is no glTF: {error}", path.name, AGAIN) from error
    if not version.startswith("2"):
        raise IntakeError("unknown_format", f"it is of glTF version {version[:20]}", path.name, "export it as glTF 2.0")
    try:
        data, said = _joined(scene, path)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        cause = f"its buffers and pictures are not as glTF has them: {type(error).__name__}: {error}"
        raise IntakeError("unreadable", cause[:300], path.name, "export it anew, as GLB") from error
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    if len(text) > MOST_TEXT:
        raise IntakeError("too_large", f"its description is larger than {MOST_TEXT >> 20} MB", path.name, FEWER)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks, said


def _joined(scene: dict[str, Any], path: Path) -> tuple[bytes, list[str]]:
    """All buffers and pictures of a scene as one, to which its rows now point."""
    data, starts, said = bytearray(), [], []
    for number, row in enumerate(scene.get("buffers") or []):
        starts.append(_appended(data, _content(row["uri"], path, MOST_BYTES - len(data), f"buffer {number}")))
    views = scene.setdefault("bufferViews", [])
    for view in views:
        view["byteOffset"] = int(view.get("byteOffset") or 0) + starts[view["buffer"]]
        view["buffer"] = 0
    for number, row in enumerate(scene.get("images") or []):
        if number >= MOST_FILES:
            raise IntakeError("too_large", f"it names more than {MOST_FILES} pictures", path.name, FEWER)
        if "uri" not in row:
            continue
        try:
            content = _content(row.pop("uri"), path, MOST_BYTES - len(data), f"image {number}")
            picture(content, f"{path.name}, image {number}")
        except FileNotFoundError as error:
            content = WHITE
            said.append(f"a picture that it names is not beside it, and is left out: {str(error)[:80]}")
        row["mimeType"] = "image/jpeg" if content[:2] == b"\xff\xd8" else "image/png"
        row["bufferView"] = len(views)
        views.append({"buffer": 0, "byteOffset": _appended(data, content), "byteLength": len(content)})
    data += bytes(-len(data) % 4)
    scene["buffers"] = [{"byteLength": len(data)}]
    return bytes(data), said


def _appended(data: bytearray, content: bytes) -> int:
    """Where content begins, once it is put behind the data."""
    data += bytes(-len(data) % 4)
    start = len(data)
    data += content
    return start


def _content(uri: str, path: Path, most: int, what: str) -> bytes:
    """What an address names: bytes written into it, or a file below the folder.

    Raises:
        FileNotFoundError: there is no such picture.
        IntakeError: there is no such buffer, or it is too large.
    """
    if uri.startswith("data:"):
        head, _, said = uri.partition(",")
        try:
            content = base64.b64decode(said, validate=True) if head.endswith(";base64") else unquote_to_bytes(said)
        except binascii.Error as error:
            raise IntakeError("truncated", f"{what} is no base64: {error}", path.name, AGAIN) from error
    else:
        found = collada_claims.below(path.parent, uri)
        if found is None and what.startswith("image"):
            raise FileNotFoundError(uri)
        if found is None:
            raise IntakeError(
                "truncated", f"it names {uri[:80]!r}, which is not beside it", path.name,
                "lay that file where it was beside it, or add the folder or archive that both lie in",
            )  # fmt: skip
        if found.stat().st_size > most:
            raise _too_large(what, path)
        content = found.read_bytes()
    if len(content) > most:
        raise _too_large(what, path)
    return content


def _too_large(what: str, path: Path) -> IntakeError:
    return IntakeError("too_large", f"{what} makes it larger than {MOST_BYTES >> 20} MB", path.name, FEWER)
