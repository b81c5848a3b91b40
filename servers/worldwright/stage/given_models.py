"""What a user gives as a model: a file, a folder with one, or an archive of such a folder; and what a URDF is made of.

An archive is unpacked, bounded and in its place, below the folder that its recording goes to: once, under a name of its content.
"""

import re
import tempfile
from pathlib import Path

from worldkit import model_files
from worldkit.errors import IntakeError
from worldkit.intake import unpacked

from ..model.errors import JobError, NotFoundError
from ..model.evidence.run import sha256_file

UNPACKED = ".model-"
PACKAGE = re.compile(rb"package://([^/\"'<>\s]+)/")
WANTED = (
    ".urdf",
    ".xml",
    ".mjcf",
    ".mtl",
    ".jpg",
    ".jpeg",
    *(s for kinds in model_files.KINDS.values() for s in kinds),
)


def name_of(given: Path) -> str:
    """What a model's run is called: the file's or folder's name without its endings, "model" where nothing is left."""
    name = given.resolve().name if given.name == ".." else given.name
    endings = "|".join(map(re.escape, (".urdf", ".xml", ".mjcf", *unpacked.ARCHIVES)))
    return re.sub(rf"({endings})+$", "", name, flags=re.IGNORECASE).strip(".") or "model"


def the_model(given: Path, folder: Path) -> tuple[Path, Path]:
    """The model file of what was given, and the folder below which its files lie.

    Args:
        given: a file, a folder, or an archive.
        folder: where an archive is unpacked, in a folder of its own; what lies there stays as it is.

    Raises:
        NotFoundError: there is none in it, or there are several.
        JobError: the archive cannot be unpacked.
    """
    if given.is_file() and given.suffix.lower() not in unpacked.ARCHIVES:
        return given, package_of(given) or given.parent.parent
    place = given if given.is_dir() else unpack(given, folder)
    found = model_files.models_in(place)
    if len(found) != 1:
        told = ", ".join(path.relative_to(place).as_posix() for path in found[:8])
        raise NotFoundError(
            f"there are {len(found)} models in it: {told}" if found else "there is no model in it", place=str(given),
            next_move=f"name one of them, below {place}" if found else "give a folder with a URDF or MJCF file",
        )  # fmt: skip
    model, root = found[0].absolute(), place.absolute()
    package = package_of(model) if given.is_dir() else None  # of an archive nothing lies above what it unpacks to
    return model, package if package is not None and root.is_relative_to(package) else root


def package_of(model: Path) -> Path | None:
    """The folder of the package that a model lies in, by a name that the model says or its `package.xml`; where it names
    packages that lie beside that one, the folder of them all."""
    try:
        named = {
            name.decode(errors="replace") for name in PACKAGE.findall(model.read_bytes()[: model_files.MOST_BYTES])
        }
    except OSError:
        return None
    for home in model.absolute().parents:
        if home.name in named or (home / "package.xml").is_file():
            beside = any((home.parent / name).is_dir() for name in named - {home.name, ".", ".."})
            return home.parent if beside else home
    return None


def unpack(archive: Path, folder: Path) -> Path:
    """The folder below another that holds what models of an archive are made of: unpacked whole, once, or not at all.

    Raises:
        JobError: it is not whole, holds more than may be unpacked, or names a place outside of itself.
    """
    place = folder / f"{UNPACKED}{sha256_file(archive)[:12]}"
    if place.is_dir():
        return place
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=UNPACKED, dir=folder) as made:
        whole = Path(made) / "whole"
        whole.mkdir()
        try:
            unpacked.extract(archive, whole, WANTED)
        except IntakeError as error:
            raise JobError(error.cause, code=error.code, place=str(archive), next_move=error.next_move) from error
        try:
            whole.rename(place)
        except OSError as error:
            if not place.is_dir():  # else another call was quicker
                raise JobError(
                    f"the archive cannot be unpacked: {error.strerror}", code="refused", place=str(place),
                    next_move=f"take away what lies at {place}",
                ) from error  # fmt: skip
    return place


def files_of_urdf(model: Path, root: Path) -> list[Path]:
    """A URDF and the files below a folder that it names.

    Raises:
        JobError: it cannot be read, or names files that are not there.
    """
    try:
        made = model_files.whole(model, root)
    except model_files.ModelFileError as error:
        raise JobError(error.cause, code="refused", place=str(model), next_move=error.next_move) from error
    return [*made.sources, *(root.resolve() / name for name in made.files)]
