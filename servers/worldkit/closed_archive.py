"""Opening a world's archive so that nothing outside it can become part of the world.

Asked for a file that is not among the assets it was given, the engine looks on the disk: an `include`, a mesh or a whole model
by an absolute path, or by one that climbs, would enter the world and leave no trace in the archive's hash. So the text is read
here before the engine sees it, and whatever it names must lie in the archive under exactly that name.

Entries are read once. An archive that unpacks beyond `MOST_BYTES` is refused before anything is unpacked.
"""

import hashlib
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from xml.parsers import expat

XML = "model.xml"
MOST_BYTES = 1 << 30
MOST_ENTRIES = 10_000
FOLDERS = ("assetdir", "meshdir", "texturedir")


def entries(path: Path) -> tuple[str, dict[str, bytes]]:
    """The text of an archive's world, and the other files in it by name.

    Raises:
        ValueError: it is no archive, is too large, has names that two readers could take differently, or names a file
            that is not in it.
    """
    files = packed(path)
    try:
        text = files.pop(XML).decode()
    except (KeyError, UnicodeDecodeError) as cause:
        raise ValueError(f"it is no archive of a world: {cause}") from cause
    closed(text, set(files))
    return text, files


def packed(path: Path) -> dict[str, bytes]:
    """Every file in an archive by name, whatever its world's text says; raises ValueError as `entries` does."""
    try:
        with zipfile.ZipFile(path) as archive:
            listed = archive.infolist()
            _plain([entry.filename for entry in listed])
            if sum(entry.file_size for entry in listed) > MOST_BYTES:
                raise ValueError(f"its files are larger than {MOST_BYTES >> 20} MB")
            return {entry.filename: archive.read(entry) for entry in listed}
    except (OSError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error) as cause:
        raise ValueError(f"it is no archive of a world: {cause}") from cause


def content_sha256(path: Path) -> str:
    """SHA-256 of what an archive holds: name and bytes of each file in it, in the order of the names.

    The bytes of the archive itself also depend on how it was packed. Raises ValueError as `entries` does.
    """
    total = hashlib.sha256()
    for name, content in sorted(packed(path).items()):
        total.update(f"{len(name.encode())} {name} {len(content)} ".encode())
        total.update(content)
    return total.hexdigest()


def closed(text: str, names: set[str]) -> None:
    """Refuse a world that is not made of its text and these files alone.

    Raises:
        ValueError: its text is not well-formed, or names a file that is not among them.
    """

    def opening(element: str, attributes: dict[str, str]) -> None:
        where = f"line {parser.CurrentLineNumber} of {XML}"
        if element in ("include", "model"):
            raise ValueError(f"`{element}` in {where} brings in another model: write the world as one")
        for name, value in attributes.items():
            if name in FOLDERS and value.strip("./"):
                raise ValueError(f"`{name}` in {where} names a folder: an archive has none")
            if name == "strippath" and value != "false":
                raise ValueError(f"`{name}` in {where} looks for files under other names than those of the archive")
            if name.startswith("file") and value and value not in names:
                raise ValueError(f"`{name}={value[:100]}` in {where} is not in the archive")

    def declared(*_: object) -> None:
        raise ValueError(f"{XML} declares a document type")

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.StartDoctypeDeclHandler = opening, declared
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as cause:
        raise ValueError(f"{XML} is not well-formed: {cause}") from cause


def _plain(names: list[str]) -> None:
    """Refuse names that another reader could take for another file, and crowds of them."""
    if len(names) > MOST_ENTRIES:
        raise ValueError(f"it has more than {MOST_ENTRIES} entries")
    for name in names:
        if name != PurePosixPath(name).as_posix() or not {"..", "/"}.isdisjoint(PurePosixPath(name).parts):
            raise ValueError(f"its entry {name!r} is no plain name: other readers could open another world")
    if len(set(names)) < len(names):
        raise ValueError("an entry is in it twice: other readers could open another world")
