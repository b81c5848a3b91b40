"""A soft body, or a crowd, is so large: how wide a dough spreads, how high a foam stands, how far a cloth reaches.

Measures the extent of its parts along x, y, z, or across (the largest along any direction), metres: its least, mean or
largest over the window, or that at its end. Of a solid flex the surface counts, of a law its points, else the origins of the
bodies. Source: geometry.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd
from ....known.jellies import block
from ....known.own_laws import pouring
from ....measuring.channels import AXES, OfParts
from ....measuring.clouds import cloud
from ....measuring.measured import Measured, between, window

CODE = "WE228"
MOST_ROWS = 400


class Given(OfParts):
    """Which extent, in what range."""

    along: Literal["x", "y", "z", "across"] = Field("z", description="an axis of the world, or the largest extent")
    of: Literal["min", "mean", "max", "final"] = Field("final", description="which of its values over the window")
    min_m: float | None = Field(None, ge=0, description="least size, m")
    max_m: float | None = Field(None, gt=0, description="largest size, m")

    @model_validator(mode="after")
    def _ranged(self) -> "Given":
        if self.min_m is None and self.max_m is None:
            raise ValueError("give min_m, max_m or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Its size."""
    rows = window(trajectory, given.window_s)
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    if given.of == "final":
        chosen = chosen[-1:]
    points = cloud(trajectory, given.parts, chosen)
    if given.along == "across":
        sizes = np.array([_across(cloud) for cloud in points])
    else:
        sizes = np.ptp(points[:, :, AXES[given.along]], axis=1)
    value = float({"min": sizes.min(), "mean": sizes.mean(), "max": sizes.max()}.get(given.of, sizes[-1]))
    way = "across" if given.along == "across" else f"along {given.along}"
    return between(value, given.min_m, given.max_m, "m", f"{given.told()} measures {value:.4g} m {way} ({given.of})")


def _across(points: np.ndarray) -> float:
    """The largest distance between two points, by the extents along 200 directions (short by at most 1 %)."""
    k = np.arange(200)
    z, turn = (k + 0.5) / 200, k * np.pi * (3 - 5**0.5)  # a spiral over half a sphere
    flat = np.sqrt(1 - z**2)
    directions = np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)
    return float(np.ptp(points @ directions.T, axis=0).max())


GOOD = (
    (lambda: block(squeezed=0.5), {"parts": "jelly", "min_m": 0.099, "max_m": 0.101}),
    (lambda: block(grows=2.0), {"parts": "jelly", "of": "max", "min_m": 0.399}),
    (lambda: crowd(3.0), {"parts": "grain_*", "along": "across", "min_m": 0.83, "max_m": 0.85}),
    (pouring, {"parts": "paint", "along": "z", "of": "max", "min_m": 0.0022, "max_m": 0.0024}),
)
BAD = (
    (block, {"parts": "jelly", "max_m": 0.19}),
    (block, {"parts": "jelly", "of": "max", "min_m": 0.21}),
    (lambda: crowd(3.0), {"parts": "grain_*", "along": "across", "min_m": 0.9}),
)
