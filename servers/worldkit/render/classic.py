"""Pictures by MuJoCo's own renderer, for drivers that cannot run our shaders."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco


class Classic:
    """The same two questions answered by `mujoco.Renderer`: image and segmentation."""

    def __init__(self, model: mujoco.MjModel, width: int, height: int):
        import mujoco

        model.vis.global_.offwidth = max(int(model.vis.global_.offwidth), width)
        model.vis.global_.offheight = max(int(model.vis.global_.offheight), height)
        self._renderer = mujoco.Renderer(model, height, width)
        self._kind = int(mujoco.mjtObj.mjOBJ_GEOM)

    def image(self, data: mujoco.MjData, camera: int) -> np.ndarray:
        """The picture: uint8 (H, W, 3)."""
        self._renderer.disable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        return self._renderer.render().copy()

    def segmentation(self, data: mujoco.MjData, camera: int) -> np.ndarray:
        """Geom number of each pixel, or -1: int32 (H, W)."""
        self._renderer.enable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        pairs = self._renderer.render()
        return np.where(pairs[..., 1] == self._kind, pairs[..., 0], -1).astype(np.int32)

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()
