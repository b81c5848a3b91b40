"""Pictures of a world while somebody steps it, as the house draws its films."""

import copy
from typing import TYPE_CHECKING

import numpy as np

from ..model.errors import NotFoundError
from .accepted_world import MOTION

if TYPE_CHECKING:
    import mujoco

    from .accepted_world import AcceptedWorld

STATE = ("qpos", "qvel", "act", "mocap_pos", "mocap_quat", "eq_active", "plastic")


class LivePictures:
    """Draws states of a world through one camera, which stands as in the accepted film.

    Raises:
        NotFoundError: the world has no such camera; the known ones are listed.
    """

    def __init__(self, world: "AcceptedWorld", camera: str | None = None) -> None:
        import mujoco

        from worldengine.film.drawn_frames import Frames
        from worldengine.film.graphics_library import choose_headless
        from worldkit import cameras
        from worldkit.naming import names

        choose_headless()
        self._model = copy.copy(world.model)
        known = names(self._model, "camera", self._model.ncam)
        if not known or camera not in (None, *known):
            raise NotFoundError(
                f"there is no camera {camera or ''}", next_move=f"name one of: {', '.join(known) or '(none)'}"
            )
        self.camera = camera or known[0]
        width, height = world.given.size
        poses: list[np.ndarray | None] = [None, None]
        if (motion := world.folder / MOTION).is_file():
            with np.load(motion, allow_pickle=False) as told:
                poses = [told["pos"], told["quat"]]
        cameras.aim(self._model, poses[0], orientations=poses[1], aspect=width / height)
        self._data = mujoco.MjData(self._model)
        self._frames = Frames(self._model, width, height)

    def draw(self, data: "mujoco.MjData") -> np.ndarray:
        """(height, width, 3) uint8 of a state of the same world; `data` is only read."""
        import mujoco

        from worldkit import cameras

        for name in STATE:
            getattr(self._data, name)[...] = getattr(data, name)
        mujoco.mj_fwdKinematics(self._model, self._data)
        cameras.track(self._model, self._data)
        return self._frames.image(self._data, self.camera, quality="video")

    def close(self) -> None:
        """Free the renderer."""
        self._frames.close()
