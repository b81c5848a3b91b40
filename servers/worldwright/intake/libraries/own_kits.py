"""The project's own kits whose meshes lie in no folder: code of `catalog/make/kits`, made when one is first asked for.

A kit is an asset as it is made: jointed, weighed, stood on a floor. The clone stays small, and the table tells what each is before.
"""

import csv
import os
import subprocess
import sys
from functools import lru_cache
from pathlib import Path
from typing import Any

from worldkit import assets

from ..refusing import IntakeFailedError
from . import Offer

TABLE = "make/kits.csv"
"""Below the catalog: what each kit is, and its extents in metres, as it was made."""
SAID = 2_000


def offers() -> tuple[Offer, ...]:
    """All kits of the catalog that is used whose meshes do not lie in it."""
    try:
        table = assets.catalog_root() / TABLE
        rows = _rows(table, table.stat().st_mtime_ns)
    except OSError:  # another catalog, without kits
        return ()
    return tuple(offer for offer in rows if not (table.parents[1] / offer.key / "asset.yaml").is_file())


@lru_cache(maxsize=4)
def _rows(table: Path, _changed: int) -> tuple[Offer, ...]:
    with table.open(encoding="utf-8", newline="") as lines:
        return tuple(
            Offer(
                key=row["key"],
                name=row["key"].replace("_", " "),
                category=row["category"],
                words=row["description"],
                extents=(float(row["depth_m"]), float(row["width_m"]), float(row["height_m"])),
                licence="Apache-2.0",
                creator="",
                library="own_kits",
                chosen=True,
                whole=True,
            )
            for row in csv.DictReader(lines)
        )


def lay(key: str, folder: Path) -> tuple[Path, dict[str, Any]]:
    """Make a kit: a whole asset, by its `asset.yaml`.

    Raises:
        IntakeFailedError: its code did not come to an end.
    """
    root = assets.catalog_root()
    call = [sys.executable, "-P", "-m", "catalog.make", key, "--thumbnails", "--out", str(folder)]
    environment = {**os.environ, "PYTHONPATH": str(root.parent)}
    if sys.platform == "linux" and not environment.get("DISPLAY"):
        environment.setdefault("MUJOCO_GL", "egl")  # before anything loads the engine
    made = subprocess.run(
        call, cwd=root.parent, env=environment, stdin=subprocess.DEVNULL, capture_output=True, check=False
    )
    entry = folder / key / "asset.yaml"
    if not entry.is_file():
        told = made.stderr.decode(errors="replace")[-SAID:].strip().splitlines()
        raise IntakeFailedError(
            f"making it ended with {told[-1] if told else f'exit code {made.returncode}'}", code="not_made", place=f"{key}.py",
            next_move=f"see `python -m catalog.make {key}`; what it needs comes with `make .venv/.dev`",
        )  # fmt: skip
    return entry, {}


def icon(key: str) -> bytes:  # noqa: ARG001 - as every library is asked
    """None: its picture is drawn when it is made."""
    return b""


def installing() -> str:
    """Nothing is missing: it is code of this project."""
    return "use this project's own catalog"
