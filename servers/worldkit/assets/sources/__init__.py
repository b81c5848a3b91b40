"""Sources of assets, one file each: what answers by a key with a mesh, its licence, its size, its weight.

The folder is the list: whoever adds a module that defines what `Source` names has added a source. Whatever delivers an
asset, it comes in by one way (`worldkit.assets.add`), is searched by one tool, and the worlds that use it depend on its
files and on no others. A program runs where it sees the catalog folder and its own, and nothing is downloaded there: a source
that fetches puts what it fetched below the catalog first.
"""

from pathlib import Path
from typing import Protocol

from ...seams import Seam
from ..entry import Asset


class Source(Protocol):
    """What a module of this folder defines."""

    def keys(self) -> tuple[str, ...]:
        """Every key that it delivers, sorted, and no key of another source; it is called often, so it must be cheap."""

    def find(self, key: str) -> Asset:
        """One of its keys as an entry, with where it is from and under which licence.

        Raises:
            AssetError: what is there is no asset; the message names file, key and remedy.
        """

    def example(self, catalog: Path) -> str:
        """Lay out in an empty catalog folder what it needs to deliver one asset; returns its key. It is the source's test."""

    def files(self, key: str) -> tuple[Path, ...]:
        """Every file that decides what the asset is, sorted: it changed when one of them has."""


SEAM: Seam[Source] = Seam(__name__, Source, "source of assets")
