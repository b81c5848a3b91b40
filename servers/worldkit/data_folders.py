"""Where the assets are: the catalog of the project, and the folder of whoever works on this machine.

Apart from what assets are, which costs a process a tenth of a second: every pass asks where they lie.
"""

import os
from pathlib import Path


def catalog_root() -> Path:
    """The catalog folder: `$WORLDWRIGHT_CATALOG`, else the repository's `catalog/`, else the one inside the wheel.

    Raises:
        FileNotFoundError: there is none; the message names the places looked at.
    """
    named = os.environ.get("WORLDWRIGHT_CATALOG")
    package = Path(__file__).resolve().parent
    places = [Path(named)] if named else [package.parents[1] / "catalog", package / "_catalog"]
    for place in places:
        if place.is_dir():
            return place.resolve()
    raise FileNotFoundError(
        f"no asset catalog at {' or '.join(map(str, places))}; point WORLDWRIGHT_CATALOG at a folder of assets"
    )


def own_root() -> Path:
    """The user's own assets, seen from every project: `$WORLDWRIGHT_ASSETS`, else `assets` in the user's data folder.

    It need not exist. A confined process is told where it is, since its home is another.
    """
    named = os.environ.get("WORLDWRIGHT_ASSETS")
    if named:
        return Path(named)
    return data_root() / "assets"


def data_root() -> Path:
    """The user's data folder, which also holds the signing key: `$WORLDWRIGHT_DATA`, or `worldwright` where the system keeps such."""
    named = os.environ.get("WORLDWRIGHT_DATA")
    if named:
        return Path(named)
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "worldwright"


def relative(path: Path) -> str:
    """An asset's file by its path below the root that it lies in, with slashes; the user's own begin with `own/`."""
    for root, before in ((own_root(), "own/"), (catalog_root(), "")):
        if path.is_relative_to(root):
            return before + path.relative_to(root).as_posix()
    return path.name
