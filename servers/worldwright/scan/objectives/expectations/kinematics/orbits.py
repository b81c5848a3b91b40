"""A body goes round another, again and again.

Measures the angle passed about the other body (about a fixed `center` when that is given) in the plane of the motion,
turns; with `period_s` also the mean time of a turn, and with `equal_areas` how much the areal velocity |r x v| / 2
varies. Source: Kepler's second law; T = 2 pi sqrt(a^3 / G M).
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....known.motions import circling, orbiting
from ....measuring.curves import winding
from ....measuring.measured import (
    Measured,
    Name,
    OfBody,
    Point,
    Tolerance,
    all_of,
    at_least,
    at_most,
    body_index,
    close_to,
    one_of,
    window,
)

CODE = "WE126"
EVENT = True


class Given(OfBody):
    """The body, what it goes round, how often, and in what time."""

    other: Name | None = Field(None, description="the body it goes round; or")
    center: Point | None = Field(None, description="the point [x, y, z] it goes round, m")
    min_turns: float = Field(default=1.0, gt=0, description="least number of turns")
    period_s: float | None = Field(None, gt=0, description="expected time of one turn, s")
    tolerance: Tolerance = Field(0.02, description="relative, of the period and of the areal velocity")
    equal_areas: bool = Field(default=False, description="whether it must sweep equal areas in equal times")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "other", "center")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of turns."""
    rows = window(trajectory, given.window_s, 3)
    body = body_index(trajectory, given.body)
    out, speed = trajectory.pos[rows, body], trajectory.linvel[rows, body]
    if given.other:
        other = body_index(trajectory, given.other)
        out, speed = out - trajectory.pos[rows, other], speed - trajectory.linvel[rows, other]
    else:
        out = out - np.array(given.center)
    area = np.cross(out, speed) / 2
    mean = area.mean(axis=0)
    size = float(np.linalg.norm(mean))
    normal = mean / size if size > 0 else np.array([0.0, 0.0, 1.0])
    angle, t = winding(out, normal), trajectory.t[rows]
    turns = float(np.maximum.accumulate(angle)[-1] / (2 * np.pi))
    about = given.other or "the centre"
    message = f"{given.body} goes {turns:.3f} times round {about}"
    conditions = [at_least(turns, given.min_turns, "turns", message)]
    if given.period_s and turns >= 1:
        whole = 2 * np.pi * np.floor(turns)
        row = int((np.maximum.accumulate(angle) >= whole).argmax())
        share = (whole - angle[row - 1]) / (angle[row] - angle[row - 1]) if row else 0.0
        period = float((t[row - 1] + share * (t[row] - t[row - 1]) - t[0]) / np.floor(turns))
        conditions.append(close_to(period, given.period_s, given.tolerance, "s", f"{message}, once in {period:.4f} s"))
    elif given.period_s:
        conditions.append(at_least(turns, 1.0, "turns", f"{message}: too little to tell its period"))
    if given.equal_areas:
        varies = float(np.abs(area @ normal / size - 1).max()) if size > 0 else 1.0
        conditions.append(at_most(varies, given.tolerance, "1", f"{message}; areal velocity varies by {varies:.2%}"))
    return all_of(*conditions)


GOOD = (
    (
        lambda: orbiting(eccentricity=0.3, turns=2.2),
        {"body": "body", "other": "sun", "min_turns": 2, "period_s": 2.0, "equal_areas": True, "tolerance": 0.001},
    ),
    (lambda: circling(1.0, 2.0, turns=3), {"body": "body", "center": [0, 0, 1], "min_turns": 2.99}),
)
BAD = (
    (lambda: orbiting(turns=2.2), {"body": "body", "other": "sun", "period_s": 2.5}),
    (lambda: orbiting(turns=0.8), {"body": "body", "other": "sun"}),
    (lambda: sliding(1.0), {"body": "body", "center": [1, 1, 0.05]}),
)
