"""What each pixel of a picture shows first: the number of its thing, and how far away that is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from ...carrying import RIM_PX, Surfaces
from . import gl
from .eye import View, of_camera

if TYPE_CHECKING:
    import mujoco

    from .painter import Painter


class FirstSeen:
    """Draws the things of a painter as numbers, at most as large as `width` and `height`.

    Args:
        rank_step: the share of its distance by which each geom lies nearer than those before it.
    """

    def __init__(self, model: mujoco.MjModel, painter: Painter, width: int, height: int, rank_step: float) -> None:
        self.model, self.painter, self.width, self.height, self._rank_step = model, painter, width, height, rank_step
        self._number: gl.Target | None = None
        self._surfaces: dict[int, gl.Target] = {}
        self._surface_at: gl.Program | None = None

    def numbers(self, data: mujoco.MjData, camera: int, clear: bool | None = None) -> np.ndarray:
        """Geom number of each pixel, -1 for none, flexes from -2 down: int32 (H, W), row 0 the top; `clear` False: of what is opaque."""
        if self._number is None:
            self._number = gl.Target(self.width, self.height, GL.GL_R32I, depth=True, linear=False)
            self._ident = gl.Program("thing.vert", "ident.frag", FULL=0)
        self.painter.upload(data)
        self._number.bind()
        GL.glClearBufferiv(GL.GL_COLOR, 0, np.array([-1, 0, 0, 0], dtype=np.int32))
        self._draw(self._ident.use(), of_camera(self.model, data, camera, self.width, self.height), clear)
        raw = GL.glReadPixels(0, 0, self.width, self.height, GL.GL_RED_INTEGER, GL.GL_INT)
        return np.frombuffer(raw, dtype=np.int32).reshape(self.height, self.width)[::-1].copy()

    def surfaces(self, data: mujoco.MjData, camera: int, coarser: int = 1) -> Surfaces:
        """What each pixel shows first, be it glass, and how far away; `coarser` times smaller each way, and then also behind it."""
        self._surface_at = program = self._surface_at or gl.Program("thing.vert", "surface_at.frag", FULL=0)
        if coarser not in self._surfaces:
            size = max(self.width // coarser, 1), max(self.height // coarser, 1)
            self._surfaces[coarser] = gl.Target(*size, GL.GL_RG32F, depth=True, linear=False)
        target, view = self._surfaces[coarser], of_camera(self.model, data, camera, self.width, self.height)
        self.painter.upload(data)
        program.use().set(forward=view.forward)

        def seen(clear: bool | None, behind: Surfaces | None = None) -> Surfaces:
            target.bind()
            GL.glClearBufferfv(GL.GL_COLOR, 0, np.array([-1, 0, 0, 0], dtype=np.float32))
            self._draw(program, view, clear)
            both = np.empty((target.height, target.width, 2), np.float32)
            GL.glReadPixels(0, 0, target.width, target.height, GL.GL_RG, GL.GL_FLOAT, both)
            things = self.painter.numbers()[np.rint(both[::-1, :, 0]).astype(np.int32)]
            rim, depth = RIM_PX if coarser == 1 else 0, np.ascontiguousarray(both[::-1, :, 1])
            return Surfaces(things, depth, self.painter.poses(), view, rim, behind, self.painter.rounds())

        return seen(None, seen(False) if coarser > 1 and self.painter.clear() else None)

    def _draw(self, program: gl.Program, view: View, clear: bool | None = None) -> None:
        """Draw all things with a program into the bound target, whose colour is clear, and let it be read."""
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_GEQUAL)
        GL.glDisable(GL.GL_BLEND)
        GL.glClearDepth(0.0)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        program.set(view_projection=view.matrix(), eye=view.eye, rank_step=self._rank_step, mirrored=0)
        self.painter.draw(program, view, self.height, clear=clear)
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
