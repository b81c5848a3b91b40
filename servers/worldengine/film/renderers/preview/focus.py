"""Blur what is not at the distance of focus, as much as a real lens of that aperture does."""

from __future__ import annotations

import numpy as np
from OpenGL import GL

from . import gl
from .eye import View
from .shadows import BLOCK

FRAME_M = 0.02025
"""Height of the picture on a full-frame camera that films in 16:9."""
WIDEST = 0.035
"""The widest blur that is drawn, as a share of the picture's height."""
TAPS = 64


def blur_px(focus_m: float, aperture: float, tangent: float, height: int) -> float:
    """The radius of the blur of a point at infinity, pixels: a thin lens whose focal length follows from the view's height.

    At distance d the radius is this times |d - focus| / d.
    """
    focal = FRAME_M / (2.0 * tangent)
    on_film = focal / aperture * focal / max(focus_m - focal, 0.2 * focal)
    return float(0.5 * on_film / FRAME_M * height)


class Focus:
    """Blurs a picture of a fixed size by its depth."""

    def __init__(self, width: int, height: int):
        self.result = gl.Target(width, height, GL.GL_RGBA16F)
        size = -(-width // BLOCK), -(-height // BLOCK)
        self._blocks, self._around = (gl.Target(*size, GL.GL_RG32F, linear=False) for _ in range(2))
        self._tiles = gl.Program("screen.vert", "tiles.frag")
        self._spread = gl.Program("screen.vert", "spread.frag")
        self._program = gl.Program("screen.vert", "focus.frag")

    def draw(self, picture: gl.Target, view: View, focus_m: float, aperture: float) -> int:
        """The texture of the blurred picture."""
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_BLEND)
        GL.glBindSampler(0, 0)
        height = self.result.height
        per_share = blur_px(focus_m, aperture, view.tangents[1], height)
        widest = min(WIDEST * height, per_share * 4.0)
        self._bound(picture, widest)
        self.result.bind()
        lens = np.array([focus_m, per_share, widest, TAPS])
        program = self._program.use().set(depth=0.0, near_m=view.near_m, lens=lens, block=BLOCK)
        program.texture("scene", 0, picture.colour).texture("depths", 1, picture.depth)
        program.texture("blocks", 2, self._around.colour)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        return self.result.colour

    def _bound(self, picture: gl.Target, widest: float) -> None:
        """Find the depths that may spread over the pixels of each block, at most `widest` pixels far."""
        self._blocks.bind()
        self._tiles.use().set(depth=0.0, block=BLOCK).texture("shadow_depth", 0, picture.depth)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        self._around.bind()
        reach = int(np.ceil((widest + 1.0) / BLOCK))
        self._spread.use().set(depth=0.0, reach=reach).texture("blocks", 0, self._blocks.colour)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
