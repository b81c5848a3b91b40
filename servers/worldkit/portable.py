"""The world as one file: an MJZ archive of the model's XML and everything it is made of. It *is* the world.

    import mujoco
    model = mujoco.MjSpec.from_file("world.mjz").compile()

What is simulated, filmed and certified is the model that is compiled from this file, by a process that never sees the
program. Plain MuJoCo opens it anywhere. Two builds of one world give the same content; on one machine they give the same
bytes, too: entries are packed in the order of their names and without dates.

Source: MuJoCo manual, "MJZ Archives" (the XML is `model.xml` in the archive's root). Painted textures, which live in memory,
become PNG files; files with absolute paths on this machine are stored under short names, one per content. The
archive is opened again here and compared with the world it was made of, array by array.
"""

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import finite
from .alike import differences
from .closed_archive import XML, entries
from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

NAME = "world.mjz"
TOLERANCE = 1e-6
"""Relative difference that writing numbers as text may leave."""
SMALL = 2 << 20
"""Unpacked bytes up to which an archive, or a picture in it, is packed well: small worlds are kept in version control. Beyond it
time counts: of a picture of 2 MB with four values at random, level 9 took 0.9 s and level 1 0.07 s, for 13 % less room."""
PICTURE = 6
"""Level of a small picture: the ground that nearly every world paints took 21 ms and 65.7 kB, at level 9 72 ms and 63.3 kB."""


def write(spec: "mujoco.MjSpec", path: Path) -> dict[str, Any]:
    """Write the world's archive; returns its facts.

    Args:
        spec: the world; its files and textures are rewritten in place.
        path: of the archive, ending in `.mjz`.

    Returns:
        `files` in the archive, `bytes` and `sha256` of it, and `rounded`: the relative difference, at most `TOLERANCE`, of
        each array that decides the motion and is not the same bit for bit in the archive's world.

    Raises:
        ProgramError: the archive cannot be written, or does not open as the same world.
    """
    import mujoco

    from .whole_digits import whole_digits

    before = spec.compile()
    if where := finite.nowhere(before):
        cause = f"the world has numbers that are none (nan, inf): {where}"
        move = "look for a division by zero, or a root or logarithm of what has none"
        if "range" in where.partition(" ")[0]:
            move = "give a finite limit; what has none is not limited"
        raise ProgramError(cause, "build()", move)
    take_in(spec)
    try:
        model = spec.compile()
        with _all_digits():
            text = spec.to_xml()
        used = {name: bytes(content) for name, content in spec.assets.items() if name in text}
        _store({XML: whole_digits(text, spec, model).encode(), **used}, path)
        after = read(path)
    except (ValueError, RuntimeError, mujoco.FatalError) as failure:
        raise ProgramError(
            f"the world cannot be written as one file: {failure}", str(path), "build it from what MJCF can say"
        ) from failure
    rounded = differences(before, after)
    lost = {where: apart for where, apart in rounded.items() if not apart <= TOLERANCE}
    if lost:
        ordered = sorted(lost.items(), key=lambda row: (not row[0].startswith("n"), -row[1]))  # how many, then how far
        told = [f"{where} differs" + f" by {apart:.2g} of its size" * isfinite(apart) for where, apart in ordered]
        more = f" (and {len(told) - 1} more)" if len(told) > 1 else ""
        raise ProgramError(
            f"the world does not survive being written as one file: {told[0]}{more}",
            str(path),
            "build it from what MJCF can say; what is set in a compiled model is lost",
        )
    content = path.read_bytes()
    sha256 = hashlib.sha256(content).hexdigest()
    return {"files": 1 + len(used), "bytes": len(content), "sha256": sha256, "rounded": rounded}


def read(path: Path) -> "mujoco.MjModel":
    """The model compiled from an archive; where the archive lies leaves no trace in it.

    Raises:
        ValueError: it is no archive, names what is not in it, does not compile, or has a number that is none.
    """
    return compiled(spec(path))


def compiled(spec: "mujoco.MjSpec") -> "mujoco.MjModel":
    """The model of an archive's world; raises ValueError where it does not compile, or has a number that is none."""
    model = spec.compile()
    if where := finite.nowhere(model):
        raise ValueError(f"it has numbers that are none (nan, inf): {where}")
    return model


