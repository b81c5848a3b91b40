"""Assets in a world: look them up without the simulator, add them to an `MjSpec` scaled to a plan's height.

    mug = assets.find("mug")                       # facts only: no mujoco import
    mug.extents(0.10)                              # (x, y, z) metres when it is 0.10 m high
    mug.support("inside", height=0.10).z           # metres above the mug's lowest point
    assets.add(spec, "mug", name="mug", height=0.10, pos=(0, 0, 0.05))

Conventions: z up, +X front, metres. `pos` is the centre of the asset's bounding box, which is also the origin of the
body; a mesh is scaled uniformly so that its bounding box gets the given height. To rest an asset of height `h` on a
plane at `z`, put its centre at `z + h / 2`. To rest something inside or on another asset use that asset's supports:
the supporting plane is at `other_z - other_h / 2 + other.support(name, height=other_h).z`.
"""

from ..data_folders import catalog_root, own_root, relative
from .catalog import UnknownAssetError, entries, files, find, keys
from .entry import Asset, Piece, Support
from .instance import add
from .reading import AssetError

__all__ = [
    "Asset",
    "AssetError",
    "Piece",
    "Support",
    "UnknownAssetError",
    "add",
    "catalog_root",
    "entries",
    "files",
    "find",
    "keys",
    "own_root",
    "relative",
]
