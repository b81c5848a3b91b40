"""Sweet Home 3D's furniture as Debian packages it (`sweethome3d-furniture`): 820 textured, metric models, CC0 and CC-BY.

Five archives, each with a text of properties: name, category, size in cm, creator, and where the model lies within. The licence
is the archive's own, the creator the model's.
"""

import lzma
import os
import re
import zipfile
import zlib
from collections import defaultdict
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any

from ..refusing import IntakeFailedError
from . import Offer

PLACES = ("/usr/share/sweethome3d/furniture", "/usr/local/share/sweethome3d/furniture")
LICENCES = {
    "BlendSwap-CC-0": "CC0-1.0",
    "BlendSwap-CC-BY": "CC-BY-3.0",
    "Scopia": "CC-BY-3.0",
    "KatorLegaz": "CC-BY-3.0-US",
    "Reallusion": "CC-BY-3.0-US",
}
"""Of each archive, as its own LICENSE.TXT has it; others are not offered."""
TEXT = "PluginFurnitureCatalog.properties"
ROW = re.compile(r"(\w+)#(\d+)\s*=\s*(.*)")
MOST_TEXT, MOST_MEMBER, MOST_LAID, MOST_FILES, MOST_ICON = 4 << 20, 64 << 20, 128 << 20, 64, 1 << 20
BROKEN = (OSError, zipfile.BadZipFile, zlib.error, lzma.LZMAError)
"""What reading a broken archive raises."""
WANTED = (".obj", ".mtl", ".png", ".jpg", ".jpeg")


def offers() -> tuple[Offer, ...]:
    """All models of the archives that are here."""
    return tuple(offer for archive in _archives() for offer, _ in _rows(archive, archive.stat().st_mtime_ns).values())


def lay(key: str, folder: Path) -> tuple[Path, dict[str, Any]]:
    """Lay out a model's OBJ, materials and pictures, all in one folder.

    Raises:
        IntakeFailedError: the archive does not hold it whole, names a place outside, or holds more than may be laid out.
    """
    for archive in _archives():
        found = _rows(archive, archive.stat().st_mtime_ns).get(key)
        if found is not None:
            return _extracted(archive, found[0], found[1], folder)
    raise IntakeFailedError(f"there is no model {key} here", code="not_found", place=key, next_move=installing())


def icon(key: str) -> bytes:
    """The picture that the catalogue shows of a model."""
    for archive in _archives():
        if found := _rows(archive, archive.stat().st_mtime_ns).get(key):
            try:
                with zipfile.ZipFile(archive) as held:
                    return _read(held, found[1].get("icon", "").lstrip("/"), MOST_ICON)
            except (*BROKEN, IntakeFailedError):
                return b""
    return b""


def installing() -> str:
    """The command that brings the package."""
    return "apt-get install sweethome3d-furniture"


def _archives() -> list[Path]:
    named = os.environ.get("WORLDWRIGHT_SWEETHOME")
    folder = next((Path(place) for place in ([named] if named else PLACES) if Path(place).is_dir()), None)
    return [path for path in sorted(folder.glob("*.sh3f")) if path.stem in LICENCES] if folder else []


@lru_cache(maxsize=16)
def _rows(archive: Path, _changed: int) -> dict[str, tuple[Offer, dict[str, str]]]:
    """The models of an archive by key, each with its properties; none of one that cannot be read."""
    try:
        with zipfile.ZipFile(archive) as held:
            text = _read(held, TEXT, MOST_TEXT).decode("latin-1")
    except (*BROKEN, IntakeFailedError):
        return {}
    said: dict[int, dict[str, str]] = defaultdict(dict)
    for line in text.splitlines():
        if match := ROW.match(line):
            said[int(match[2])][match[1]] = match[3].strip()
    found = {}
    for row in said.values():
        try:
            offer = _offer(archive.stem, row)
        except (KeyError, ValueError):
            continue
        found[offer.key] = (offer, row)
    return found


def _offer(library: str, row: dict[str, str]) -> Offer:
    depth, width, height = (float(row[name]) / 100 for name in ("depth", "width", "height"))
    if not all(0 < side < 200 for side in (depth, width, height)):
        raise ValueError(row["id"])
    own = PurePosixPath(row["model"]).stem
    tags = row.get("tags", "").replace("Blend Swap", "").strip(" ,")
    return Offer(
        key="_".join(re.findall(r"[a-z0-9]+", f"{library} {own}".lower()))[:60],
        name=row["name"],
        category=row.get("category", "").lower(),
        words=f"{tags} {own.replace('-', ' ')}".strip(),
        extents=(depth, width, height),
        licence=LICENCES[library],
        creator=row.get("creator", library),
        library="sweethome_furniture",
    )


def _extracted(archive: Path, offer: Offer, row: dict[str, str], folder: Path) -> tuple[Path, dict[str, Any]]:
    model = PurePosixPath(row["model"].lstrip("/"))
    left, file = MOST_LAID, folder / model.name
    try:
        with zipfile.ZipFile(archive) as held:
            beside = [name for name in held.namelist() if PurePosixPath(name).parent == model.parent]
            wanted = [name for name in beside if PurePosixPath(name).suffix.lower() in WANTED][:MOST_FILES]
            for name in wanted:
                content = _read(held, name, min(left, MOST_MEMBER))
                left -= len(content)
                (folder / PurePosixPath(name).name).write_bytes(content)  # a bare name climbs nowhere
    except BROKEN as error:
        raise IntakeFailedError(
            f"{archive.name} is not whole: {error}", code="truncated", place=str(archive), next_move=installing()
        ) from error
    if not file.is_file() or file.suffix.lower() != ".obj":
        raise IntakeFailedError(
            f"there is no {model} in it", code="truncated", place=str(archive), next_move=installing()
        )
    asked: dict[str, Any] = {
        "key": offer.key,
        "extents": list(offer.extents),
        "licence": offer.licence,
        "creator": offer.creator,
        "source": f"sweethome3d-furniture, {archive.stem}, {row['id']}",
        "built_up": True,
    }
    turned = [float(word) for word in row.get("modelRotation", "").split()]
    if len(turned) == 9:
        asked["rotation"] = [turned[0:3], turned[3:6], turned[6:9]]
    return file, asked


def _read(held: zipfile.ZipFile, name: str, most: int) -> bytes:
    """A member of an archive, at most so many bytes of it, whatever its entry claims."""
    try:
        with held.open(name) as member:
            content = member.read(most + 1)
    except (KeyError, RuntimeError, NotImplementedError, EOFError, *BROKEN) as error:
        raise IntakeFailedError(
            f"{name} cannot be read: {error}", code="truncated", place=str(held.filename), next_move=installing()
        ) from error
    if len(content) > most:
        raise IntakeFailedError(
            f"{name} unpacks to more than {most >> 20} MB",
            code="too_large",
            place=str(held.filename),
            next_move=installing(),
        )
    return content
