"""A tool result that shows something: data together with PNG pictures.

Engines and tools return `Illustrated`; only `expose` knows how a transport carries pictures.
"""

from dataclasses import dataclass

from .frozen import Frozen


@dataclass(frozen=True)
class Picture:
    """One encoded picture with its caption."""

    data: bytes
    caption: str
    format: str = "png"


@dataclass(frozen=True)
class Illustrated:
    """Typed data and the pictures that go with it."""

    data: Frozen
    pictures: tuple[Picture, ...] = ()
