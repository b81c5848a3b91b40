"""What is around things in a picture, besides the light on them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from worldkit.settings import Setting

from ...treatment import Treatment
from ..preview.eye import View
from . import daylight
from .half_room import Face
from .walked import Rays, spread

GLIMPSES_BYTES = 1 << 30
"""Of the room that the moments of one picture may take: places, directions, what is seen and what lies behind, 44 bytes a pixel."""

FLAT = 0.01
"""What lies so near the plane of the key light's disk, of its radius, is the disk."""
SUN = 0.055
"""A key light of a larger tangent of its angular radius is no sun: cameras do not see it."""


class Outlook(NamedTuple):
    """Unit viewing directions (H, W, 3), and the radiance of the surroundings there, (H, W, 3)."""

    ways: np.ndarray
    sky: np.ndarray


class Glimpse(NamedTuple):
    """What is seen from one place besides the light on things: where they are, as in `Rays`, and what is around them."""

    view: View
    outlook: Outlook
    painted: frozenset[Face]
    """Walls that are painted in, since they stand between the eye and the room."""
    places: np.ndarray
    seen: np.ndarray

    def cleared(self, light: np.ndarray) -> np.ndarray:
        """Light (H, W, 3) with the very sky where nothing but it is seen, which the denoiser smears a little."""
        if self.seen.min() > 0:
            return light
        import cv2

        near = cv2.dilate((self.seen > 0).astype(np.uint8), np.ones((3, 3), np.uint8))
        return np.where(near[..., None] > 0, light, self.outlook.sky)


def glimpses_apart(count: int, pixels: int) -> int:
    """Of so many moments of a moving camera every how many-th is kept for what lies around things, so that they fit into memory."""
    return -(-count // max(1, GLIMPSES_BYTES // (44 * pixels)))


class Around:
    """The surroundings of a setting, as they light things and as cameras see them.

    Args:
        setting: with the light that the film asks for.
        told: what the film asks for.
        width, height: of the picture, pixels.
        key: the middle (3,) and the radius of the disk that the key light is, m.
    """

    def __init__(
        self, setting: Setting, told: Treatment, width: int, height: int, key: tuple[np.ndarray, float]
    ) -> None:
        self._size = width, height
        self._key_disk = key if setting.key_spread > SUN else None
        self._key_way = np.array(setting.key.direction, np.float32)
        self.shown = daylight.seen(setting, told)
        """Radiance (N, 2 N, 3) as it is seen."""
        self.lighting = daylight.lighting(setting, told, self.shown)
        """Radiance as it lights things."""
        self._otherwise = self.shown.shape != self.lighting.shape or not np.array_equal(self.shown, self.lighting)
        self._alone: Any = None
        self._key: object = None

    def outlook(self, view: View) -> Outlook:
        """What a view needs of the surroundings; that of the last one is kept, as most cameras stand still."""
        key = (view.eye.tobytes(), view.axes.tobytes(), view.tangents)
        if key != self._key:
            width, height = self._size
            x = ((np.arange(width) + 0.5) / width * 2 - 1) * view.tangents[0]
            y = (1 - (np.arange(height) + 0.5) / height * 2) * view.tangents[1]
            ways = x[None, :, None] * view.axes[:, 0] + y[:, None, None] * view.axes[:, 1] - view.axes[:, 2]
            ways = (ways / np.linalg.norm(ways, axis=-1, keepdims=True)).astype(np.float32)
            self._last, self._key = Outlook(ways, daylight.looked_up(self.shown, ways)), key
        return self._last

    def alone(self) -> Any:
        """A scene of nothing but the surroundings as they light things."""
        if self._alone is None:
            import mitsuba as mi

            self._alone = mi.load_dict({"type": "scene", "around": daylight.environment(self.lighting)})
        return self._alone

    def uncovered(
        self,
        rays: Rays,
        view: View,
        again: Callable[[], tuple[np.ndarray, np.ndarray]],
        where: np.ndarray | None = None,
    ) -> Rays:
        """Rays in which the surroundings are as they are seen, and have a colour by which the denoiser knows them.

        Args:
            rays: as they were traced, with the surroundings that light things.
            view: they are of.
            again: tells the share of things (h, w) and the light of the surroundings alone (h, w, 3) in the very samples of the
                light: by any others, edges of things and of lamps would keep dots of what is taken away behind them.
            where: (h, w) of the pixels that were traced, a mask of any size.
        """
        import cv2

        sky, (height, width) = self.outlook(view).sky, rays.light.shape[:2]
        rays, hidden = self._without_key(rays)
        traced = rays.seen if where is None else rays.seen[spread(where, *rays.seen.shape)]
        if traced.min(initial=1.0) >= 1.0:
            return rays
        albedo = rays.albedo + (1.0 - rays.seen)[..., None] * np.clip(sky, 0.0, 1.0)
        light = rays.light
        if len(sky) != height:
            sky, hidden = (cv2.resize(one, (width, height), interpolation=cv2.INTER_AREA) for one in (sky, hidden))
        if self._otherwise:
            covered, around = again()
            light = np.maximum(light + (1.0 - covered)[..., None] * (sky - around), 0.0)
        return rays._replace(light=np.where(hidden[..., None] > 0, sky, light), albedo=albedo)

    def _without_key(self, rays: Rays) -> tuple[Rays, np.ndarray]:
        """Rays that do not see the disk of a wide key light, which is no thing; and where it was seen, uint8 (H, W)."""
        import cv2

        hidden = np.zeros(rays.seen.shape, np.uint8)
        if self._key_disk is None:
            return rays, hidden
        middle, radius = self._key_disk
        apart = rays.places - middle
        near = (rays.seen > 0) & (np.linalg.norm(apart, axis=-1) < 1.01 * radius)
        # Far ground, too, may come as near the middle of the disk, but lies before or behind it.
        hidden[near & (np.abs(apart @ self._key_way) < FLAT * radius)] = 1
        if not hidden.any():
            return rays, hidden
        around = cv2.dilate(hidden, np.ones((3, 3), np.uint8)) & (rays.seen == 0)  # some samples of its edge
        seen = np.where(hidden > 0, np.float32(0), rays.seen)
        return rays._replace(seen=seen, albedo=np.where(seen[..., None] > 0, rays.albedo, 0)), hidden | around
