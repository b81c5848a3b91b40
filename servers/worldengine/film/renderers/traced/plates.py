"""What a camera that stands still has seen already, so that of the next picture only what differs from it is traced.

With equal chances equal paths bring equal light: where a coarse look at two moments is the same, nothing moved there,
and no shadow, glow or mirror image of it, and the light traced of the one is that of the other to the last sample. What is
too small for a coarse look is found by its outline: a thing is drawn anew where it was and where it is, however small, and
so are its shadow on the ground and its image in it. Out of focus an outline is wider by what a point becomes there: from no
place further beside it does any way through the lens meet the thing, or pass where it stood.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from worldkit.settings import Setting

from ...film_curve import gains
from ...treatment import Treatment
from ..preview.eye import View
from .shutter import PINHOLE, Lens
from .walked import Rays

if TYPE_CHECKING:
    from .figures import Figures
    from .strand_meshes import Strands

SIDE, SAMPLES = 4, 4
"""Of a coarse look one pixel stands for so many each way, and takes so many samples."""
SEEN = ((2.5, 1.5 / 255.0), (1.0, 7.0 / 255.0), (0.0, 30.0 / 255.0))
"""Spread over so many coarse pixels a difference counts from this share of white on. Whatever a path met that has moved is brighter
here and darker there by chance, wherever a mover is near: that is gone where a difference is spread with its sign."""
GROWN = 2
"""A difference reaches so many coarse pixels further."""
SMALL = 10
"""The shadow or image of a thing of more coarse pixels is found by its light."""
UNSEEN = 0.01
"""A thing that moved by so many coarse pixels stands where it stood."""
ROUND = np.array([(np.cos(turn), np.sin(turn)) for turn in np.arange(12) * np.pi / 6]) / np.cos(np.pi / 12)
"""Corners around a circle of radius 1."""
MOST = 0.6
"""Where more than this share of a picture differs, it is traced as a whole, which costs no more then."""
MOST_MOVED = 300
"""Where more geoms moved, as of a heap of grains, a picture is traced as a whole: their outlines take too long."""
ROOM_BYTES = 1 << 30
"""Memory for plates and for what is looked at coarsely."""
TIMES, FINER = 3, 18
"""A plate takes so many times the samples of its pictures, up to so many a pixel: it is traced once, and stands in all of them."""
PIXEL_BYTES = 64
"""Of a plate, for each pixel: light, colours, normals, places, the share of things, and the light without noise."""


class Look(NamedTuple):
    """How light becomes a picture, as far as it makes differences plainer, and where shadows and images lie."""

    exposure: np.ndarray
    """By which red, green and blue light is multiplied, (3,)."""
    contrast: float
    """By how much the developed picture is steeper."""
    floor_z: float
    """Height of the ground, m."""
    key: np.ndarray
    """Unit vector toward the light, (3,)."""
    lens: Lens = PINHOLE

    @classmethod
    def of(cls, setting: Setting, told: Treatment, floor_z: float, view: View) -> Look:
        """That of a setting, as the film grades it and this view focuses."""
        brighter = setting.exposure * 2.0**told.grade_exposure_stops
        exposure = brighter * gains(told.grade_temperature, told.grade_tint)
        contrast = max(told.grade_contrast, 1.0) * max(told.grade_saturation, 1.0)
        return cls(exposure.astype(np.float32), contrast, floor_z, np.array(setting.key.direction), Lens.of(view, told))


class Sight(NamedTuple):
    """One moment, looked at coarsely: its light (h, w, 3), and where everything was."""

    light: np.ndarray
    poses: tuple[np.ndarray, ...]
    soft: dict[Any, np.ndarray]


class Plate(NamedTuple):
    """A picture that was traced as a whole, and what it depends on."""

    key: Hashable
    """Of camera, walls and light; None of a camera that moved while its shutter was open."""
    sights: tuple[Sight, ...]
    """Of each moment while its shutter was open."""
    rays: Rays
    clean: np.ndarray
    """Its light without noise (H, W, 3)."""


def fitting(pixels: int, sight: int, moments: int) -> int:
    """How many plates of so many pixels and moments have room beside those of a picture; `sight` is the size of a moment's."""
    return max(0, ROOM_BYTES - moments * sight) // (PIXEL_BYTES * pixels + moments * sight)


def samples(each: float) -> float:
    """Samples a pixel of a plate, by those of the pictures that are drawn over it."""
    return max(each, min(TIMES * each, FINER))


class Shelf:
    """The plates of the shot that is drawn, by name."""

    def __init__(self) -> None:
        self._plates: dict[Hashable, Plate] = {}

    def keep(self, names: Collection[Hashable]) -> None:
        """Give up all others: films are drawn shot by shot."""
        self._plates = {name: plate for name, plate in self._plates.items() if name in names}

    def find(self, name: Hashable) -> Plate | None:
        """The plate of this name, if it is there."""
        return self._plates.get(name)

    def put(self, name: Hashable, plate: Plate) -> Plate:
        """Take it up."""
        self._plates[name] = plate
        return plate


