"""Packaged libraries of meshes, one file each: what each offers is found at once, and taken in when it is first asked for.

The folder is the list. A library answers from what a package laid on this machine, never from the network. Taking in is the
same for all of them (`taking_in.add`), and makes of an offer an asset of the user's own.
"""

from collections.abc import Iterator
from dataclasses import dataclass
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


class Library(Protocol):
    """What a module of this folder defines."""

    def offers(self) -> tuple[Offer, ...]:
        """All that it has on this machine, by key; none where its package is not installed. It is called often."""

    def lay(self, key: str, folder: Path) -> tuple[Path, dict[str, Any]]:
        """Lay out the mesh of an offer and what belongs to it in a folder; returns its file, and what `taking_in.add` is asked.

        Raises:
            IntakeFailedError: what the package holds under that key is not whole, or more than may be laid out.
        """

    def installing(self) -> str:
        """The command that brings its package."""


SEAM: Seam[Library] = Seam(__name__, Library, "library of meshes")


def offers() -> dict[str, Offer]:
    """Every offer of every library, by key."""
    return {offer.key: offer for offer in _all()}


def _all() -> Iterator[Offer]:
    for name in SEAM.names():
        yield from SEAM.find(name).offers()
