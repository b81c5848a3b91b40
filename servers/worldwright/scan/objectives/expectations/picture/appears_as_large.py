"""A body appears so large in the picture of a camera: a coin one can make out, a giant that fills the frame.

Measures the width, the height or the longer of both, pixels, of what it covers in the frame of a camera of the stills: the
least, mean or largest over the window, or that at its end. Its shapes are projected, so that what stands before it does not
matter; meshes count as their boxes. Source: the pinhole camera, h f / d with f = height / (2 tan(fovy / 2)).
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.pictured import approaching
from ....measuring.measured import Measured, Name, between, body_index, window
from ....measuring.through_cameras import OfCamera, outline

CODE = "WE300"
MOST_ROWS = 200


class Given(OfCamera):
    """Of what, and in what range."""

    body: Name = Field(description="the body")
    extent: Literal["width", "height", "longer"] = Field("longer", description="which of its extents in the picture")
    of: Literal["min", "mean", "max", "final"] = Field("min", description="which of its values over the window")
    min_px: float | None = Field(None, gt=0, description="least size, pixels")
    max_px: float | None = Field(None, gt=0, description="largest size, pixels")

    @model_validator(mode="after")
    def _ranged(self) -> "Given":
        if self.min_px is None and self.max_px is None:
            raise ValueError("give min_px, max_px or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Its size in the picture."""
    lens, body = given.lens(trajectory), body_index(trajectory, given.body)
    rows = window(trajectory, given.window_s)
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    if given.of == "final":
        chosen = chosen[-1:]
    own = outline(trajectory, body)
    followed = [trajectory.names.index(name) for name in lens.follows if name in trajectory.names]
    sizes = []
    for row in chosen:
        points = own @ matrices(trajectory.quat[row, body]).T + trajectory.pos[row, body]
        eye = lens.eye_at(trajectory.pos[row, followed].mean(axis=0)) if followed else lens.eye
        seen = np.clip(lens.pixels(points, eye), 0.0, lens.size)  # what is beyond the frame is not seen
        seen = seen[np.isfinite(seen).all(axis=1)]
        extents = np.ptp(seen, axis=0) if len(seen) else np.zeros(2)
        extents = extents if extents.min() > 0 else np.zeros(2)  # all of it is beyond one side
        sizes.append({"width": extents[0], "height": extents[1]}.get(given.extent, extents.max()))
    found = np.array(sizes)
    value = float({"min": found.min(), "mean": found.mean(), "max": found.max()}.get(given.of, found[-1]))
    message = f"{given.body} is {value:.1f} pixels large ({given.extent}, {given.of}) in {given.camera}"
    return between(value, given.min_px, given.max_px, "px", message)


AT = {"camera": "camera", "body": "body"}
GOOD = (
    # 0.2 m at 1.9 m with f = 300: 31.6 pixels; at 0.9 m: 66.7.
    (approaching, {**AT, "of": "min", "min_px": 31.5, "max_px": 31.7}),
    (approaching, {**AT, "of": "max", "extent": "width", "min_px": 66.6, "max_px": 66.8}),
)
BAD = (
    (approaching, {**AT, "of": "min", "min_px": 40}),
    (approaching, {**AT, "of": "max", "max_px": 60}),
)
