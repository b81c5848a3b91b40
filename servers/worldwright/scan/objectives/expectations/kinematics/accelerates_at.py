"""A body speeds up (or slows down) at a constant rate.

Fits x(t) = a + b t + c t^2 to its path and measures the acceleration 2 c along the direction in which it goes, m/s^2:
negative when it is braked. Sliding down an incline without friction gives g sin(angle), with friction
g (sin(angle) - mu cos(angle)); a ball rolling down, 5/7 g sin(angle); a braked slide, -mu g.
Source: Newton's second law; Galileo's inclined plane.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, sliding
from ....known.motions import downhill
from ....measuring.curves import polynomial
from ....measuring.measured import Measured, OfBody, Tolerance, body_index, close_to, window

CODE = "WE128"


class Given(OfBody):
    """The body, the acceleration to expect, and the tolerance."""

    m_s2: float = Field(description="expected acceleration along its direction, m/s^2; negative: it is braked")
    tolerance: Tolerance = Field(description="relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the fitted acceleration along the way."""
    rows = window(trajectory, given.window_s, 5)
    path = trajectory.com[rows, body_index(trajectory, given.body)]
    way = path[-1] - path[0]
    length = float(np.linalg.norm(way))
    found, _ = polynomial(trajectory.t[rows], path, 2)
    along = float(2 * found[2] @ way / length) if length > 0 else 0.0
    return close_to(along, given.m_s2, given.tolerance, "m/s^2", f"{given.body} accelerates at {along:.4f} m/s^2")


GOOD = (
    (lambda: downhill(30.0), {"body": "body", "m_s2": G / 2, "tolerance": 0.001}),
    (lambda: downhill(30.0, rolls=True), {"body": "body", "m_s2": 5 / 7 * G / 2, "tolerance": 0.001}),
    (lambda: sliding(1.0, 0.4), {"body": "body", "m_s2": -0.4, "tolerance": 0.001}),
)
BAD = (
    (lambda: downhill(30.0, rolls=True), {"body": "body", "m_s2": G / 2, "tolerance": 0.1}),
    (lambda: sliding(1.0, 0.4), {"body": "body", "m_s2": 0.4, "tolerance": 0.1}),
)
