"""An archive or a folder with a mesh in it: unpacked bounded and in its place, and the one mesh found."""

import lzma
import stat
import zipfile
import zlib
from pathlib import Path, PurePosixPath

from ..errors import IntakeError
from .declared_sizes import MOST_BYTES, PICTURES, SUFFIXES, USD

ARCHIVES = (".zip", ".usdz")
WANTED = (*SUFFIXES, ".mtl", *PICTURES)
MOST_FILES = 2_000
CHUNK = 1 << 20
FIRST = (".glb", ".usdc", ".usd", ".usda", ".dae", ".obj", ".ply", ".off", ".stl")
"""Of one mesh in several formats, the one that says most."""


def unpack(archive: Path, folder: Path) -> Path:
    """Unpack meshes, materials and pictures of an archive into a folder; returns the mesh.

    Raises:
        IntakeError: it is not whole, holds more than may be unpacked, names a place outside of itself, or has no one mesh.
    """
    left = MOST_BYTES
    try:
        with zipfile.ZipFile(archive) as held:
            rows = held.infolist()
            for row in rows:
                _stays_inside(row, archive.name)
            wanted = [row for row in rows if PurePosixPath(row.filename).suffix.lower() in WANTED and not row.is_dir()]
            total = sum(row.file_size for row in wanted)
            if len(wanted) > MOST_FILES or total > MOST_BYTES:
                raise _too_large(
                    archive.name, f"it says that it unpacks to {len(wanted):,} files of {total >> 20:,} MB"
                )
            for row in wanted:
                target = folder / PurePosixPath(row.filename)
                target.parent.mkdir(parents=True, exist_ok=True)
                with held.open(row) as member, target.open("wb") as file:
                    while block := member.read(min(CHUNK, left + 1)):  # whatever its entry claims
                        left -= len(block)
                        if left < 0:
                            raise _too_large(archive.name, f"it unpacks to more than {MOST_BYTES >> 20} MB")
                        file.write(block)
    except (
        zipfile.BadZipFile,
        zlib.error,
        lzma.LZMAError,
        OSError,
        RuntimeError,
        NotImplementedError,
        EOFError,
        ValueError,
    ) as error:
        raise IntakeError(
            "truncated",
            f"the archive cannot be unpacked: {error}",
            archive.name,
            "get it once more, or unpack it yourself",
        ) from error
    if archive.suffix.lower() == ".usdz":  # whose first layer is the scene, by its specification
        scene = [row.filename for row in wanted if PurePosixPath(row.filename).suffix.lower() in USD]
        if scene:
            return folder / scene[0]
    return the_mesh(folder, archive.name)


def the_mesh(folder: Path, name: str) -> Path:
    """The one mesh below a folder; of one in several formats, that which says most.

    Raises:
        IntakeError: there is none, or there are several.
    """
    found = sorted(path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file())
    if not found:
        raise IntakeError("no_mesh", f"there is no mesh in it ({', '.join(SUFFIXES)})", name, "name the file itself")
    if len({path.stem.lower() for path in found}) > 1:
        told = ", ".join(path.relative_to(folder).as_posix() for path in found[:8])
        raise IntakeError(
            "several_meshes", f"there are {len(found)} meshes in it: {told}", name, "name one of these files itself"
        )
    return min(found, key=lambda path: FIRST.index(path.suffix.lower()))


def _stays_inside(row: zipfile.ZipInfo, name: str) -> None:
    path = PurePosixPath(row.filename.replace("\\", "/"))
    linked = stat.S_ISLNK(row.external_attr >> 16)
    if path.is_absolute() or ".." in path.parts or ":" in row.filename.split("/")[0] or linked:
        what = "is a link" if linked else "lies outside of it"
        raise IntakeError(
            "climbs_out",
            f"{row.filename[:80]!r} {what}",
            name,
            "get the archive from somewhere else, or unpack it yourself",
        )


def _too_large(name: str, cause: str) -> IntakeError:
    return IntakeError("too_large", cause, name, "unpack it yourself, and name the mesh")
