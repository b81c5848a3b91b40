"""The walls of a room: those that the camera sees are drawn, and those that the key light comes through are painted in.

A whole room would trap light and keep the key light out, so the others are left away.
"""

from __future__ import annotations

import numpy as np

from worldkit.settings import Setting

from ..preview import room
from ..preview.finish import linear
from . import daylight

Face = tuple[int, int]
"""An axis, and the side of the room on it: -1 or 1."""
MARGIN_M = 0.02
CORNER = 0.8
"""Light that comes to a wall which is painted in, as a share of what comes there without corners and furniture."""


class Walls:
    """The walls of one room."""

    def __init__(self, setting: Setting, low: np.ndarray, high: np.ndarray, eyes: np.ndarray, floor_z: float) -> None:
        self.low, self.high = room.extent(low, high, eyes)
        self.low[2] = floor_z
        self.panels: dict[Face, list[room.Panel]] = {}
        for panel in room.panels(self.low, self.high, floor_z, setting.key.azimuth_deg):
            self.panels.setdefault(self._face_of(np.array(panel.centre)), []).append(panel)
        middle = 0.5 * (low + high)
        self._passed = {face for face, _ in [self._leaves(middle, np.array(setting.key.direction))]}

    def _face_of(self, centre: np.ndarray) -> Face:
        away = np.concatenate([centre - self.low, self.high - centre])
        away[2] = np.inf  # none of the panels is the floor
        face = int(away.argmin())
        return face % 3, 1 if face >= 3 else -1

    def _exits(self, eye: np.ndarray, ways: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distance, axis and side at which rays (..., 3) leave the room."""
        with np.errstate(divide="ignore", invalid="ignore"):
            far = np.where(ways > 0, (self.high - eye) / ways, np.where(ways < 0, (self.low - eye) / ways, np.inf))
        axis = far.argmin(axis=-1)
        side = np.sign(np.take_along_axis(ways, axis[..., None], -1)[..., 0])
        return far.min(axis=-1), axis, side

    def _leaves(self, start: np.ndarray, way: np.ndarray) -> tuple[Face, float]:
        far, axis, side = self._exits(start, way[None])
        return (int(axis[0]), int(side[0])), float(far[0])

    def seen(self, eye: np.ndarray, ways: np.ndarray) -> tuple[frozenset[Face], frozenset[Face]]:
        """The faces that a camera at `eye` with viewing directions (N, 3) sees: those to draw, those to paint in."""
        if not ((eye > self.low - MARGIN_M) & (eye < self.high + MARGIN_M)).all():
            return frozenset(), frozenset()
        _, axis, side = self._exits(eye, ways)
        met = {(int(a), int(s)) for a, s in zip(axis.ravel(), side.ravel(), strict=True)} & set(self.panels)
        return frozenset(met - self._passed), frozenset(met & self._passed)

    def paint_in(
        self,
        light: np.ndarray,
        faces: frozenset[Face],
        eye: np.ndarray,
        ways: np.ndarray,
        reach: np.ndarray,
        around: np.ndarray,
    ) -> np.ndarray:
        """Scene light (H, W, 3) with walls where rays (H, W, 3) leave the room through `faces` before they meet a thing.

        `reach` (H, W) is the distance of the things, m, infinite where there is none; `around` the surroundings' light.
        """
        far, axis, side = self._exits(eye, ways)
        places = eye + far[..., None] * ways
        directions = daylight.directions(around.shape[1])
        weight = np.sin(np.arccos(np.clip(directions[..., 2], -1, 1)))
        out = light.copy()
        for face in faces:
            here = (axis == face[0]) & (side == face[1]) & (reach > far + MARGIN_M)
            inward = np.zeros(3)
            inward[face[0]] = -face[1]
            toward = np.maximum(directions @ inward, 0.0) * weight
            ambient = CORNER * np.einsum("hw,hwc->c", toward, around) / toward.sum()
            across = [k for k in range(3) if k != face[0]]
            for panel in self.panels[face]:
                inside = (np.abs(places - np.array(panel.centre))[..., across] <= np.array(panel.half)[across]).all(
                    axis=-1
                )
                shining = panel.look == "window_light"
                colour = linear(panel.rgba[:3]) * (4.5 if shining else ambient)
                out[here & inside] = colour
        return out
