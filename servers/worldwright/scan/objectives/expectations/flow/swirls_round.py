"""A medium goes round about an upright axis: water in a vortex, a whirlpool over a drain, milk that winds into coffee.

Measures how fast its points go round, rad/s, mean over the window, and how many turns they pass: at each recorded instant the median, over the points that went
anywhere and lie between `least_m` and `most_m` from the axis, of the angle since the instant before; anticlockwise, as seen from above, counts
on, and back counts back. Points of a grid that stay where they are count for nothing. Points are recorded a hundred to twenty-five times a second: what
turns by half a turn from one to the next is not known. A medium is named by what shows it. Source: rotational kinematics.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.own_laws import whirling
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, all_of, at_least, between, window

CODE = "WE230"
EVENT = True
STILL_M = 2e-5
"""What went less far from one instant to the next is no motion."""
LATEST = 0.2
"""How fast is told of this last share of the window: it has to get going first."""


class Given(Windowed):
    """Which medium, about what, and how fast or how far."""

    medium: Name = Field(description="what shows the points of the law: its `shown_by`")
    about: tuple[float, float] = Field(description="where the axis is, x and y, m")
    least_m: float = Field(0.0, ge=0, description="points nearer to the axis count for nothing, m")
    most_m: float | None = Field(None, gt=0, description="nor those farther away, m")
    min_rad_s: float | None = Field(
        None, gt=0, description="least rate in the last fifth of the window, either way, rad/s"
    )
    max_rad_s: float | None = Field(None, gt=0, description="largest rate there, rad/s")
    min_turns: float | None = Field(None, gt=0, description="least turns over the window, either way")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.min_rad_s is None and self.min_turns is None:
            raise ValueError("say min_rad_s, or min_turns")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The rate and the turns."""
    rows, lay = window(trajectory, given.window_s, 2), trajectory.media.of(given.medium)
    first, last = float(trajectory.t[rows.start]), float(trajectory.t[rows.stop - 1])
    instants = np.asarray(lay.t)
    instants = instants[(instants >= first - 1e-9) & (instants <= last + 1e-9)]
    if len(instants) < 3:
        raise UnknowableError(f"{given.medium} is recorded {len(instants)} times then", next_move="widen the window")
    before, angles = lay.at(float(instants[0]))[:, :2] - given.about, []
    for time in instants[1:]:
        now = lay.at(float(time))[:, :2] - given.about
        far = np.linalg.norm(now, axis=1)
        counts = (np.linalg.norm(now - before, axis=1) > STILL_M) & (far > max(given.least_m, 1e-9))
        counts &= far <= (given.most_m or np.inf)
        cross = before[counts, 0] * now[counts, 1] - before[counts, 1] * now[counts, 0]
        turned = np.arctan2(cross, (before[counts] * now[counts]).sum(axis=1))
        angles.append(float(np.median(turned)) if len(turned) else 0.0)
        before = now
    late = instants[1:] > last - LATEST * (last - first)
    seconds = float(np.diff(instants)[late].sum())
    rate, turns = abs(float(np.sum(np.array(angles)[late]))) / seconds, abs(float(np.sum(angles))) / (2 * np.pi)
    told = f"{given.medium} goes round at {rate:.2f} rad/s in the end, and by {turns:.2f} turns in all"
    found = []
    if given.min_rad_s is not None:
        found.append(between(rate, given.min_rad_s, given.max_rad_s, "rad/s", told))
    if given.min_turns is not None:
        found.append(at_least(turns, given.min_turns, "1", told))
    return all_of(*found)


_ROUND = {"medium": "water", "about": [0.0, 0.0]}
GOOD = (
    (whirling, {**_ROUND, "min_rad_s": 9.9, "max_rad_s": 10.1}),
    (whirling, {**_ROUND, "min_turns": 3.1}),
    (lambda: whirling(rate=-10.0), {**_ROUND, "min_rad_s": 9.9, "min_turns": 3.1}),
    (whirling, {**_ROUND, "least_m": 0.02, "most_m": 0.04, "min_rad_s": 9.9}),
)
BAD = (
    (lambda: whirling(rate=0.0), {**_ROUND, "min_rad_s": 0.1}),
    (whirling, {**_ROUND, "min_rad_s": 10.5}),
    (whirling, {**_ROUND, "min_turns": 3.5}),
    (whirling, {**_ROUND, "min_rad_s": 5.0, "max_rad_s": 8.0}),
    (lambda: whirling(shakes=True), {**_ROUND, "min_turns": 0.3}),
)
