"""An asset's folder appears in its destination whole, in one step, or not at all."""

import contextlib
import secrets
import shutil
from collections.abc import Mapping
from pathlib import Path

from worldkit import assets
from worldkit.assets.reading import AssetError, read_asset
from worldkit.data_folders import data_root
from worldkit.files import write_atomic

from ..model.errors import WorldwrightError
from ..model.evidence.assets_used import OURS
from ..model.storage import writing


class RegisterError(WorldwrightError):
    """An asset cannot be registered; what was there before still is."""

    code = "asset"


def root_of(to: str) -> Path:
    """The folder of a destination: `own` or `catalog`."""
    return assets.own_root() if to == "own" else assets.catalog_root()


def free(key: str, root: Path, replace: bool) -> None:
    """Refuse a key that is taken, unless it is by an asset of the same destination that may be replaced.

    Raises:
        RegisterError: the key is taken, by an asset or by something else; or no pass may read what lies there.
    """
    if root == assets.own_root() and data_root().resolve().is_relative_to(root.resolve()):
        raise RegisterError(
            "the folder of your own assets holds your signing key, too, so that no pass may read it",
            place=str(root),
            next_move="point WORLDWRIGHT_ASSETS at a folder of assets alone",
        )
    if key in OURS:
        raise RegisterError(
            f"the catalog keeps a folder {key} that is no asset's", place="key", next_move="give it another --key"
        )
    here = (root / key).exists()
    if here and not (root / key / "asset.yaml").is_file():  # somebody's folder, which nothing may delete
        raise RegisterError(
            f"a folder of the name {key} is there, which is no asset",
            place=str(root / key),
            next_move="give it another --key",
        )
    if here and replace:
        return
    if here or key in assets.keys():  # noqa: SIM118 - a function of the catalog, not a mapping
        raise RegisterError(
            f"there is an asset {key} already",
            place=str(root / key) if here else "another source",
            next_move="give it another --key" + (", or --replace it" if here else ""),
        )


def register(key: str, files: Mapping[str, bytes], root: Path, *, replace: bool = False) -> Path:
    """Write an asset's files beside its place, see that they are an asset, and put them there in one step; returns the folder.

    Raises:
        RegisterError: they are no asset, or the key was taken meanwhile.
        StorageError: the destination cannot be written.
    """
    beside = root / f".incoming-{secrets.token_hex(6)}"
    earlier = beside / "earlier"
    try:
        with writing(f"the asset {key}", root):
            for name, content in files.items():
                write_atomic(beside / key / name, content)
            try:
                read_asset(beside / key)
            except AssetError as error:
                raise RegisterError(
                    f"what was made of it is no asset: {error}", place=key, next_move="report it, with the file"
                ) from error
            free(key, root, replace)
            try:
                if replace and (root / key).exists():
                    (root / key).rename(earlier)
                (beside / key).rename(root / key)  # fails where another add was there first: its folder is not empty
            except BaseException as error:  # an interruption between the two would else lose the earlier one
                if earlier.exists() and not (root / key).exists():
                    with contextlib.suppress(OSError):
                        earlier.rename(root / key)
                if isinstance(error, OSError):
                    free(key, root, replace)
                raise
    finally:
        if not earlier.exists() or (root / key).exists():
            shutil.rmtree(beside, ignore_errors=True)
    return root / key
