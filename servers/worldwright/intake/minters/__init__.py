"""Servers that make a mesh of a picture, one file each: programs that a user runs, or services that a user pays.

The folder is the list. What they answer is a stranger's file like any other: it is taken in confined, by `taking_in.add`.
"""

from typing import Protocol

from worldkit.seams import Seam

from ...model.errors import WorldwrightError


class MintError(WorldwrightError):
    """A server made no mesh; `code` says why: `unreachable`, `refused`, `rate_limited` or `garbage`."""

    def __init__(self, cause: str, *, code: str, place: str, next_move: str) -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code


class Minter(Protocol):
    """What a module of this folder defines."""

    def variable(self) -> str:
        """The name of the environment variable that holds its address."""

    def starting(self) -> str:
        """How a user comes by one, in a few words."""

    def mint(self, picture: bytes, address: str) -> bytes:
        """The GLB that it makes of a picture (PNG or JPEG).

        Raises:
            MintError: it is not there, refuses, or answers something else.
        """


SEAM: Seam[Minter] = Seam(__name__, Minter, "server that makes meshes")
"""Every server that is known, by the name of its file."""