class Kept(NamedTuple):
    """What plates tell of a picture: its rays but for those where the mask `left` (h, w) has it; and of the first plate the light
    without noise (H, W, 3), which is that of the picture but where the mask `other` (h, w) has it."""

    left: np.ndarray
    rays: Rays
    other: np.ndarray
    clean: np.ndarray


def kept(
    now: Sequence[Sight], known: Sequence[Plate], figures: Figures, strands: Strands, view: View, look: Look
) -> Kept | None:
    """What of these moments is as in some plates of the same camera and light; None where that is too little to be worth it.

    Args:
        now: the moments of the picture.
        known: the plates; the first goes before the others.
        figures, strands: of the model.
        view: of the camera.
        look: how the picture is developed.
    """
    found: Kept | None = None
    for plate in known:
        differs = changed(now, plate, figures, strands, view, look)
        if not differs.any():
            return Kept(differs, plate.rays, differs, plate.clean)
        if found is None:
            found = Kept(differs, plate.rays, differs, plate.clean)
        else:
            rays = plate.rays.over(found.rays, found.left)
            found = found._replace(left=found.left & differs, rays=rays)
    return found if found is not None and found.left.mean() <= MOST else None


def changed(
    now: Sequence[Sight], plate: Plate, figures: Figures, strands: Strands, view: View, look: Look
) -> np.ndarray:
    """The mask (h, w) of what has to be traced of these moments, since it is not as in the plate at all times."""
    first, *rest = plate.sights
    mask = np.zeros(first.light.shape[:2], np.uint8)
    for sight in (*now, *rest):
        mask |= differing(first.light, sight.light, look)
        for thing in chain(figures.moved(first.poses, sight.poses), strands.moved(first.soft, sight.soft)):
            outline(mask, [thing], view, lens=look.lens)
            outline(mask, echoes(thing, look), view, SMALL, look.lens)
            if mask.mean() > MOST:  # the picture is not worth a closer look
                return np.ones(mask.shape, bool)
    import cv2

    return cv2.dilate(mask, np.ones((2 * GROWN + 1,) * 2, np.uint8)).astype(bool)


def differing(before: np.ndarray, now: np.ndarray, look: Look) -> np.ndarray:
    """Where two coarse pictures of scene light (h, w, 3) would look different: uint8 (h, w)."""
    import cv2

    def shown(light: np.ndarray) -> np.ndarray:
        bright = np.maximum(light, 0.0) * look.exposure
        return np.sqrt(bright / (1.0 + bright))

    apart = np.float32(look.contrast) * (shown(now) - shown(before))
    found = np.zeros(apart.shape[:2], bool)
    for spread, least in SEEN:
        found |= np.abs(cv2.GaussianBlur(apart, (0, 0), spread) if spread else apart).max(axis=-1) > least
    return found.astype(np.uint8)


def echoes(thing: tuple[np.ndarray, np.ndarray], look: Look) -> Iterator[tuple[np.ndarray, ...]]:
    """The image of a thing in the ground, and its shadow there, at both moments, as points (N, 3), m."""
    yield tuple(points * (1, 1, -1) + (0, 0, 2 * look.floor_z) for points in thing)
    if look.key[2] > 0:
        yield tuple(points - np.maximum(points[:, 2:] - look.floor_z, 0.0) / look.key[2] * look.key for points in thing)


def outline(
    mask: np.ndarray, things: Iterable[tuple[np.ndarray, ...]], view: View, most: float = np.inf, lens: Lens = PINHOLE
) -> None:
    """Mark in a mask (h, w) the convex outlines of things at two moments, of which the points (N, 3), m, are given.

    What moved by less than can be seen is left out, and so is what is wider or higher than `most` places of the mask, were it
    sharp; all of the mask is marked where a thing of any size reaches behind the camera. Through a lens an outline is as much
    wider as the thing's least sharp point is.
    """
    import cv2

    size = np.array(mask.shape[::-1])
    for thing in things:
        flat, spread = [], []
        for points in thing:
            own = (points - view.eye) @ view.axes
            away = -own[:, 2:]
            if not len(own) or away.max() < view.near_m:
                continue
            if away.min() < view.near_m and most < np.inf:
                continue
            if away.min() < view.near_m:
                mask[...] = 1
                return
            place = (own[:, :2] / away / view.tangents * (1, -1) + 1.0) * 0.5 * size
            flat.append(np.clip(place, -4.0 * size, 5.0 * size).astype(np.float32))
            spread.append(lens.spread(away).max() / np.array(view.tangents) * 0.5 * size)
        if len(flat) == 2 and flat[0].shape == flat[1].shape and np.abs(flat[1] - flat[0]).max() <= UNSEEN:
            continue
        for place, wide in zip(flat, spread, strict=True):
            if np.ptp(place, axis=0).max() <= most:
                hull = cv2.convexHull(place)
                if wide.max() > UNSEEN:
                    hull = cv2.convexHull((hull + (ROUND * wide).astype(np.float32)).reshape(-1, 2))
                cv2.fillConvexPoly(mask, np.floor(hull).astype(np.int32), 1)
