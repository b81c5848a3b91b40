"""Pictures of a model: `Frames` draws them with soft shadows, contact shadows, surroundings and a film curve."""

from __future__ import annotations

import os
import sys
from types import TracebackType
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    import mujoco

__all__ = ["Frames"]


def _camera_index(model: mujoco.MjModel, camera: str | int) -> int:
    import mujoco

    if isinstance(camera, int) and 0 <= camera < model.ncam:
        return camera
    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, camera) if isinstance(camera, str) else -1
    if index < 0:
        names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_CAMERA, i) for i in range(model.ncam)]
        raise ValueError(
            f"no camera is called {camera!r}. Use one of: {', '.join(map(str, names)) or '(the model has none)'}."
        )
    return index


def _context(width: int, height: int):
    """An offscreen OpenGL context, by the back end that MUJOCO_GL names (EGL if it names none and there is no display)."""
    if "MUJOCO_GL" not in os.environ and sys.platform == "linux" and not os.environ.get("DISPLAY"):
        os.environ["MUJOCO_GL"] = "egl"
    from mujoco import gl_context

    return gl_context.GLContext(width, height)


class Frames:
    """Draws pictures of one model, `width` x `height` pixels; a context manager.

    `image` gives the good-looking picture, `segmentation` the geom behind each pixel. The same state, camera and quality
    always give the same picture. Where the driver cannot run our shaders, MuJoCo's own renderer takes over and
    `engine` says "classic" instead of "worldkit".
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int):
        if width < 8 or height < 8:
            raise ValueError(f"a picture needs at least 8 x 8 pixels, got {width} x {height}")
        self.model, self.width, self.height = model, width, height
        self.engine = "classic"
        self.reason = ""
        """Why the classic renderer is in use, when it is."""
        self._context = None
        self._pipeline = None
        self._classic = None
        if os.environ.get("WORLDKIT_RENDERER", "worldkit") != "classic":
            try:
                self._context = _context(width, height)
                self._context.make_current()
                from .pipeline import Pipeline

                self._pipeline = Pipeline(model, width, height)
                self.engine = "worldkit"
            except Exception as error:
                # Any driver may lack any feature in its own way; a plainer picture is better than none.
                self.reason = f"{type(error).__name__}: {error}"
                self._free_context()
        if self._pipeline is None:
            self._fall_back()

    def _fall_back(self) -> None:
        """Let MuJoCo's own renderer draw from now on."""
        from .classic import Classic

        self._pipeline = None
        self._free_context()
        self.engine = "classic"
        self._classic = Classic(self.model, self.width, self.height)

    def image(self, data: mujoco.MjData, camera: str | int, quality: Literal["still", "video"] = "video") -> np.ndarray:
        """The picture of `data` through a camera of the model: uint8 (height, width, 3), RGB, row 0 the top.

        `data` needs positions and cameras up to date (`mj_kinematics`, `mj_comPos`, `mj_camlight`, or `mj_forward`).
        Raises ValueError when there is no such camera, or quality.
        """
        if quality not in ("still", "video"):
            raise ValueError(f"quality is 'still' or 'video', not {quality!r}")
        index = _camera_index(self.model, camera)
        if self._classic is not None:
            return self._classic.image(data, index)
        if self._pipeline is None or self._context is None:
            raise RuntimeError("these Frames are closed; make new ones")
        self._context.make_current()
        try:
            picture = self._pipeline.image(data, index, quality)
        except RuntimeError as error:
            # Programs are compiled when first used, so a driver may give up only here.
            self.reason = f"{type(error).__name__}: {error}"
            self._fall_back()
            return self.image(data, index, quality)
        if picture.shape[0] != self.height:
            import cv2

            picture = cv2.resize(np.ascontiguousarray(picture), (self.width, self.height), interpolation=cv2.INTER_AREA)
        return np.ascontiguousarray(picture)

    def segmentation(self, data: mujoco.MjData, camera: str | int) -> np.ndarray:
        """Geom number behind each pixel, -1 where there is none: int32 (height, width), row 0 the top."""
        index = _camera_index(self.model, camera)
        if self._classic is not None:
            return self._classic.segmentation(data, index)
        if self._pipeline is None or self._context is None:
            raise RuntimeError("these Frames are closed; make new ones")
        self._context.make_current()
        return self._pipeline.segmentation(data, index)

    def _free_context(self) -> None:
        if self._context is not None:
            self._context.free()
            self._context = None

    def close(self) -> None:
        """Free the graphics context; may be called twice."""
        self._pipeline = None
        self._free_context()
        if self._classic is not None:
            self._classic.close()
            self._classic = None

    def __enter__(self) -> Frames:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
