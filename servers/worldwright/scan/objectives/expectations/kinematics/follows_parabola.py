"""A body flies along a parabola, with the acceleration of gravity.

Fits x(t) = a + b t + c t^2 by least squares and measures the fitted acceleration 2 |c|, m/s^2, against g (the
recording's own, or `g_m_s2`); the largest residual must stay under 1 % of the extent of the path, and the acceleration
must point along gravity within `tolerance` radians. Without a window, its longest flight without contact is judged.
Source: Galileo's law of projectiles, x = x0 + v0 t + g t^2 / 2.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....anomalies.sign import spans
from ....known.analytic import sliding, swinging
from ....known.motions import thrown
from ....measuring.curves import polynomial
from ....measuring.measured import (
    Measured,
    OfBody,
    Tolerance,
    UnknowableError,
    all_of,
    at_most,
    body_index,
    close_to,
    window,
)

CODE = "WE124"
FIT = 0.01


class Given(OfBody):
    """The body, the gravity to expect, and the tolerance."""

    tolerance: Tolerance = Field(0.02, description="relative, of the fitted g")
    g_m_s2: float | None = Field(None, gt=0, description="expected g, m/s^2; without it the recording's gravity")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the fitted acceleration."""
    body = body_index(trajectory, given.body)
    rows = window(trajectory, given.window_s, 5)
    if given.window_s is None:
        rows = _flight(trajectory, body, rows)
    t, path = trajectory.t[rows], trajectory.com[rows, body]
    found, residual = polynomial(t, path, 2)
    fitted, extent = 2 * found[2], float(np.linalg.norm(np.ptp(path, axis=0)))
    size, gravity = float(np.linalg.norm(fitted)), trajectory.gravity
    expected = given.g_m_s2 or float(np.linalg.norm(gravity))
    down = gravity / np.linalg.norm(gravity) if np.any(gravity) else np.array([0.0, 0.0, -1.0])
    off = float(np.arccos(np.clip(fitted @ down / size, -1, 1))) if size > 0 else np.pi
    message = f"{given.body} from {t[0]:.3f} to {t[-1]:.3f} s: fitted g is {size:.4f} m/s^2"
    return all_of(
        close_to(size, expected, given.tolerance, "m/s^2", message),
        at_most(residual / extent if extent > 0 else 1.0, FIT, "1", f"{message}, but the path is no parabola"),
        at_most(off, given.tolerance, "rad", f"{message}, {np.degrees(off):.1f} degrees off the vertical"),
    )


def _flight(trajectory: Trajectory, body: int, rows: slice) -> slice:
    touching = trajectory.touching
    if touching is None:
        return rows
    flights = spans(~touching[rows, body])
    if not len(flights) or (longest := flights[(flights[:, 1] - flights[:, 0]).argmax()])[1] - longest[0] < 5:
        raise UnknowableError("it is never in the air for five rows", next_move="give the flight's `window_s`")
    return slice(rows.start + int(longest[0]), rows.start + int(longest[1]))


GOOD = ((lambda: thrown((2.0, 1.0, 3.0)), {"body": "body", "tolerance": 0.001}),)
BAD = (
    (lambda: thrown((2.0, 1.0, 3.0), g=1.62), {"body": "body", "g_m_s2": 9.81}),
    (lambda: sliding(1.0, 0.5), {"body": "body", "window_s": [0, 1.0]}),
    (lambda: swinging(amplitude_deg=60), {"body": "bob", "window_s": [0, 2.0]}),
)
