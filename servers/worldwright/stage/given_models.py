"""What a user gives as a model: a file, a folder with one, or an archive of such a folder; and what a URDF is made of.

An archive is unpacked, bounded and in its place, below the folder that its recording goes to.
"""

import hashlib
import re
import shutil
from pathlib import Path

from worldkit import model_files
from worldkit.errors import IntakeError
from worldkit.files import write_atomic
from worldkit.intake import unpacked

from ..model.errors import JobError, NotFoundError
from ..model.evidence.run import sha256_file

UNPACKED = "model"
WANTED = (
    ".urdf",
    ".xml",
    ".mjcf",
    ".mtl",
    ".jpg",
    ".jpeg",
    *(s for kinds in model_files.KINDS.values() for s in kinds),
)
UNPACKED_FROM = ".unpacked-from"
"""In the folder of what was unpacked: the hash of the archive and of all that came out of it. No member is called so."""


def name_of(given: Path) -> str:
    """What a model's run is called: the file's or folder's name without its endings, "model" where nothing is left."""
    name = given.resolve().name if given.name == ".." else given.name
    endings = "|".join(map(re.escape, (".urdf", ".xml", ".mjcf", *unpacked.ARCHIVES)))
    return re.sub(rf"({endings})+$", "", name, flags=re.IGNORECASE).strip(".") or "model"


def the_model(given: Path, folder: Path) -> Path:
    """The model file of what was given.

    Args:
        given: a file, a folder, or an archive.
        folder: where an archive is unpacked, in a folder of its own.

    Raises:
        NotFoundError: there is none in it, or there are several.
        JobError: the archive cannot be unpacked.
    """
    if given.is_file() and given.suffix.lower() not in unpacked.ARCHIVES:
        return given
    place = given
    if given.is_file():
        place = folder / UNPACKED
        kept = place / UNPACKED_FROM
        # A job under way may be reading what the same archive gave before.
        if not kept.is_file() or kept.read_text(encoding="utf-8") != _state(given, place):
            shutil.rmtree(place, ignore_errors=True)
            unpack(given, place)
            write_atomic(kept, _state(given, place))
    found = model_files.models_in(place)
    if len(found) != 1:
        told = ", ".join(path.relative_to(place).as_posix() for path in found[:8])
        raise NotFoundError(
            f"there are {len(found)} models in it: {told}" if found else "there is no model in it", place=str(given),
            next_move=f"name one of them, below {place}" if found else "give a folder with a URDF or MJCF file",
        )  # fmt: skip
    return found[0].absolute()


def _state(archive: Path, place: Path) -> str:
    """A hash of the archive and of all files in the folder, whoever wrote them last."""
    files = sorted(path for path in place.rglob("*") if path.is_file() and path.name != UNPACKED_FROM)
    rows = [(path.relative_to(place).as_posix(), sha256_file(path)) for path in files]
    return hashlib.sha256(repr([sha256_file(archive), *rows]).encode()).hexdigest()


def unpack(archive: Path, into: Path) -> None:
    """Unpack what models are made of into a new folder, whole or not at all.

    Raises:
        JobError: it is not whole, holds more than may be unpacked, or names a place outside of itself.
    """
    try:
        unpacked.extract(archive, into, WANTED)
    except IntakeError as error:
        shutil.rmtree(into, ignore_errors=True)
        raise JobError(error.cause, code=error.code, place=str(archive), next_move=error.next_move) from error


def files_of_urdf(model: Path) -> list[Path]:
    """A URDF and the files that it names, looked for up to the folder above it, as packages have them.

    Raises:
        JobError: it cannot be read, or names files that are not there.
    """
    try:
        made = model_files.whole(model, model.parent.parent)
    except model_files.ModelFileError as error:
        raise JobError(error.cause, code="refused", place=str(model), next_move=error.next_move) from error
    return [*made.sources, *(model.parent.parent.resolve() / name for name in made.files)]
