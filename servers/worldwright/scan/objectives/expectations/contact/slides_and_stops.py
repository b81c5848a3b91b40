"""A body slides over something and comes to a stop.

Measures the way from the start of the window until it stops, metres. Braked by friction alone on level ground, it stops
after d = v^2 / (2 mu g); with `friction` that is expected within `tolerance`. What rolls does not slide: half the
way at least must not be rolled off. Source: Coulomb friction; the work-energy theorem.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, rolling, sliding
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_least, at_most, body_index, close_to, window

CODE = "WE141"
EVENT = True
ROLLED = 0.5


class Given(OfBody):
    """The body, how far it slides, and the friction that brakes it."""

    min_m: float = Field(default=0.01, gt=0, description="least way, m")
    friction: float | None = Field(None, gt=0, description="sliding friction coefficient: expects v^2 / (2 mu g)")
    tolerance: Tolerance = Field(0.1, description="relative, of the way that friction predicts")
    max_speed_m_s: float = Field(default=0.02, gt=0, description="what counts as stopped, m/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the way to the stop."""
    rows = window(trajectory, given.window_s, 2)
    body = body_index(trajectory, given.body)
    t, path, speed = trajectory.t[rows], trajectory.pos[rows, body], trajectory.speed[rows, body]
    still = at_most(float(speed[-1]), given.max_speed_m_s, "m/s", f"{given.body} still moves at {speed[-1]:.3f} m/s")
    stop = int(np.flatnonzero(speed > given.max_speed_m_s)[-1]) + 1 if (speed > given.max_speed_m_s).any() else 0
    stop = min(stop, len(t) - 1)
    way = float(np.linalg.norm(np.diff(path[: stop + 1], axis=0), axis=1).sum())
    message = f"{given.body} slides {way:.3f} m from {speed[0]:.3f} m/s and stops at {t[stop]:.3f} s"
    conditions = [at_least(way, given.min_m, "m", message), still]
    if given.friction:
        g = float(np.linalg.norm(trajectory.gravity))
        predicted = float(speed[0]) ** 2 / (2 * given.friction * g) if g > 0 else np.inf
        conditions.insert(0, close_to(way, predicted, given.tolerance, "m", message))
    if trajectory.mechanics.half_extents is not None and way > 0:
        radius = float(trajectory.mechanics.half_extents[body].min())
        rolled = float((trajectory.spin[rows, body][: stop + 1] * np.gradient(t)[: stop + 1]).sum()) * radius / way
        conditions.append(at_most(rolled, ROLLED, "1", f"{given.body} rolls {rolled:.0%} of its way"))
    return all_of(*conditions)


GOOD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "min_m": 0.49}),
    (lambda: sliding(2.0, 0.3 * G), {"body": "body", "friction": 0.3, "tolerance": 0.01}),
)
BAD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "min_m": 0.51}),
    (lambda: sliding(1.0, 0.4), {"body": "body"}),
    (lambda: sliding(2.0, 0.3 * G), {"body": "body", "friction": 0.5}),
    (lambda: rolling(1.0), {"body": "ball"}),
)
