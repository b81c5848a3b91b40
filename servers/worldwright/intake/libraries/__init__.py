"""Packaged libraries of meshes, one file each: what each offers is found at once, and taken in when it is first asked for.

The folder is the list. A library answers from what a package laid on this machine, never from the network. Taking in is the
same for all of them (`taking_in.add`), and makes of an offer an asset of the user's own.
"""

import csv
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, Protocol

from worldkit.seams import Seam


@dataclass(frozen=True)
class Offer:
    """A mesh that a library has. Lengths are metres."""

    key: str
    name: str
    category: str
    words: str
    """By which it is found besides its name."""
    extents: tuple[float, float, float]
    """Along our axes: depth from its front, width, height."""
    licence: str
    creator: str
    library: str
    chosen: bool = False
    """Whether its picture was looked at, and it is what its name says: such offers come first."""
    whole: bool = False
    """Whether it is laid out as an asset that is whole, of which nothing more can be asked."""

    def described(self) -> str:
        """Its name, and what else it is found by."""
        return f"{self.name} ({self.words})" if self.words else self.name


class Library(Protocol):
    """What a module of this folder defines."""

    def offers(self) -> tuple[Offer, ...]:
        """All that it has on this machine, by key; none where its package is not installed. It is called often."""

    def lay(self, key: str, folder: Path) -> tuple[Path, dict[str, Any]]:
        """Lay out the mesh of an offer and what belongs to it in a folder; returns its file, and what `taking_in.add` is asked
        besides what the offer is called. An `asset.yaml` in a folder of the key's name is an asset that is whole.

        Raises:
            IntakeFailedError: what the package holds under that key is not whole, or more than may be laid out.
        """

    def icon(self, key: str) -> bytes:
        """A PNG of an offer; empty where there is none."""

    def installing(self) -> str:
        """The command that brings its package."""


SEAM: Seam[Library] = Seam(__name__, Library, "library of meshes")


def offers() -> dict[str, Offer]:
    """Every offer of every library, by key; those that were chosen under the name by which they were recognised."""
    return {offer.key: _named(offer) for offer in _all()}


@cache
def chosen() -> dict[str, str]:
    """What the chosen offers are called, by key: `chosen.csv`, for which every picture of the library was looked at."""
    with (Path(__file__).parent / "chosen.csv").open(encoding="utf-8", newline="") as lines:
        return {row["key"]: row["name"] for row in csv.DictReader(lines)}


@lru_cache(maxsize=4096)
def _named(offer: Offer) -> Offer:
    name = chosen().get(offer.key)
    if name is None:
        return offer
    return replace(offer, name=name.capitalize(), words=f"{offer.name}, {offer.words}".strip(", "), chosen=True)


def _all() -> Iterator[Offer]:
    for name in SEAM.names():
        yield from SEAM.find(name).offers()
