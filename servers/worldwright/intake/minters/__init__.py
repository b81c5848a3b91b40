"""Servers that make a mesh of a picture, one file each: programs that a user runs, or services that a user pays.

The folder is the list. What they answer is a stranger's file like any other: it is taken in confined, by `taking_in.add`.
"""

from typing import Protocol

from worldkit.seams import Seam

from ..orders import Order, Terms
from ..web_calls import Server


class Minter(Protocol):
    """What a module of this folder defines."""

    TERMS: Terms
    """How it is come by, and what it costs."""

    def mint(self, picture: bytes, server: Server, order: Order) -> bytes:
        """The GLB (or OBJ) that it makes of a picture (PNG or JPEG).

        Raises:
            MintError: it is not there, refuses, or answers something else.
        """


SEAM: Seam[Minter] = Seam(__name__, Minter, "server that makes meshes")
"""Every server that is known, by the name of its file."""
