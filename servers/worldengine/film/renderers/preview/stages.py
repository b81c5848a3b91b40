"""What a picture of one quality is drawn into: effort, sizes, and the targets of its passes."""

from __future__ import annotations

from dataclasses import dataclass

from OpenGL import GL

from . import gl
from .develop import Developer
from .focus import Focus
from .occlusion import Occlusion
from .shadows import ShadowMap


@dataclass(frozen=True)
class Quality:
    """The effort spent on a picture."""

    scale: int
    shadow_pixels: int
    """A side of the shadow map, for large pictures; see `shadow_side`."""
    blockers: int
    filters: int
    occlusion_divisor: int
    occlusion_taps: int
    march: int
    """Steps of a mirror's ray through the picture."""


VIDEO = Quality(1, 2048, 8, 18, 3, 14, 9)
STILL = Quality(2, 4096, 24, 64, 3, 36, 22)
QUALITIES = {"video": VIDEO, "still": STILL}
LEAST_SHADOW = 1024
"""No shadow map has a smaller side: its widest penumbra would be narrower than in a large picture."""


def shadow_side(pixels: int, quality: Quality) -> int:
    """Side of the shadow map for a picture drawn `pixels` wide or high: twice as fine as the picture, or as the quality has it.

    A processor draws the map of a large picture in a quarter of a second, five times as long as a small picture beside it.
    """
    return min(quality.shadow_pixels, max(LEAST_SHADOW, 1 << (2 * pixels - 1).bit_length()))


PLACES = 4
"""Where a film wants smooth outlines, so many places of each pixel are drawn: what is thin is no longer dashed. Of a processor's time a
picture of 1280x720 pixels took 0.41 s instead of 0.25, one with hands and glass 1.0 instead of 0.4."""


def _fine(width: int, height: int) -> gl.Target | None:
    """A target with several places in each pixel; None where the driver has none."""
    try:
        return gl.Target(width, height, GL.GL_RGBA16F, depth=True, samples=PLACES)
    except (RuntimeError, GL.GLError):
        return None


class Stage:
    """The targets of one quality."""

    def __init__(self, width: int, height: int, quality: Quality):
        w, h = width * quality.scale, height * quality.scale
        self.width, self.height, self.quality = w, h, quality
        self.picture = gl.Target(w, h, GL.GL_RGBA16F, depth=True)
        self._fine: gl.Target | None = None
        self._of_places: gl.Program | None = None
        self.behind: gl.Target | None = None
        self.mirror: gl.Target | None = None
        self.focus: Focus | None = None
        d = quality.occlusion_divisor
        self.occlusion = Occlusion(max(w // d, 1), max(h // d, 1), quality.occlusion_taps)
        self.shadow = ShadowMap(shadow_side(max(w, h), quality))
        self.developer = Developer(w, h)

    def drawn(self, fine: bool) -> gl.Target:
        """Where what is opaque is drawn: `fine`, at several places in a pixel, which `picture` gets the mean of. A still is fine anyway."""
        if not fine or self.quality.scale > 1:
            return self.picture
        self._fine = self._fine or _fine(self.width, self.height) or self.picture
        return self._fine

    def mean(self, exposure: float) -> None:
        """Let `picture` be the mean of what was drawn at several places in each of its pixels, at the depth of one of them."""
        assert self._fine is not None
        self._fine.blit_to(self.picture, depth=True)
        if self._of_places is None:
            self._of_places = gl.Program("screen.vert", "mean.frag", PLACES=PLACES)
        self.picture.bind()
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_BLEND)
        program = self._of_places.use().set(depth=0.0, exposure=exposure)
        program.texture("scene", 0, self._fine.colour, GL.GL_TEXTURE_2D_MULTISAMPLE)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glEnable(GL.GL_DEPTH_TEST)
