"""Light of a lamp reaches a place, or is kept from it: a shadow that falls there, goes, and comes again.

Measures which share of the lamp is seen from the place, over time: of lines from the place to all of the lamp, those that no
body stands before. The lamp is a body (which does not shade itself), or a ball of `lamp_radius_m` at `lamp_at`; a far one is the
sun. The least, mean or largest over the window, or that at its end; with `min_times` or `max_times`, how many times the
place lies in shadow, where no more than `shadow_share` reaches it, and clearly more in between. Clear things count as opaque, meshes and
height fields as their boxes: what hangs on such a box is not answered. Scattered light is left out.
Source: geometrical optics, straight rays; a penumbra is where the share lies between.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.covered import passing, trembling
from ....measuring import blocking
from ....measuring.measured import Measured, Name, OfBodies, Point, all_of, between, body_index, one_of, window

CODE = "WE303"
EVENT = True


class Given(OfBodies):
    """Where, from which lamp, what may stand before it, in what range."""

    place: Point = Field(description="where the light arrives: a point of the world, m")
    lamp: Name | None = Field(None, description="the lamp, a body; or")
    lamp_at: Point | None = Field(None, description="the middle of the lamp: a point of the world, m")
    lamp_radius_m: float = Field(0.05, gt=0, description="of a lamp at a point, m")
    of: Literal["min", "mean", "max", "final"] = Field("min", description="which of its values over the window")
    min_share: float | None = Field(None, ge=0, le=1, description="least share of the light")
    max_share: float | None = Field(None, ge=0, le=1, description="largest share of the light")
    shadow_share: float = Field(0.5, ge=0, lt=1, description="up to this share it lies in shadow, for the times")
    min_times: int | None = Field(None, ge=1, description="least number of times in shadow")
    max_times: int | None = Field(None, ge=0, description="largest number of times in shadow")

    @model_validator(mode="after")
    def _whole(self) -> "Given":
        one_of(self, "lamp", "lamp_at")
        if self.lamp is not None and self.lamp in self.names:
            raise ValueError("a lamp does not stand before itself: leave it out of `bodies`")
        if (self.min_share, self.max_share, self.min_times, self.max_times) == (None,) * 4:
            raise ValueError("give min_share, max_share, min_times or max_times")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The share of the light that arrives."""
    rows = blocking.chosen(trajectory, window(trajectory, given.window_s), last=given.of == "final")
    if given.lamp is not None:
        lamp = body_index(trajectory, given.lamp)
        own = blocking.points_of(trajectory, lamp)
        points = own @ np.swapaxes(matrices(trajectory.quat[rows, lamp]), 1, 2) + trajectory.pos[rows, lamp][:, None]
    else:
        points = np.tile(blocking.ball(given.lamp_radius_m) + np.array(given.lamp_at), (len(rows), 1, 1))
    shading = given.indices(trajectory) if given.names else _all_but(trajectory, given.lamp)
    eyes = np.tile(np.array(given.place, dtype=float), (len(rows), 1))
    light, bare = (
        1.0 - blocking.blocked(trajectory, rows, eyes, points, shading, rough=rough) for rough in (True, False)
    )
    value = _of(given, light)
    where = f"the place {given.place}" + (f" past {', '.join(given.names)}" if given.names else "")
    conditions = []
    if given.min_share is not None or given.max_share is not None:
        blocking.sure(value, _of(given, bare), given.min_share, given.max_share)
        message = f"{value:.0%} of the light of {given.lamp or given.lamp_at} reaches {where} ({given.of})"
        conditions.append(between(value, given.min_share, given.max_share, "1", message))
    if given.min_times is not None or given.max_times is not None:
        count = blocking.times(1.0 - light, 1.0 - given.shadow_share)
        bare_count = blocking.times(1.0 - bare, 1.0 - given.shadow_share)
        blocking.sure(count, bare_count, given.min_times, given.max_times)
        message = f"{where} lies in shadow {count} times, with {given.shadow_share:.0%} of the light or less"
        conditions.append(between(count, given.min_times, given.max_times, "times", message))
    return all_of(*conditions)


def _of(given: Given, light: np.ndarray) -> float:
    return float({"min": light.min(), "mean": light.mean(), "max": light.max()}.get(given.of, light[-1]))


def _all_but(trajectory: Trajectory, lamp: str | None) -> list[int]:
    """Every body but the lamp whose shape is known."""
    half, shaped = trajectory.mechanics.half_extents, {row.get("body") for row in trajectory.meta.get("geoms") or ()}
    return [
        index
        for index, name in enumerate(trajectory.names)
        if name != lamp and (name in shaped or (half is not None and np.isfinite(half[index]).all()))
    ]


AT = {"place": [-2, 0, 1], "lamp": "lamp"}
GOOD = (
    (passing, {**AT, "max_share": 0.01, "min_times": 3, "max_times": 3}),
    (passing, {**AT, "body": "leaf", "of": "max", "min_share": 1.0}),
    (passing, {"place": [-2, 0, 1], "lamp_at": [2, 0, 1], "bodies": ["leaf"], "max_share": 0.01}),
    (lambda: passing(low=0.1), {**AT, "min_share": 0.3, "max_share": 0.7}),
)
BAD = (
    (passing, {**AT, "min_share": 0.1}),
    (passing, {**AT, "max_times": 2}),
    (lambda: passing(low=0.3), {**AT, "min_times": 1}),
    (trembling, {**AT, "min_times": 2}),
)
