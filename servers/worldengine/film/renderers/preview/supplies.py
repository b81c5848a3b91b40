"""Make shapes and pictures on the graphics side when they are first needed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from worldkit.materials import paint

from . import gl, unit_shapes
from .finish import Finish, model_pixels

if TYPE_CHECKING:
    import mujoco

PICTURE_PIXELS = 512
GROUND_PIXELS = 1024
CUBE_PIXELS = 160
SMALL = 400
"""Up to this height of a picture, pixels, half the size is enough: painting costs most of a single picture."""
NO_PAINT, SIDES, AROUND, BY_COORDINATES = range(4)


def sectors(pixels: float, least: int = 16) -> int:
    """The number of sectors with which a round thing of this radius on screen looks smooth: its outline errs by 1/6 pixel.

    N sectors miss the circle by R (1 - cos(pi / N)), so N = 5.4 sqrt(R); few sizes, so that shapes are shared. It has at `least`
    so many.
    """
    needed = 5.4 * pixels**0.5
    return next((size for size in (8, 12, 16, 24, 32, 44, 60, 84) if size >= max(needed, least)), 120)


class Supplies:
    """Vertex arrays and textures, by the things that they show."""

    def __init__(self, model: mujoco.MjModel, height: int = 720):
        self.model = model
        self._share = 1 if height > SMALL else 2
        self._shapes: dict[tuple[str, int], gl.Shape] = {}
        self._pictures: dict[object, int] = {}
        self.black = gl.texture(GL.GL_RGBA8, 1, 1)

    def shape(self, kind: str, index: int, pixels: float = 40.0, least: int = 16) -> gl.Shape:
        """A unit shape that is fine enough for a thing of this radius on screen, of at `least` so many sectors, or a mesh or height field of the model."""
        round_kinds = {"sphere": unit_shapes.sphere, "capsule": unit_shapes.capsule, "cylinder": unit_shapes.cylinder}
        if kind in round_kinds:
            index = sectors(pixels, least)
        key = (kind, index)
        if key not in self._shapes:
            if kind in round_kinds:
                made = round_kinds[kind](index)
            elif kind == "mesh":
                made = unit_shapes.mesh(self.model, index)
            elif kind == "hfield":
                made = unit_shapes.height_field(self.model, index)
            else:
                made = {"box": unit_shapes.box, "plane": unit_shapes.quad, "disc": unit_shapes.disc}[kind]()
            self._shapes[key] = gl.Shape(*made)
        return self._shapes[key]

    @staticmethod
    def paint_kind(finish: Finish, weave_mode: float) -> int:
        """The way in which the picture of a finish lies on a thing with the paint mode `weave_mode`."""
        if finish.texture < 0 and finish.look.paint is None:
            return NO_PAINT
        if finish.look.around:
            return AROUND
        return BY_COORDINATES if weave_mode >= 5.5 else SIDES

    def picture(self, finish: Finish, wide: bool) -> int:
        """The texture of a finish; `wide` ones are painted finer."""
        key = (finish.look if finish.texture < 0 else None, finish.texture, wide)
        if key not in self._pictures:
            entry = finish.look
            if finish.texture >= 0:
                pixels = model_pixels(self.model, finish.texture)
                if entry.around:
                    side = pixels.shape[1]
                    faces = pixels.reshape(-1, side, side, 4)
                    self._pictures[key] = gl.cube_picture(faces if len(faces) == 6 else np.repeat(faces[:1], 6, axis=0))
                else:
                    self._pictures[key] = gl.picture(pixels)
            elif entry.around:
                self._pictures[key] = gl.cube_picture(paint.cube(entry, CUBE_PIXELS))
            else:
                pixels = (GROUND_PIXELS if wide else PICTURE_PIXELS) // self._share
                self._pictures[key] = gl.picture(paint.tile(entry, pixels))
        return self._pictures[key]
