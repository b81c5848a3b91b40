"""Smooth outlines of what stands, nearly for nothing: where a frame shows what a frame of the same still camera shows, it shows it as
that one does when it is drawn at several places in each pixel.

A film whose camera stands still would else pay for every frame, threefold, to see the same edges again. What moves keeps its own
pixels; the shutter smears those.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np

SAME = 3
"""Steps of 255 by which a pixel may differ and still show the same."""
LEAST_FRAMES = 24
"""A shot of fewer frames is over before its plates would have paid."""


class Plate(NamedTuple):
    """One frame, drawn plainly and finely: uint8 (height, width, 3) each."""

    plain: "np.ndarray"
    fine: "np.ndarray"


class StandingOutlines:
    """The plates of the shot that is drawn.

    Args:
        draw: a frame, plainly or finely; uint8 (height, width, 3).
    """

    def __init__(self, draw: Callable[[int, bool], "np.ndarray"]) -> None:
        self._draw, self._plates = draw, dict[int, Plate]()

    def ready(self, frames: tuple[int, ...]) -> None:
        """Draw the plates of a shot, unless they are there; those of another are forgotten."""
        self._plates = {
            number: self._plates.get(number) or Plate(self._draw(number, False), self._draw(number, True))
            for number in frames
        }

    def smoothed(self, picture: "np.ndarray") -> "np.ndarray":
        """A plain picture of the shot, in which what stands has smooth outlines."""
        import cv2
        import numpy as np

        found = picture.copy()
        for plate in self._plates.values():
            apart = cv2.absdiff(picture, plate.plain).max(axis=2)
            np.copyto(found, plate.fine, where=(apart <= SAME)[..., None])
        return found
