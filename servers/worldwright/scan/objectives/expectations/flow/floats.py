"""A body floats: in the end it lies still in the surface, partly under it.

Measures the share of its volume under the surface, over the last `for_s`; with `submerged` that share must agree, which
by Archimedes is the ratio of the densities. Exact for spheres and for upright boxes and cylinders. Source: Archimedes'
principle.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import floating, sinking
from ....measuring.immersion import submerged
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_most, between, body_index, last_rows, window

CODE = "WE260"
EVENT = True
AFLOAT = 0.002
"""With less than this share under the surface a body is above it, with more than all but this share it is under it."""


class Given(OfBody):
    """The body, the surface, and the share under it."""

    surface_m: float = Field(description="height of the surface, m")
    submerged: float | None = Field(None, gt=0, lt=1, description="expected share of the volume under it")
    tolerance: Tolerance = Field(0.1, description="of the share, absolute")
    max_speed_m_s: float = Field(default=0.05, gt=0, description="what counts as lying still, m/s")
    for_s: float = Field(default=0.5, gt=0, description="the time at the end that is judged, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share under the surface."""
    body = body_index(trajectory, given.body)
    rows = last_rows(trajectory, window(trajectory, given.window_s), given.for_s)
    share = float(submerged(trajectory, body, rows, given.surface_m).mean())
    speed = float(trajectory.speed[rows, body].max())
    message = f"{given.body} lies with {share:.1%} of its volume under the surface, moving at {speed:.3f} m/s"
    low, high = AFLOAT, 1 - AFLOAT
    if given.submerged is not None:
        low, high = given.submerged - given.tolerance, given.submerged + given.tolerance
    return all_of(between(share, low, high, "1", message), at_most(speed, given.max_speed_m_s, "m/s", message))


GOOD = (
    (lambda: floating(0.6), {"body": "body", "surface_m": 1.0}),
    (lambda: floating(0.9), {"body": "body", "surface_m": 1.0, "submerged": 0.9, "tolerance": 0.01}),
)
BAD = (
    (lambda: floating(0.6), {"body": "body", "surface_m": 1.0, "submerged": 0.8}),
    (lambda: floating(0.6, seconds=1.0), {"body": "body", "surface_m": 1.0}),
    (sinking, {"body": "body", "surface_m": 1.0}),
)
