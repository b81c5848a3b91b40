"""A tool result that shows something: data together with pictures.

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


def png(picture: Picture) -> Picture:
    """The same picture as PNG, which every program shows; what cannot be read stays as it is."""
    import cv2
    import numpy as np

    image = None if picture.format == "png" else cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_COLOR)
    return picture if image is None else Picture(cv2.imencode(".png", image)[1].tobytes(), picture.caption)
