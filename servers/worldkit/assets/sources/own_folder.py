"""The user's own assets, taken in by `worldwright asset add`: a folder each, seen from every project on this machine."""

from pathlib import Path

from ...data_folders import own_root
from .. import folders
from ..entry import Asset
from ..reading import read_asset
from . import recipes


def keys() -> tuple[str, ...]:
    """The folders of the user's own that hold an `asset.yaml`."""
    return folders.keys(own_root())


def find(key: str) -> Asset:
    """What its `asset.yaml` says."""
    return read_asset(own_root() / key)


def example(catalog: Path) -> str:
    """A cube of wood in the user's folder; the catalog stays empty."""
    return recipes.cube(own_root() / "own_cube")


def files(key: str) -> tuple[Path, ...]:
    """All files below its folder, except the thumbnail, which decides nothing."""
    return folders.files(own_root(), key)
