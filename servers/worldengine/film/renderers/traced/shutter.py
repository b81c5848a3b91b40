"""How a picture is exposed: its samples, shared out among the moments of an open shutter, and the lens in front of it."""

from __future__ import annotations

from math import atan, degrees
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...treatment import Treatment
from ..preview.eye import View
from ..preview.focus import FRAME_M

if TYPE_CHECKING:
    from .. import Quality

SAMPLES: dict[str, float] = {"still": 32, "video": 3}
DRAFT_GUIDE_SAMPLES, GUIDE_SAMPLES, FINE_GUIDE_SAMPLES = 2, 4, 16
FINE, FINEST = 18, 54
"""From so many samples a pixel on the denoiser is guided better and takes its time; and from so many, no light is cut off."""
AFFORDED = 0.1
"""What is traced over a plate may take this share of what the whole picture would, so that little is traced with more samples."""
DRAFT_SIDE = 2
"""Of a draft, light is traced for every second pixel of every second row."""


class Shutter(NamedTuple):
    """What a picture takes."""

    moments: int
    samples: float
    """A pixel, all moments together; less than one is a draft."""
    each: int
    """Samples a pixel of the traced light of one moment, which is `coarser` times smaller each way."""
    coarser: int
    guides: int
    """Samples a pixel of one moment for what guides the denoiser."""

    @classmethod
    def of(cls, quality: Quality, moments: int) -> Shutter:
        """Share out the samples of a picture among so many moments."""
        samples = SAMPLES[quality] if isinstance(quality, str) else quality
        coarser = DRAFT_SIDE if samples < 1 else 1
        fewest = DRAFT_GUIDE_SAMPLES if samples < 1 else GUIDE_SAMPLES
        guides = -(-(FINE_GUIDE_SAMPLES if samples >= FINE else fewest) // moments)
        return cls(moments, samples, max(1, round(samples * coarser**2 / moments)), coarser, guides)

    def finer(self, share: float, most: float) -> Shutter:
        """The same for so small a share of the picture: as many times the samples as it affords, and `most` a pixel."""
        times = int(max(1.0, min(most / self.samples, AFFORDED / max(share, 1e-6))))
        return Shutter.of(times * self.samples, self.moments)

    @property
    def fine(self) -> bool:
        """Whether the denoiser takes its time."""
        return self.samples >= FINE


class Lens(NamedTuple):
    """What is in front of the film: half the width of its opening, none of a pinhole, and how far away it is sharp, m."""

    radius_m: float = 0.0
    focus_m: float = 1.0

    @classmethod
    def of(cls, view: View, told: Treatment) -> Lens:
        """That of a full-frame camera with this view, at the film's f-number."""
        if told.aperture <= 0:
            return PINHOLE
        return cls(FRAME_M / (2.0 * view.tangents[1]) / told.aperture / 2.0, max(told.focus_m, 0.02))

    def spread(self, away: np.ndarray) -> np.ndarray:
        """Around where they are seen points so far ahead (N,), m, are spread by these tangents (N,) of angles."""
        return np.asarray(self.radius_m * np.abs(1.0 / self.focus_m - 1.0 / away))


PINHOLE = Lens()


def sensor(view: View, told: Treatment, width: int, height: int, channels: str) -> Any:
    """Mitsuba's camera for a view and a picture of `width` x `height` pixels; one with a lens where the film focuses."""
    import mitsuba as mi

    tangent = view.tangents[1]
    place = (view.eye - view.axes[:, 2]).tolist()
    move = mi.ScalarTransform4f().look_at(origin=view.eye.tolist(), target=place, up=view.axes[:, 1].tolist())
    film = {
        "type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
        "pixel_format": channels, "component_format": "float32",
    }  # fmt: skip
    lens, kind = Lens.of(view, told), dict[str, Any](type="perspective")
    if lens.radius_m > 0:
        kind = {"type": "thinlens", "aperture_radius": lens.radius_m, "focus_distance": lens.focus_m}
    return mi.load_dict(
        {**kind, "fov": 2 * degrees(atan(tangent)), "fov_axis": "y", "near_clip": 0.01, "far_clip": 1e5,
         "to_world": move, "film": film}
    )  # fmt: skip
