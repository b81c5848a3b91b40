"""The plain renderer: MuJoCo's own, for drivers that cannot run our shaders. Hard shadows, no surroundings."""

from typing import TYPE_CHECKING

from . import Drawing, Quality

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..treatment import Treatment

PACKAGES = ("mujoco", "mujoco-core")


def take(model: "mujoco.MjModel", width: int, height: int) -> Drawing:
    """Prepare to draw a model; its offscreen buffer grows to the size of the pictures."""
    return Classic(model, width, height)


class Classic:
    """Draws with `mujoco.Renderer`, a still like a frame of a video."""

    def __init__(self, model: "mujoco.MjModel", width: int, height: int) -> None:
        import mujoco

        model.vis.global_.offwidth = max(int(model.vis.global_.offwidth), width)
        model.vis.global_.offheight = max(int(model.vis.global_.offheight), height)
        self._renderer = mujoco.Renderer(model, height, width)
        self._kind = int(mujoco.mjtObj.mjOBJ_GEOM)

    def image(self, data: "mujoco.MjData", camera: int, quality: Quality) -> "np.ndarray":
        """The picture: uint8 (height, width, 3)."""
        self._renderer.disable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        return self._renderer.render().copy()

    def segmentation(self, data: "mujoco.MjData", camera: int) -> "np.ndarray":
        """Geom number of each pixel, or -1: int32 (height, width)."""
        import numpy as np

        self._renderer.enable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        pairs = self._renderer.render()
        return np.where(pairs[..., 1] == self._kind, pairs[..., 0], -1).astype(np.int32)

    def treat(self, treatment: "Treatment") -> bool:
        """Refuse the treatment: the model's own lights are all that it knows."""
        return False

    def shared(self) -> bytes:
        """Nothing: each camera's picture is its own."""
        return b""

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()
