"""Services that paint a picture of words, one file each; the folder is the list. What they paint becomes a mesh by a minter."""

from typing import Protocol

from worldkit.seams import Seam

from ..orders import Price, Terms
from ..web_calls import Server


class Painter(Protocol):
    """What a module of this folder defines."""

    TERMS: Terms
    """How it is come by; its price is that of `MODEL`."""
    MODEL: str
    """Which of its models paints if no other is asked for."""

    def price(self, model: str) -> Price:
        """What a picture by a model costs."""

    def paint(self, words: str, model: str, server: Server) -> bytes:
        """The picture that it paints, PNG or JPEG.

        Raises:
            MintError: it is not there, refuses, or answers something else.
        """


SEAM: Seam[Painter] = Seam(__name__, Painter, "service that paints")
"""Every service that is known, by the name of its file."""
