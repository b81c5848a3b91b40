"""Blur what is not at the distance of focus, as much as a real lens of that aperture does."""

from __future__ import annotations

import numpy as np
from OpenGL import GL

from . import gl
from .eye import View

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
        self._program = gl.Program("screen.vert", "focus.frag")

    def draw(self, picture: gl.Target, view: View, focus_m: float, aperture: float) -> int:
        """The texture of the blurred picture."""
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_BLEND)
        GL.glBindSampler(0, 0)
        self.result.bind()
        height = self.result.height
        per_share = blur_px(focus_m, aperture, view.tangents[1], height)
        lens = np.array([focus_m, per_share, min(WIDEST * height, per_share * 4.0), TAPS])
        program = self._program.use().set(depth=0.0, near_m=view.near_m, lens=lens)
        program.texture("scene", 0, picture.colour).texture("depths", 1, picture.depth)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        return self.result.colour
