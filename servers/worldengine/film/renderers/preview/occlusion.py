"""Ambient occlusion: contact shadows from the depth of the picture, at a fraction of its size."""

from __future__ import annotations

from collections.abc import Callable

from OpenGL import GL

from . import gl
from .eye import View


class Occlusion:
    """How much of the surroundings each pixel sees, smoothed; `result` holds it with the pixel's distance."""

    def __init__(self, width: int, height: int, taps: int, strength: float = 2.7):
        self.width, self.height, self._taps, self._strength = width, height, taps, strength
        self.guide = gl.Target(width, height, GL.GL_RGBA32F, depth=True, linear=False)
        self._raw = gl.Target(width, height, GL.GL_RG32F, linear=False)
        self.result = gl.Target(width, height, GL.GL_RG32F, linear=False)
        self._write_guide = gl.Program("thing.vert", "guide.frag", FULL=1)
        self._gather = gl.Program("screen.vert", "occlusion.frag")
        self._blur = gl.Program("screen.vert", "blur.frag")

    def draw(self, view: View, draw_things: Callable[[gl.Program], None], reach: float = 0.085) -> None:
        """Compute occlusion within `reach` times the distance of each point."""
        self.guide.bind()
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_GEQUAL)
        GL.glClearDepth(0.0)
        GL.glClearColor(0.0, 0.0, 0.0, 0.0)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT | GL.GL_COLOR_BUFFER_BIT)
        program = self._write_guide.use()
        program.set(view_projection=view.matrix(), eye=view.eye, forward=view.forward, rank_step=2e-4, mirrored=0)
        draw_things(program)
        GL.glDisable(GL.GL_DEPTH_TEST)
        self.result.bind()
        self._gather.use().set(
            depth=0.0,
            lens=(*view.tangents, self.width, self.height),
            to_view=view.rotation(),
            reach=reach,
            taps=self._taps,
            strength=self._strength,
        ).texture("guide", 0, self.guide.colour)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        for source, target, step in (
            (self.result, self._raw, (1.0 / self.width, 0.0)),
            (self._raw, self.result, (0.0, 1.0 / self.height)),
        ):
            target.bind()
            program = self._blur.use().set(depth=0.0, step_uv=step, wide=3)
            program.texture("shade_in", 1, source.colour).texture("guide", 0, self.guide.colour)
            GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
