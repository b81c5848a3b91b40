"""The named views. World frame: z up, +x front, +y left; an azimuth says where the camera stands, from +x toward +y."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np


@dataclass(frozen=True)
class View:
    """A direction to look from, and what to fit into the frame."""

    description: str
    azimuth_deg: float
    elevation_deg: float
    margin: float = 0.10
    """Part of the frame's height and width left free on each side."""
    support: bool = True
    """Show what the subjects stand on, too, where that does not make them small."""
    whole_scene: bool = False
    """Fit all fixed things, not only the subjects."""
    broadside: bool = False
    """Turn toward the side of a long, narrow movement, so that it is not seen end on."""
    wall: bool = False
    """Stand just inside the scene's own boundary on that side, and widen the lens instead of stepping back."""

    def backward(self, azimuth_deg: float = 0.0, elevation_deg: float = 0.0) -> np.ndarray:
        """Unit vector from the target to the camera, the view turned by the given angles (elevation within 3..90)."""
        azimuth = radians(self.azimuth_deg + azimuth_deg)
        elevation = radians(min(max(self.elevation_deg + elevation_deg, 3.0), 90.0))
        return np.array([cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)])


_SIDES = {"minus_x": (180.0, "-x"), "plus_x": (0.0, "+x"), "minus_y": (-90.0, "-y"), "plus_y": (90.0, "+y")}

VIEWS: dict[str, View] = {
    "perspective": View("Three-quarter view from the front right, above", -45.0, 24.0, broadside=True),
    "close_up": View(
        "Three-quarter view close to the subjects", -52.0, 16.0, margin=0.07, support=False, broadside=True
    ),
    "top_down": View("Straight down; +x to the right, +y up", -90.0, 90.0),
}
"""Camera templates (reference paper, table of relation templates), with `close_up`."""
for _side, (_azimuth, _label) in _SIDES.items():
    VIEWS[f"side_{_side}"] = View(f"From {_label}, a little above", _azimuth, 9.0)
    VIEWS[f"camera_side_{_side}"] = View(
        f"The whole scene from outside its {_label} side", _azimuth, 15.0, whole_scene=True
    )
    VIEWS[f"inside_{_side}_wall"] = View(
        f"From just inside the boundary on the {_label} side", _azimuth, 14.0, wall=True
    )


def axes(backward: np.ndarray) -> np.ndarray:
    """Camera axes as columns right, up, back; straight down has +x to the right and +y up."""
    up = np.array([0.0, 0.0, 1.0])
    right = np.cross(up, backward)
    length = float(np.linalg.norm(right))
    right = right / length if length > 1e-6 else np.array([1.0, 0.0, 0.0])
    return np.stack([right, np.cross(backward, right), backward], axis=1)
