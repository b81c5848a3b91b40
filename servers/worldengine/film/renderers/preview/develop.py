"""Develop scene light into a picture: bloom, exposure, vignette, film curve, smooth edges, dither."""

from __future__ import annotations

import numpy as np
from OpenGL import GL

from ...film_curve import BRIGHTEST, film_curve, gains
from ...treatment import PLAIN, Treatment
from . import gl

STEPS = (2, 3, 4)
"""The glow is drawn smaller than the picture by these powers of two."""
CURVE_STEPS = 4096


def _curve_texture() -> int:
    root = np.linspace(0.0, 1.0, CURVE_STEPS)
    values = np.ascontiguousarray(film_curve(BRIGHTEST * root**4), dtype=np.float32)[None, :]
    handle = gl.texture(GL.GL_R32F, CURVE_STEPS, 1)
    GL.glTexSubImage2D(GL.GL_TEXTURE_2D, 0, 0, 0, CURVE_STEPS, 1, GL.GL_RED, GL.GL_FLOAT, values)
    return handle


class Developer:
    """Develops a floating-point picture of a fixed size into bytes."""

    def __init__(self, width: int, height: int):
        self.width, self.height = width, height
        self._glow = gl.Program("screen.vert", "glow.frag")
        self._quarter = gl.Program("screen.vert", "quarter.frag")
        self._films: dict[bool, gl.Program] = {}
        self._edges = gl.Program("screen.vert", "edges.frag")
        self._curve = _curve_texture()
        self._halves = [gl.Target(max(width >> i, 1), max(height >> i, 1), GL.GL_RGBA16F) for i in STEPS]
        self._developed = gl.Target(width, height, GL.GL_RGBA8)
        self._out = gl.Target(width, height, GL.GL_RGBA8)

    def draw(
        self, scene: int, exposure: float, vignette: float, treatment: Treatment = PLAIN, *, rounded: bool = False
    ) -> np.ndarray:
        """Develop the texture `scene` as a film grades it, around lamps with a `rounded` glow: uint8 (H, W, 3), row 0 the top."""
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_BLEND)
        source, size = scene, (self.width, self.height)
        for number, half in enumerate(self._halves):
            half.bind()
            program = (self._glow if number else self._quarter).use()
            program.set(depth=0.0, texel=(1.0 / size[0], 1.0 / size[1])).texture("from", 0, source)
            GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
            source, size = half.colour, (half.width, half.height)
        self._developed.bind()
        if rounded not in self._films:
            self._films[rounded] = gl.Program("screen.vert", "develop.frag", ROUND=int(rounded))
        program = (
            self._films[rounded]
            .use()
            .set(
                depth=0.0,
                exposure=exposure * 2.0**treatment.grade_exposure_stops,
                vignette=vignette if treatment.grade_vignette is None else treatment.grade_vignette,
                gains=gains(treatment.grade_temperature, treatment.grade_tint),
                glow_share=0.045 if treatment.grade_glow is None else treatment.grade_glow,
                grading=(treatment.grade_contrast, treatment.grade_saturation, 1.0 - treatment.grade_fade, 0.0),
            )
        )
        program.texture("scene", 0, scene).texture("glow", 1, source).texture("curve", 2, self._curve)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        self._out.bind()
        program = self._edges.use().set(depth=0.0, texel=(1.0 / self.width, 1.0 / self.height))
        program.texture("picture", 0, self._developed.colour)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
        raw = GL.glReadPixels(0, 0, self.width, self.height, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE)
        return np.frombuffer(raw, dtype=np.uint8).reshape(self.height, self.width, 4)[::-1, :, :3]
