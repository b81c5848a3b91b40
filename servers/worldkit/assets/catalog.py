"""Where the assets are, which there are, and one hash over everything that can change a world."""

import difflib
import hashlib
import os
from functools import lru_cache
from pathlib import Path

from .entry import Asset
from .reading import read_asset


class UnknownAssetError(KeyError):
    """No asset of that key; the message gives the nearest keys and all of them."""

    def __str__(self) -> str:
        return str(self.args[0])


def catalog_root() -> Path:
    """The catalog folder: `$WORLDWRIGHT_CATALOG`, else the repository's `catalog/`, else the one inside the wheel.

    Raises:
        FileNotFoundError: there is none; the message names the places looked at.
    """
    named = os.environ.get("WORLDWRIGHT_CATALOG")
    package = Path(__file__).resolve().parents[1]
    places = [Path(named)] if named else [package.parents[1] / "catalog", package / "_catalog"]
    for place in places:
        if place.is_dir():
            return place.resolve()
    raise FileNotFoundError(
        f"no asset catalog at {' or '.join(map(str, places))}; point WORLDWRIGHT_CATALOG at a folder of assets"
    )


def keys() -> tuple[str, ...]:
    """Every asset key, sorted: the folders of the catalog that hold an `asset.yaml`."""
    return tuple(sorted(path.parent.name for path in catalog_root().glob("*/asset.yaml")))


def find(key: str) -> Asset:
    """The catalog entry `key`.

    Raises:
        UnknownAssetError: no such key; names the nearest ones and all.
        AssetError: its `asset.yaml` is malformed.
    """
    path = catalog_root() / key / "asset.yaml"
    if key not in keys():
        near = difflib.get_close_matches(key, keys(), n=3, cutoff=0.5)
        hint = f"did you mean {' or '.join(near)}? " if near else ""
        raise UnknownAssetError(f"no asset {key!r} in {catalog_root()}; {hint}known: {', '.join(keys())}")
    stat = path.stat()
    return _read(path.parent, stat.st_mtime_ns, stat.st_size)


@lru_cache(maxsize=512)
def _read(folder: Path, _modified: int, _size: int) -> Asset:
    return read_asset(folder)


def fingerprint() -> str:
    """SHA-256 (hex) over every file of every asset by relative path and content, thumbnails excepted."""
    root = catalog_root()
    digest = hashlib.sha256()
    for key in keys():
        for path in sorted(p for p in (root / key).rglob("*") if p.is_file() and p.name != "thumbnail.png"):
            content = path.read_bytes()
            digest.update(f"{path.relative_to(root).as_posix()}\0{len(content)}\0".encode())
            digest.update(content)
    return digest.hexdigest()