def spec(path: Path) -> "mujoco.MjSpec":
    """The world of an archive as it was built, not compiled yet; raises ValueError as `read` does."""
    import mujoco

    text, files = entries(path)
    return mujoco.MjSpec.from_string(text, assets=files)


def _level(size: int) -> int:
    """How hard to pack so many bytes, of 9."""
    return 9 if size <= SMALL else 1


def _store(files: dict[str, bytes], path: Path) -> None:
    """Write an archive whose bytes depend on the content, and on how this machine's zlib packs it."""
    import zipfile

    level = _level(sum(map(len, files.values())))
    with zipfile.ZipFile(path, "w") as archive:
        for name in sorted(files, key=lambda name: (name != XML, name)):
            archive.writestr(zipfile.ZipInfo(name), files[name], zipfile.ZIP_DEFLATED, level)


@contextmanager
def _all_digits() -> Iterator[None]:
    """Within the block, let the engine write numbers as exactly as a double holds them; otherwise it writes six digits.

    The engine offers this to its own tests only (a symbol marked private), so where it is gone the archive is written
    with six digits, and `differs` says what that does.
    """
    import ctypes

    import mujoco

    libraries = sorted(Path(mujoco.__file__).parent.glob("libmujoco*")) + sorted(
        Path(mujoco.__file__).parent.glob("mujoco.dll")
    )
    try:
        library = ctypes.CDLL(str(libraries[0]))
        read, write = library._mjPRIVATE__get_xml_precision, library._mjPRIVATE__set_xml_precision
    except (IndexError, OSError, AttributeError):
        yield
        return
    usual = read()
    write(17)
    try:
        yield
    finally:
        write(usual)


def take_in(spec: "mujoco.MjSpec") -> None:
    """Give the spec every file it names, and every texture it holds in memory, as an asset with a short name."""
    folder = Path(spec.modelfiledir or ".")
    for elements, fallback in (
        (spec.meshes, spec.meshdir),
        (spec.hfields, spec.meshdir),
        (spec.skins, spec.meshdir),
        (spec.textures, spec.texturedir),
    ):
        for element in elements:
            if element.file:
                element.file = _asset(spec, element.file, folder / (fallback or ""))
    for texture in spec.textures:
        if any(texture.cubefiles):
            texture.cubefiles = [
                _asset(spec, n, folder / (spec.texturedir or "")) if n else "" for n in texture.cubefiles
            ]
        elif not texture.file and (pixels := bytes(texture.data)):
            _painted(spec, texture, pixels)
    spec.meshdir = spec.texturedir = ""
    spec.strippath = False


def _asset(spec: "mujoco.MjSpec", name: str, folder: Path) -> str:
    """The asset's short name; its bytes are in the spec afterwards."""
    held = spec.assets.get(name)
    try:
        content = bytes(held) if held is not None else (folder / name).read_bytes()  # an absolute name stays itself
    except OSError as failure:
        raise ProgramError(
            f"a file of the world cannot be read: {failure.strerror or failure}", str(folder / name), "put it there"
        ) from failure
    short = f"assets/{hashlib.sha256(content).hexdigest()[:12]}{Path(name).suffix.lower()}"
    spec.assets[short] = content
    if name != short and held is not None:
        del spec.assets[name]
    return short


def _painted(spec: "mujoco.MjSpec", texture: Any, pixels: bytes) -> None:
    """Turn a texture's pixels in memory into a PNG among the assets; a cube's faces lie below each other."""
    import cv2
    import mujoco
    import numpy as np

    image = np.frombuffer(pixels, np.uint8).reshape(texture.height, texture.width, texture.nchannel)
    order = {3: [2, 1, 0], 4: [2, 1, 0, 3]}.get(texture.nchannel)
    flat = image if order is None else image[..., order]
    good, coded = cv2.imencode(".png", flat, (cv2.IMWRITE_PNG_COMPRESSION, min(PICTURE, _level(len(pixels)))))
    if not good:
        raise ProgramError(
            f"texture {texture.name} cannot be written as PNG", texture.name, "give it 1, 3 or 4 channels"
        )
    short = f"assets/{hashlib.sha256(coded.tobytes()).hexdigest()[:12]}.png"
    spec.assets[short] = coded.tobytes()
    texture.data = b""
    texture.file = short
    if texture.type != mujoco.mjtTexture.mjTEXTURE_2D:
        texture.gridsize = (6, 1)
        texture.gridlayout = "RLUDFB"
