"""Where the assets are."""

import os
from pathlib import Path


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
