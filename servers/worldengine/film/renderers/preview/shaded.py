"""Draw one model with our shaders, in an OpenGL context of its own."""

import os
import sys
from typing import TYPE_CHECKING, Any

from .. import Quality

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ...carrying import Surfaces
    from ...treatment import Treatment
    from .eye import View


MANY = 6
"""Whoever asks for so many samples a pixel gets a still."""


class Shaded:
    """The pipeline together with its OpenGL context."""

    def __init__(self, model: "mujoco.MjModel", width: int, height: int) -> None:
        self._size = (width, height)
        self._context = context(width, height)
        try:
            self._context.make_current()
            from .pipeline import Pipeline

            self._pipeline = Pipeline(model, width, height)
        except Exception:
            self._context.free()
            raise

    def image(self, data: "mujoco.MjData", camera: int, quality: Quality) -> "np.ndarray":
        """The picture, a still drawn larger and scaled down: uint8 (height, width, 3)."""
        import numpy as np

        self._context.make_current()
        if not isinstance(quality, str):
            quality = "still" if quality >= MANY else "video"
        picture = self._pipeline.image(data, camera, quality)
        if picture.shape[0] != self._size[1]:
            import cv2

            picture = cv2.resize(np.ascontiguousarray(picture), self._size, interpolation=cv2.INTER_AREA)
        return np.ascontiguousarray(picture)

    def segmentation(self, data: "mujoco.MjData", camera: int) -> "np.ndarray":
        """Geom number of each pixel, or -1: int32 (height, width)."""
        self._context.make_current()
        return self._pipeline.segmentation(data, camera)

    def seen_through(self, data: "mujoco.MjData", camera: int) -> "np.ndarray | None":
        """As `segmentation`, without all that is see-through; None where nothing is."""
        self._context.make_current()
        return self._pipeline.seen_through(data, camera)

    def surfaces(self, data: "mujoco.MjData", camera: int, coarser: int = 1) -> "Surfaces":
        """What each pixel shows and how far away, `coarser` times smaller each way."""
        self._context.make_current()
        return self._pipeline.surfaces(data, camera, coarser)

    def placed(self, data: "mujoco.MjData", camera: int) -> "tuple[np.ndarray, View]":
        """Where each thing of `surfaces` is (N, 3, 4), and the view, without drawing anything."""
        self._context.make_current()
        from .eye import of_camera

        painter = self._pipeline.painter
        painter.upload(data)
        return painter.poses(), of_camera(self._pipeline.model, data, camera, *self._size)

    def treat(self, treatment: "Treatment") -> bool:
        """Apply this light, haze, focus and grading from now on."""
        self._context.make_current()
        self._pipeline.treat(treatment)
        return True

    def shared(self) -> bytes:
        """How far the room reaches, which depends on where all cameras stand; empty where there is none."""
        room = self._pipeline.room_extent
        return b"" if room is None else b"".join(corner.tobytes() for corner in room)

    def close(self) -> None:
        """Free the graphics context with everything that was made on it."""
        self._context.free()


def context(width: int, height: int) -> Any:
    """An offscreen OpenGL context, by the back end that MUJOCO_GL names (EGL if it names none and there is no display)."""
    if "MUJOCO_GL" not in os.environ and sys.platform == "linux" and not os.environ.get("DISPLAY"):
        os.environ["MUJOCO_GL"] = "egl"
    from mujoco import gl_context

    return gl_context.GLContext(width, height)
