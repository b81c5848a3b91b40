"""An archive or a folder with a mesh in it: unpacked bounded and in its place, and the one mesh found."""

import lzma
import stat
import tarfile
import zipfile
import zlib
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePath, PurePosixPath
from typing import Any

from ..errors import IntakeError
from .declared_sizes import FIRST_AS_GLB, MOST_BYTES, PICTURES, SUFFIXES, USD

TARS = (".tar", ".tgz", ".gz", ".xz", ".bz2")
ARCHIVES = (".zip", ".usdz", *TARS)
MESHES = (*SUFFIXES, *FIRST_AS_GLB)
WANTED = (*MESHES, ".mtl", ".bin", *PICTURES)
MOST_FILES, MOST_MEMBERS = 2_000, 50_000
BROKEN = (
    zipfile.BadZipFile, tarfile.TarError, zlib.error, lzma.LZMAError, OSError, RuntimeError, NotImplementedError, EOFError,
    ValueError,
)  # fmt: skip
"""What reading a broken archive raises."""
CHUNK = 1 << 20
FIRST = (".glb", ".gltf", ".usdc", ".usd", ".usda", ".dae", ".3mf", ".obj", ".ply", ".off", ".stl")
"""Of one mesh in several formats, the one that says most."""


def unpack(archive: Path, folder: Path) -> Path:
    """Unpack meshes, materials and pictures of an archive into a folder; returns the mesh.

    Raises:
        IntakeError: it is not whole, holds more than may be unpacked, names a place outside of itself, or has no one mesh.
    """
    names = extract(archive, folder, WANTED)
    if archive.suffix.lower() == ".usdz":  # whose first layer is the scene, by its specification
        scene = [name for name in names if PurePosixPath(name).suffix.lower() in USD]
        if scene:
            return folder / scene[0]
    return the_mesh(folder, archive.name)


def extract(archive: Path, folder: Path, wanted: Collection[str]) -> list[str]:
    """Unpack the files with some endings; returns their names, in the order of the archive.

    Raises:
        IntakeError: it is not whole, holds more than may be unpacked, or names a place outside of itself.
    """
    left = MOST_BYTES
    try:
        with _opened(archive) as (rows, content_of):
            for row in rows:
                _stays_inside(row, archive.name)
            own = [row for row in rows if row.plain and not _shadow(PurePosixPath(row.name))]
            chosen = [row for row in own if PurePosixPath(row.name).suffix.lower() in wanted]
            total = sum(row.size for row in chosen)
            if len(chosen) > MOST_FILES or total > MOST_BYTES:
                raise _too_large(
                    archive.name, f"it says that it unpacks to {len(chosen):,} files of {total >> 20:,} MB"
                )
            for row in chosen:
                target = folder / PurePosixPath(row.name)
                target.parent.mkdir(parents=True, exist_ok=True)
                with content_of(row) as member, target.open("wb") as file:
                    while block := member.read(min(CHUNK, left + 1)):  # whatever its entry claims
                        left -= len(block)
                        if left < 0:
                            raise _too_large(archive.name, f"it unpacks to more than {MOST_BYTES >> 20} MB")
                        file.write(block)
    except BROKEN as error:
        raise IntakeError(
            "truncated",
            f"the archive cannot be unpacked: {error}",
            archive.name,
            "get it once more, or unpack it yourself",
        ) from error
    return [row.name for row in chosen]


@dataclass(frozen=True)
class _Row:
    """A member of an archive. plain: it is a file. linked: it is a link, or a device."""

    name: str
    size: int
    plain: bool
    linked: bool
    own: Any


@contextmanager
def _opened(archive: Path) -> Iterator[tuple[list[_Row], Callable[[_Row], Any]]]:
    """The members of a .zip or .tar, and what opens one."""
    if archive.suffix.lower() in (".zip", ".usdz"):
        with zipfile.ZipFile(archive) as held:
            rows = [
                _Row(one.filename, one.file_size, not one.is_dir(), stat.S_ISLNK(one.external_attr >> 16), one)
                for one in held.infolist()
            ]
            yield rows, lambda row: held.open(row.own)
        return
    with tarfile.open(archive) as tape:
        found = []
        for member in tape:
            found.append(_Row(member.name, member.size, member.isreg(), not (member.isreg() or member.isdir()), member))
            # The next header lies behind this one's content, through which a compressed tape is read.
            if len(found) > MOST_MEMBERS or member.offset_data + member.size > 2 * MOST_BYTES:
                raise _too_large(
                    archive.name, f"it holds more than {MOST_MEMBERS:,} files, or {2 * MOST_BYTES >> 20} MB"
                )
        yield found, lambda row: tape.extractfile(row.own)


def the_mesh(folder: Path, name: str) -> Path:
    """The one mesh below a folder; of one in several formats, that which says most.

    Raises:
        IntakeError: there is none, or there are several.
    """
    below = (path for path in folder.rglob("*") if not _shadow(path.relative_to(folder)))
    found = sorted(path for path in below if path.suffix.lower() in MESHES and path.is_file())
    if not found:
        raise IntakeError("no_mesh", f"there is no mesh in it ({', '.join(MESHES)})", name, "name the file itself")
    if len({path.stem.lower() for path in found}) > 1:
        told = ", ".join(path.relative_to(folder).as_posix() for path in found[:8])
        raise IntakeError(
            "several_meshes", f"there are {len(found)} meshes in it: {told}", name, "name one of these files itself"
        )
    return min(found, key=lambda path: FIRST.index(path.suffix.lower()))


def _shadow(path: PurePath) -> bool:
    """Whether a file is one that macOS lays beside each of its own in an archive, of the same name, for what it notes of it."""
    return "__MACOSX" in path.parts or path.name.startswith("._")


def _stays_inside(row: _Row, name: str) -> None:
    path = PurePosixPath(row.name.replace("\\", "/"))
    if path.is_absolute() or ".." in path.parts or ":" in row.name.split("/")[0] or row.linked:
        what = "is a link" if row.linked else "lies outside of it"
        raise IntakeError(
            "climbs_out",
            f"{row.name[:80]!r} {what}",
            name,
            "get the archive from somewhere else, or unpack it yourself",
        )


def _too_large(name: str, cause: str) -> IntakeError:
    return IntakeError("too_large", cause, name, "unpack it yourself, and name the mesh")
