"""Draw the surroundings of a setting by longitude and latitude, for renderers that are lit by such a picture."""

from __future__ import annotations

import numpy as np
from OpenGL import GL

from worldkit.settings import Setting

from ...treatment import Treatment
from . import gl
from .lighting import sky_uniforms
from .shaded import context
from .surroundings import noise_map


def draw(setting: Setting, told: Treatment, width: int, *, lamps: bool) -> np.ndarray:
    """Radiance (width / 2, width, 3) along all directions, row 0 the zenith, column 0 toward +y, then toward +x.

    Args:
        setting: the world's setting, changed already as the film asks.
        told: what the film asks for.
        width: pixels.
        lamps: with what only mirrors and matt things see of the light.

    Raises:
        RuntimeError: there is no OpenGL here, or it lacks something.
    """
    height = width // 2
    current = context(width, height)
    try:
        current.make_current()
        gl.prepare_depth()
        target = gl.Target(width, height, GL.GL_RGBA32F)
        target.bind()
        program = gl.Program("screen.vert", "sky.frag", BAKE=2, LAMP=int(lamps), SETTING=setting.index).use()
        program.set(depth=0.0, **sky_uniforms(setting, told)).texture("noise_map", 3, noise_map())
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        raw = GL.glReadPixels(0, 0, width, height, GL.GL_RGB, GL.GL_FLOAT)
    finally:
        current.free()
    picture = np.frombuffer(raw, dtype=np.float32).reshape(height, width, 3)[::-1]
    return np.ascontiguousarray(picture) * np.float32(setting.sky)
