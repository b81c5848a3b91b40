"""Assets that are folders with an `asset.yaml`, below one root: which there are, and which files each consists of."""

import os
import time
from pathlib import Path

from .. import listings

SETTLED_NS = 100_000_000
"""A folder that changed less long ago may change again within the same tick of its clock, so it is listed anew."""

_seen: dict[Path, tuple[int, tuple[str, ...], tuple[str, ...]]] = {}


def keys(root: Path) -> tuple[str, ...]:
    """The folders below the root that hold an `asset.yaml`, sorted; what begins with a dot is being written.

    It is called at every look-up, so whole folders are remembered as long as none comes or goes.
    """
    try:
        changed = root.stat().st_mtime_ns
    except OSError:
        return ()
    held = _seen.get(root)
    if held is None or held[0] != changed:
        names = sorted(entry.name for entry in os.scandir(root) if entry.is_dir() and not entry.name.startswith("."))
        whole = tuple(name for name in names if os.path.isfile(f"{root}/{name}/asset.yaml"))  # noqa: PTH113 (ten thousand)
        held = (changed, whole, tuple(sorted({*names} - {*whole})))
        if time.time_ns() - changed > SETTLED_NS:
            _seen[root] = held
    found = [name for name in held[2] if (root / name / "asset.yaml").is_file()]
    return tuple(sorted((*held[1], *found))) if found else held[1]


def files(root: Path, key: str) -> tuple[Path, ...]:
    """All files below an asset's folder, sorted, except the thumbnail, which decides nothing."""
    found = map(Path, listings.files(str(root / key)))
    return tuple(sorted(path for path in found if path.name != "thumbnail.png"))
