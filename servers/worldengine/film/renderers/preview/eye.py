"""A camera of the model as matrices: right-handed, z up in the world, depth reversed (1 near, 0 infinitely far)."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco


@dataclass(frozen=True)
class View:
    """Where the camera is, its axes as columns (right, up, back), and the tangents of half its field of view (x, y)."""

    eye: np.ndarray
    axes: np.ndarray
    tangents: tuple[float, float]
    near_m: float = 0.01

    @property
    def forward(self) -> np.ndarray:
        """(3,) unit viewing direction, world frame."""
        return -self.axes[:, 2]

    def matrix(self) -> np.ndarray:
        """(4, 4) from world to clip space."""
        rotation = np.eye(4)
        rotation[:3, :3] = self.axes.T
        rotation[:3, 3] = -self.axes.T @ self.eye
        lens = np.zeros((4, 4))
        lens[0, 0], lens[1, 1] = 1.0 / self.tangents[0], 1.0 / self.tangents[1]
        lens[2, 3], lens[3, 2] = self.near_m, -1.0
        return lens @ rotation

    def rotation(self) -> np.ndarray:
        """(4, 4) from world to view directions."""
        out = np.eye(4)
        out[:3, :3] = self.axes.T
        return out

    def rays(self) -> np.ndarray:
        """(4, 4) with the columns right and up, scaled by the lens, and forward."""
        out = np.zeros((4, 4))
        out[:3, 0] = self.axes[:, 0] * self.tangents[0]
        out[:3, 1] = self.axes[:, 1] * self.tangents[1]
        out[:3, 2] = self.forward
        return out


def of_camera(model: mujoco.MjModel, data: mujoco.MjData, camera: int, width: int, height: int) -> View:
    """The view of a camera of the model as `data` has posed it."""
    tangent = tan(radians(float(model.cam_fovy[camera])) / 2.0)
    return View(
        np.array(data.cam_xpos[camera], dtype=float),
        np.array(data.cam_xmat[camera], dtype=float).reshape(3, 3),
        (tangent * width / height, tangent),
    )
