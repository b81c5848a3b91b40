"""Assets made by code: `python -m catalog.make` writes each as a folder of the catalog, with its `asset.yaml`."""

from pathlib import Path

from ...data_folders import catalog_root
from .. import folders
from ..entry import Asset
from ..reading import read_asset

CUBE = "".join(f"v {x} {y} {z}\n" for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)) + "".join(
    f"f {a} {b} {c}\n"
    for a, b, c in (
        (1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2),
        (3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5), (2, 6, 8), (2, 8, 4),
    )
)  # fmt: skip
SAID = """\
category: toy
description: A cube of wood
source: "an example"
licence: CC0-1.0
native_extents: [1.0, 1.0, 1.0]
metric_height: 0.1
density: 700
friction: 0.5
visual: [{mesh: cube.obj, material: wood}]
materials: {wood: {rgba: [0.6, 0.4, 0.2, 1.0]}}
"""


def keys() -> tuple[str, ...]:
    """The folders of the catalog that hold an `asset.yaml`."""
    return folders.keys(catalog_root())


def find(key: str) -> Asset:
    """What its `asset.yaml` says."""
    return read_asset(catalog_root() / key)


def example(catalog: Path) -> str:
    """A cube of wood, of one triangulated box."""
    return cube(catalog / "cube")


def cube(folder: Path) -> str:
    """Lay out that cube as a new folder; returns its key."""
    folder.mkdir(parents=True)
    (folder / "cube.obj").write_text(CUBE, encoding="utf-8")
    (folder / "asset.yaml").write_text(SAID, encoding="utf-8")
    return folder.name


def files(key: str) -> tuple[Path, ...]:
    """All files below its folder, except the thumbnail, which decides nothing."""
    return folders.files(catalog_root(), key)
