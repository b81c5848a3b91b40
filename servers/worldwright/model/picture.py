"""A tool result that shows something: data together with pictures.

Engines and tools return `Illustrated`; only `expose` knows how a transport carries pictures.
"""

import re
from dataclasses import dataclass
from pathlib import Path

from .frozen import Frozen

FILM_NAME = "moving.mp4"


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
    folder: Path | None = None
    """Where the pictures lie already, by their `file_name`."""
    film: bytes = b""
    """A film that goes with them (MP4), which lies in `folder` as `FILM_NAME` where they are kept."""


def file_name(number: int, picture: Picture) -> str:
    """What a picture is called as a file, the first having number 1: by the first words of its caption."""
    words = re.sub(r"[^a-z0-9]+", "-", picture.caption.split(" (")[0].split(", row")[0].lower()).strip("-")
    return f"{number:02}-{words[:40]}.{'jpg' if picture.format == 'jpeg' else picture.format}"


def png(picture: Picture) -> Picture:
    """The same picture as PNG, which every program shows; what cannot be read stays as it is."""
    import cv2
    import numpy as np

    image = None if picture.format == "png" else cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_COLOR)
    return picture if image is None else Picture(cv2.imencode(".png", image)[1].tobytes(), picture.caption)
