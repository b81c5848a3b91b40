"""What an observation holds: columns of the recording (`worldengine.recording.columns`), of the state that stands now.

time (1,) s; qpos (nq,) and qvel (nv,) in the engine's coordinates; act (na,); pos (B, 3) m, quat (B, 4) w x y z, linvel (B, 3)
m/s of the body origins and angvel (B, 3) rad/s of all bodies but the world, world frame; sensordata. Sensors of
accelerations and forces show the step before, as an instrument does: those of this state wait for the action. Columns
without numbers are left out.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from worldengine.recording.derive import velocity_at

if TYPE_CHECKING:
    import mujoco

COLUMNS = ("time", "qpos", "qvel", "act", "pos", "quat", "linvel", "angvel", "sensordata")
ENGINE = {"pos": "xpos", "quat": "xquat"}
"""Names of the engine's own arrays, which have a row for the world, too."""
NEEDED = ("time", "qpos", "qvel", "act", "xpos", "xquat", "cvel", "subtree_com", "sensordata")
"""The engine's arrays that `columns` reads."""


def columns(model: "mujoco.MjModel", data: Any) -> dict[str, np.ndarray]:
    """The columns of one simulation, or with a leading axis of N simulations where `data` is a batch; each array is new.

    Args:
        model: the world.
        data: has the arrays `NEEDED`, derived from the positions and velocities that stand.
    """
    root = model.body_rootid[1:]
    cvel, pos = np.asarray(data.cvel)[..., 1:, :], np.asarray(data.xpos)[..., 1:, :]
    centre = np.asarray(data.subtree_com)[..., root, :]
    found = {
        "time": np.asarray(data.time, float).reshape(*cvel.shape[:-2], 1),
        "pos": pos,
        "quat": np.asarray(data.xquat)[..., 1:, :],
        "linvel": velocity_at(pos, cvel, centre),
        "angvel": cvel[..., :3],
        **{name: np.asarray(getattr(data, name)) for name in ("qpos", "qvel", "act", "sensordata")},
    }
    return {name: np.array(found[name], float) for name in COLUMNS if found[name].size}


def flat(found: dict[str, np.ndarray], axes: int = 0) -> np.ndarray:
    """The columns in one row, in their order; `axes` leading axes stay."""
    return np.concatenate([values.reshape(*values.shape[:axes], -1) for values in found.values()], axis=-1)
