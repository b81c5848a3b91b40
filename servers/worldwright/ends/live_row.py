"""The newest state of a live world as one row of a recording, so that whatever tells recordings tells it, too."""

from typing import TYPE_CHECKING, Any

import numpy as np

from .observations import columns

if TYPE_CHECKING:
    from .live_source import LiveSource


class LiveRow:
    """Has `names`, `meta`, `time` (1,) s, `pos` (1, B, 3) m, `quat` (1, B, 4), `linvel` and `angvel` (1, B, 3), `qpos`, `qvel`
    and `ctrl` (1, n) as a `Recording` of one row has them; `model` and `data` stand in the same state.
    """

    def __init__(self, source: "LiveSource") -> None:
        import copy

        import mujoco

        from worldengine.recording.describing import describe
        from worldkit.naming import names

        self.model: mujoco.MjModel = copy.copy(source.model)
        self.data = mujoco.MjData(self.model)
        self.names = names(self.model, "body", self.model.nbody)[1:]
        self.meta = describe(self.model, source.given.visual_only)
        self.stand(None)

    def stand(self, state: np.ndarray | None) -> None:
        """Take a state (`worldengine.clock.state_frames`); None: as the world is built."""
        import mujoco

        from worldengine.clock.state_frames import signature

        model, data = self.model, self.data
        if state is not None:
            mujoco.mj_setState(model, data, state, signature())
        mujoco.mj_fwdKinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        found: dict[str, Any] = columns(model, data)
        self.time = np.array([data.time])
        self.pos, self.quat, self.linvel, self.angvel = (
            found[name][None] for name in ("pos", "quat", "linvel", "angvel")
        )
        self.qpos, self.qvel, self.ctrl = (np.array(getattr(data, name))[None] for name in ("qpos", "qvel", "ctrl"))
