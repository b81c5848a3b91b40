"""`worldwright asset`: take in a mesh file, keep what a run sculpted, list the assets of every source, show one."""

from typing import Annotated

import click
from pydantic import Field

from worldkit.data_folders import own_root

from ..adding_assets import add_asset, keep_sculpt
from ..cli import verb
from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from .catalog_page import page
from .of_pictures import mint
from .of_words import picture
from .packaged_robots import robot
from .unpacking import unpack


class AssetLine(Frozen):
    """One asset, in a list."""

    key: str
    source: str
    height_m: float
    mass_kg: float
    description: str


class AssetLines(Frozen):
    """Assets by key."""

    assets: tuple[AssetLine, ...] = ()
    hidden: tuple[str, ...] = ()
    """Keys of the user's own folder that the catalog has too, whose asset is the one that is used."""

    def text(self) -> str:
        """One asset a line."""
        rows = [f"{a.key:24} {a.source:12} {a.height_m:g} m, {a.mass_kg:.3g} kg  {a.description}" for a in self.assets]
        rows += [
            f"{key}: the catalog's is used; rename yours, its folder in {own_root()} and its `key`"
            for key in self.hidden
        ]
        return "\n".join(rows) or "no asset"


class AssetFacts(Frozen):
    """What an asset's `asset.yaml` says, and where it lies."""

    key: str
    source: str
    folder: str
    category: str
    description: str
    extents_m: tuple[float, float, float]
    mass_kg: float
    friction: float
    restitution: float | None
    pieces: tuple[str, ...]
    """Kinds of the pieces that it collides as, each with how many."""
    supports: tuple[str, ...]
    looks: tuple[str, ...]
    licence: str
    creator: str = ""
    made_by: str = ""
    mended: tuple[str, ...] = ()

    def text(self) -> str:
        """A line for each fact."""
        size = " x ".join(f"{side:g}" for side in self.extents_m)
        lines = [
            f"{self.key}: {self.description} ({self.category})",
            f"  {size} m, {self.mass_kg:.3g} kg, friction {self.friction:g}, restitution {self.restitution}",
            f"  collides as {', '.join(self.pieces) or 'its box'}; rests on: {', '.join(self.supports)}",
            f"  licence: {self.licence}{f', by {self.creator}' if self.creator else ''}; {self.made_by}",
            *(f"  {line}" for line in self.mended),
            f"  looks: {', '.join(self.looks) or 'its own'}",
            f"  {self.source}: {self.folder}",
        ]
        return "\n".join(lines)


def list_assets(
    source: Annotated[str | None, Field(description="Only of this source, e.g. own_folder.")] = None,
) -> AssetLines:
    """List the assets of every source; `worldwright retrieve find-asset WORDS` finds one."""
    from worldkit import assets
    from worldkit.assets import catalog

    sources = catalog.sources()
    rows = (asset for asset in assets.entries() if source in (None, sources[asset.key]))
    return AssetLines(
        assets=tuple(
            AssetLine(
                key=asset.key,
                source=sources[asset.key],
                height_m=round(asset.metric_height, 4),
                mass_kg=round(asset.mass_at(), 4),
                description=asset.description,
            )
            for asset in rows
        ),
        hidden=catalog.hidden(),
    )


def show(key: Annotated[str, Field(description="The asset's key.")]) -> AssetFacts:
    """Show what is known of one asset: size, mass, what it collides as, licence, and what was mended."""
    from worldkit import assets
    from worldkit.assets import catalog

    try:
        asset = assets.find(key)
    except (assets.UnknownAssetError, assets.AssetError) as error:
        raise NotFoundError(str(error), place=key, next_move="worldwright asset list") from error
    kinds = [piece.type for piece in asset.collision]
    size = asset.extents()
    return AssetFacts(
        key=asset.key,
        source=catalog.sources()[key],
        folder=str(asset.folder),
        category=asset.category,
        description=asset.description,
        extents_m=(round(size[0], 4), round(size[1], 4), round(size[2], 4)),
        mass_kg=round(asset.mass_at(), 4),
        friction=asset.friction,
        restitution=asset.restitution,
        pieces=tuple(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds)),
        supports=("top", *(support.name for support in asset.supports)),
        looks=tuple(asset.looks),
        licence=asset.licence,
        creator=asset.creator,
        made_by=asset.source,
        mended=asset.mended,
    )


command = click.Group(
    "asset",
    {
        "add": verb(add_asset),
        "keep": verb(keep_sculpt),
        "list": verb(list_assets),
        "show": verb(show),
        "unpack": verb(unpack),
        "robot": verb(robot),
        "page": verb(page),
        "mint": verb(mint),
        "picture": verb(picture),
    },
    help="Make an asset of a mesh file of yours, or of what a run sculpted; list the assets of every source; show one; unpack a robot; write a page of all.",
)
