"""A body that was wholly under the surface comes up.

Measures how far its highest point gets above the surface after it was under it, metres.
Source: Archimedes' principle: what is less dense than the medium rises.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import sinking
from ....measuring.immersion import extent
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE262"
EVENT = True


class Given(OfBody):
    """The body, and the surface that it comes through."""

    surface_m: float = Field(description="height of the surface, m")
    min_m: float = Field(default=0.001, gt=0, description="least height of its highest point above the surface, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the height above the surface."""
    rows = window(trajectory, given.window_s, 2)
    _, top = extent(trajectory, body_index(trajectory, given.body), rows)
    above = top - given.surface_m
    if not (above < 0).any():
        return at_least(-float(above.min()), given.min_m, "m", f"{given.body} is never wholly under the surface")
    after = above[int(np.argmax(above < 0)) :]
    most = float(after.max())
    return at_least(most, given.min_m, "m", f"{given.body} comes up to {most:.4f} m above the surface")


GOOD = ((lambda: sinking(-0.2, surface=0.5), {"body": "body", "surface_m": 0.9, "min_m": 0.2}),)
BAD = (
    (lambda: sinking(-0.2, surface=0.5), {"body": "body", "surface_m": 1.3}),
    (sinking, {"body": "body", "surface_m": 1.0}),
    (lambda: sinking(-0.2, surface=0.5), {"body": "body", "surface_m": 0.4}),
)
