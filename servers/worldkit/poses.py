"""Where the bodies of a spec stand in the world."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np


def world_pose(body: "mujoco.MjsBody") -> "tuple[np.ndarray, np.ndarray]":
    """World position (3,) and rotation matrix (3, 3) of a body of a spec, from the poses of its ancestors."""
    import mujoco
    import numpy as np

    position, rotation = np.zeros(3), np.eye(3)
    chain = []
    node = body
    while node is not None and node.name != "world":
        chain.append(node)
        node = node.parent
    for link in reversed(chain):
        position = position + rotation @ np.asarray(link.pos, dtype=float)
        local = np.zeros(9)
        mujoco.mju_quat2Mat(
            local, np.asarray(link.quat, dtype=float)
        )  # as the engine reads one that is not of unit length
        rotation = rotation @ local.reshape(3, 3)
    return position, rotation
