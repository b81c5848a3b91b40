"""A place of a medium's surface lies lower than its surroundings: a ball dents clay, a foot snow, a stirred liquid falls in the middle.

Measures how much deeper the upper side of a medium's points lies at the end of the window within `radius_m` of a place than around it,
less that at its start, m: the median of the lowest quarter of columns there, and the median of those between `radius_m` and `around_m` away. A
column is a cell as wide as the points lie apart, with its highest point. A medium is named by what shows it. Source: depth of an indentation below
the undisturbed surface, as ISO 14577 has it.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.own_laws import pressed_in
from ....measuring.measured import (
    Measured,
    Name,
    UnknowableError,
    Windowed,
    at_least,
    between,
    body_index,
    one_of,
    window,
)

CODE = "WE229"
EVENT = True
FINE, WIDER, LOWEST = 4.0, 1.6, 0.25
"""Columns across `radius_m` at most; so many times as wide as points lie apart; the share of the lowest that is the dent's bottom."""
Array = np.ndarray


class Given(Windowed):
    """Which medium, where, and how deep."""

    medium: Name = Field(description="what shows the points of the law: its `shown_by`")
    place: tuple[float, float] | None = Field(None, description="where, x and y, m")
    body: Name | None = Field(None, description="or below where this body is at the end of the window")
    radius_m: float = Field(gt=0, description="how far from there the dent reaches, at least, m")
    around_m: float = Field(gt=0, description="how far away its surroundings end, m")
    min_m: float = Field(gt=0, description="least depth, m")
    max_m: float | None = Field(None, gt=0, description="largest depth, m")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "place", "body")
        if not self.radius_m < self.around_m:
            raise ValueError("around_m is larger than radius_m")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The depth at both ends of the window."""
    rows, lay = window(trajectory, given.window_s), trajectory.media.of(given.medium)
    place = np.array(given.place or trajectory.pos[rows.stop - 1, body_index(trajectory, given.body or ""), :2])
    before, after = (_deep(lay.at(float(trajectory.t[row])), place, given) for row in (rows.start, rows.stop - 1))
    deep = after - before
    where = f"below {given.body}" if given.body else f"at ({place[0]:g}, {place[1]:g}) m"
    told = f"{given.medium} lies {1000 * deep:.2f} mm deeper {where} than around it, beyond what it did at first"
    if given.max_m is None:
        return at_least(deep, given.min_m, "m", told)
    return between(deep, given.min_m, given.max_m, "m", told)


def _deep(points: Array, place: Array, given: Given) -> float:
    """m: how much lower the surface of points (n, 3) is there than around."""
    from scipy.spatial import cKDTree

    away = np.linalg.norm(points[:, :2] - place, axis=1)
    near = points[away < given.around_m]
    if len(near) < 8:
        raise UnknowableError(
            f"{len(near)} points of {given.medium} are there", next_move="name a place in it, or a larger around_m"
        )
    some = near[:: -(-len(near) // 1000)]
    apart = float(np.median(cKDTree(near).query(some, k=2)[0][:, 1]))
    cell = max(WIDER * apart, given.radius_m / FINE)
    column = np.floor((near[:, :2] - place) / cell + 0.5).astype(int)
    side = int(np.abs(column).max()) + 1
    one = (column + side) @ (2 * side + 1, 1)
    top = np.full((2 * side + 1) ** 2, -np.inf)
    np.maximum.at(top, one, near[:, 2])
    filled = np.flatnonzero(np.isfinite(top))
    middles = np.column_stack([filled // (2 * side + 1), filled % (2 * side + 1)]) - side
    far = cell * np.linalg.norm(middles, axis=1)
    within, around = top[filled][far <= given.radius_m], top[filled][far > given.radius_m]
    if not len(within) or not len(around):
        raise UnknowableError(
            f"the points of {given.medium} lie {apart:.2g} m apart there", next_move="make radius_m or around_m larger"
        )
    lowest = np.sort(within)[: max(1, round(LOWEST * len(within)))]
    return float(np.median(around) - np.median(lowest))


_DENT = {"medium": "clay", "place": [0.0, 0.0], "radius_m": 0.015, "around_m": 0.06}
GOOD = (
    (pressed_in, {**_DENT, "min_m": 0.009}),
    (pressed_in, {**_DENT, "min_m": 0.005, "max_m": 0.011}),
    (pressed_in, {**(_DENT | {"place": None}), "body": "ball", "min_m": 0.009}),
    (lambda: pressed_in(hollow=0.02), {**_DENT, "min_m": 0.009}),
)
BAD = (
    (lambda: pressed_in(deep=0.0), {**_DENT, "min_m": 0.001}),
    (lambda: pressed_in(deep=0.0, hollow=0.02), {**_DENT, "min_m": 0.001}),
    (pressed_in, {**_DENT, "min_m": 0.012}),
    (pressed_in, {**_DENT, "min_m": 0.001, "max_m": 0.005}),
    (pressed_in, {**(_DENT | {"place": [0.05, 0.05]}), "around_m": 0.03, "min_m": 0.002}),
)
