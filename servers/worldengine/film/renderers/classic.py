"""The plain renderer: MuJoCo's own, for drivers that cannot run our shaders. Hard shadows, no surroundings."""

from typing import TYPE_CHECKING

from . import Drawing, Quality
from .preview.finish import of_material
from .preview.soft_shapes import FLEX, geom_of

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..treatment import Treatment

UNSEEN_GROUP = 5
"""No picture shows this group of geoms."""
CLEAR = 0.6
"""What is more transparent than this by its colour alone is looked through."""
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
        self._model, self._clear = model, _clear(model)
        self._renderer = mujoco.Renderer(model, height, width)
        kinds = mujoco.mjtObj
        self._kinds = tuple(map(int, (kinds.mjOBJ_GEOM, kinds.mjOBJ_SKIN, kinds.mjOBJ_FLEX)))
        first = model.skin_bonebodyid[model.skin_boneadr] if model.nskin else ()
        self._skinned = [geom_of(model, int(body)) for body in first]

    def image(self, data: "mujoco.MjData", camera: int, quality: Quality) -> "np.ndarray":
        """The picture: uint8 (height, width, 3)."""
        self._renderer.disable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        return self._renderer.render().copy()

    def segmentation(self, data: "mujoco.MjData", camera: int) -> "np.ndarray":
        """Geom number of each pixel, -1 for none, flexes from -2 down: int32 (height, width); of a skin one of the first body that
        it follows.
        """
        import numpy as np

        self._renderer.enable_segmentation_rendering()
        self._renderer.update_scene(data, camera)
        pairs = self._renderer.render()
        number, kind = pairs[..., 0], pairs[..., 1]
        found = np.where(kind == self._kinds[0], number, -1)
        for skin, geom in enumerate(self._skinned):
            found[(kind == self._kinds[1]) & (number == skin)] = geom
        found[kind == self._kinds[2]] = FLEX - number[kind == self._kinds[2]]
        return found.astype(np.int32)

    def seen_through(self, data: "mujoco.MjData", camera: int) -> "np.ndarray | None":
        """As `segmentation`, without all that is see-through; None where nothing is."""
        geoms, flexes = self._clear
        if not (geoms.any() or flexes.any()):
            return None
        model = self._model
        before = model.geom_group.copy(), model.flex_group.copy()
        model.geom_group[geoms], model.flex_group[flexes] = UNSEEN_GROUP, UNSEEN_GROUP
        try:
            return self.segmentation(data, camera)
        finally:
            model.geom_group[:], model.flex_group[:] = before

    def treat(self, treatment: "Treatment") -> bool:
        """Refuse the treatment: the model's own lights are all that it knows."""
        return False

    def shared(self) -> bytes:
        """Nothing: each camera's picture is its own."""
        return b""

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()


def _clear(model: "mujoco.MjModel") -> "tuple[np.ndarray, np.ndarray]":
    """Which geoms and which flexes are see-through."""
    import numpy as np

    looks = [of_material(model, number).look for number in range(model.nmat)]
    by_look = np.array([*(look.clear > 0 or look.rgba[3] < CLEAR for look in looks), False])
    geoms = by_look[model.geom_matid] | ((model.geom_matid < 0) & (model.geom_rgba[:, 3] < CLEAR))
    return geoms, by_look[model.flex_matid[model.flex_elemadr]] if model.nflex else np.zeros(0, bool)
