"""The renderers, one file or folder each, turn a recorded state into a picture.

The folder is the list: a module that defines what `Renderer` names is a renderer of the still and the video pass, chosen by
its name in `WORLDKIT_RENDERER`. The result of a pass tells which one drew, in which version; pictures of one renderer never
answer for another. A drawing may also have `shared() -> bytes`: what all cameras together add to each picture (how far the
room reaches). Where it lacks that, a change of any camera makes the pictures of all others anew. And it may have
`blurred(moments, count, camera, quality)`: one picture of the light of `count` moments, each set up as it is taken from
`moments`. Where it lacks that, the pictures of the moments are averaged. And it may have `over(before, moments, camera,
quality)`: the same picture, for which it need not draw again what stands in the pictures `before` of the same shot; then also
`beside(moments, quality) -> (int, float)`: how many of these it draws at most with one of so many moments, as it is treated now,
and how many times as dear as that one each of them is.
"""

import os
from collections.abc import Callable, Hashable, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, Protocol

from worldkit import wheels
from worldkit.seams import Seam

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..treatment import Treatment

VARIABLE = "WORLDKIT_RENDERER"
USUAL = "preview"
PLAIN = "classic"
"""The renderer that takes over where a driver cannot do what another one asks."""
FINAL = "traced"
"""The renderer of the final pass."""
Quality = Literal["still", "video"] | float
"""The effort spent on a picture; a number asks for so many samples a pixel, where a renderer takes any (less than one: a draft)."""

Moment = Callable[[], "mujoco.MjData"]
"""Sets up what is seen at one time."""


class Before(NamedTuple):
    """Another picture of a shot: the moments while its shutter was open, by a name that is its own."""

    name: Hashable
    moments: Sequence[Moment]


class Drawing(Protocol):
    """Draws one model at one size. The same state always gives the same picture."""

    def image(self, data: "mujoco.MjData", camera: int, quality: Quality) -> "np.ndarray":
        """The picture of `data` through a camera of the model: uint8 (height, width, 3), RGB, row 0 the top.

        A RuntimeError says that the driver gave up; the plain renderer then draws.
        """

    def segmentation(self, data: "mujoco.MjData", camera: int) -> "np.ndarray":
        """Geom number behind each pixel, -1 where there is none, -2 the first flex, -3 the second: int32 (height, width), row 0 the
        top.
        """

    def treat(self, treatment: "Treatment") -> bool:
        """Apply this light, haze, focus and grading from now on; False says that this renderer cannot."""

    def close(self) -> None:
        """Free what it holds; nothing is drawn afterwards."""


class Renderer(Protocol):
    """The protocol of the modules of this folder."""

    PACKAGES: tuple[str, ...]
    """Distributions that decide how its pictures look: their versions are part of its own."""

    def take(self, model: "mujoco.MjModel", width: int, height: int) -> Drawing:
        """Prepare to draw a model in pictures of `width` x `height` pixels.

        Any exception says that it cannot draw here: a plainer renderer takes over, and the result tells why.
        """


SEAM: Seam[Renderer] = Seam(__name__, Renderer, "renderer")


def wanted() -> str:
    """The wanted renderer: the one that `WORLDKIT_RENDERER` names, else the usual one."""
    return os.environ.get(VARIABLE) or USUAL


def plainer(name: str) -> str:
    """The renderer that takes over from this one; empty for the plain one, after which there is none."""
    return "" if name == PLAIN else PLAIN if name == USUAL else USUAL


def installed(packages: tuple[str, ...]) -> dict[str, str]:
    """The versions of the installed distributions, by name."""
    return {package: found for package in packages if (found := wheels.version(package))}
