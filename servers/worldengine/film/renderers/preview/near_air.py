"""Which things are so near that no air is seen before them: these are drawn without the haze, and the sky that it takes its colour from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .things import Things

CLEAR_M = 12.0
"""Nearer than this `surface.frag` shows no haze."""
SWAYS = 100.0
"""The kind of shape from which on a row sways in the breeze."""


class Reach:
    """How far things may be from an eye, at most.

    Args:
        things: of one model, whose rows come first of all.
    """

    def __init__(self, things: Things):
        import mujoco

        model, geoms = things.model, things.geoms
        self._box = model.geom_aabb[geoms].astype(float)
        self._reach = np.linalg.norm(self._box[:, 3:], axis=1)
        self._endless = (model.geom_type[geoms] == int(mujoco.mjtGeom.mjGEOM_PLANE)) | (self._reach <= 0)

    def hazed(self, rows: np.ndarray, balls: np.ndarray, eye: np.ndarray) -> np.ndarray:
        """(N,) bool: of which rows anything may be in the haze; of those between the things and the last ones, all.

        Args:
            rows: (N, 40) as the shader has them.
            balls: (M, 4) middle and radius, m, of balls around the last M of them.
            eye: (3,) m.
        """
        count, found = len(self._box), np.ones(len(rows), bool)
        own = rows[:count]
        frames = own[:, :12].reshape(-1, 3, 4).astype(float)
        middles = frames[:, :, 3] + np.einsum("nij,nj->ni", frames[:, :, :3], self._box[:, :3])
        # What a film draws in a size of each moment is as large as its row says, whatever box the compiler found.
        sized = np.abs(own[:, 12:16].astype(float)).sum(axis=1)
        farthest = np.linalg.norm(middles - eye, axis=1) + self._reach + sized
        found[:count] = (farthest > CLEAR_M) | self._endless | (own[:, 39] >= SWAYS)
        if len(balls):
            found[-len(balls) :] = ~(np.linalg.norm(balls[:, :3] - eye, axis=1) + balls[:, 3] < CLEAR_M)
        return found
