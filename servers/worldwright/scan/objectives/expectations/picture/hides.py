"""A thing hides another, as seen from a camera or a place: a branch before a lamp, a planet before its sun.

Measures which share of the hidden body the others stand before: of lines from the eye to places all through it. The least, mean
or largest over the window, or that at its end; with `min_times` or `max_times`, how many times the share comes to
`hidden_share` or more, and falls clearly below in between. Of a camera, which may follow and needs the stills, what its picture
shows counts. Clear things count as opaque, meshes and height fields as their boxes: what hangs on such a box is not answered.
Source: geometrical optics, straight lines of sight.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.covered import looking, passing, trembling
from ....measuring import blocking
from ....measuring.measured import (
    Measured,
    Name,
    OfBodies,
    Point,
    all_of,
    at_least,
    between,
    body_index,
    one_of,
    window,
)
from ....measuring.through_cameras import OfCamera

CODE = "WE302"
EVENT = True


class Given(OfBodies):
    """What hides, what is hidden, from where it is seen, in what range."""

    other: Name = Field(description="the body that is hidden")
    camera: Name | None = Field(None, description="seen from a camera of the plan; or")
    place: Point | None = Field(None, description="from a place of the world, m")
    of: Literal["min", "mean", "max", "final"] = Field("max", description="which of its values over the window")
    min_share: float | None = Field(None, gt=0, le=1, description="least hidden share")
    max_share: float | None = Field(None, ge=0, lt=1, description="largest hidden share")
    hidden_share: float = Field(0.5, gt=0, le=1, description="from this share on it counts as hidden, for the times")
    min_times: int | None = Field(None, ge=1, description="least number of times")
    max_times: int | None = Field(None, ge=0, description="largest number of times")

    @model_validator(mode="after")
    def _whole(self) -> "Given":
        one_of(self, "camera", "place")
        if not self.names or self.other in self.names:
            raise ValueError("name what hides (`body` or `bodies`), and another body as `other`")
        if (self.min_share, self.max_share, self.min_times, self.max_times) == (None,) * 4:
            raise ValueError("give min_share, max_share, min_times or max_times")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The hidden share."""
    last, hidden = given.of == "final", body_index(trajectory, given.other)
    rows = blocking.chosen(trajectory, window(trajectory, given.window_s), last=last)
    own = blocking.points_of(trajectory, hidden)
    points = own @ np.swapaxes(matrices(trajectory.quat[rows, hidden]), 1, 2) + trajectory.pos[rows, hidden][:, None]
    eyes = _eyes(trajectory, given, rows)
    shown = _shown(trajectory, given, eyes, points)
    at = np.flatnonzero(shown.any(axis=1))  # what is not in the picture is not hidden there by anything
    if not len(at) or (last and at[-1] != len(rows) - 1):
        message = (
            f"{', '.join(given.names)} hides nothing of {given.other}, which is not in the picture of {given.camera}"
        )
        return at_least(0.0, 1.0, "1", message + " at the end" * bool(len(at)))
    boxed, bare = (
        blocking.blocked(
            trajectory, rows[at], eyes[at], points[at], given.indices(trajectory), seen=shown[at], rough=rough
        )
        for rough in (True, False)
    )
    value, least_value = _of(given, boxed), _of(given, bare)
    seen = f"from {given.camera or given.place}"
    conditions = []
    if given.min_share is not None or given.max_share is not None:
        blocking.sure(value, least_value, given.min_share, given.max_share)
        message = f"{', '.join(given.names)} hides {value:.0%} of {given.other} ({given.of}) {seen}"
        conditions.append(between(value, given.min_share, given.max_share, "1", message))
    if given.min_times is not None or given.max_times is not None:
        count = blocking.times(boxed, given.hidden_share)
        blocking.sure(count, blocking.times(bare, given.hidden_share), given.min_times, given.max_times)
        message = (
            f"{', '.join(given.names)} hides {given.hidden_share:.0%} or more of {given.other} {count} times {seen}"
        )
        conditions.append(between(count, given.min_times, given.max_times, "times", message))
    return all_of(*conditions)


def _of(given: Given, share: np.ndarray) -> float:
    return float({"min": share.min(), "mean": share.mean(), "max": share.max()}.get(given.of, share[-1]))


def _shown(trajectory: Trajectory, given: Given, eyes: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(R, P) bool: which points (R, P, 3) lie in the picture; all, where they are seen from a place."""
    if given.camera is None:
        return np.ones(points.shape[:2], dtype=bool)
    lens = OfCamera(camera=given.camera).lens(trajectory)
    pixels = lens.pixels((points - eyes[:, None]).reshape(-1, 3), np.zeros(3))
    return np.asarray(((pixels >= 0) & (pixels <= lens.size)).all(axis=1).reshape(points.shape[:2]))


def _eyes(trajectory: Trajectory, given: Given, rows: np.ndarray) -> np.ndarray:
    """(R, 3) where it is seen from."""
    if given.camera is None:
        return np.tile(np.array(given.place, dtype=float), (len(rows), 1))
    lens = OfCamera(camera=given.camera).lens(trajectory)
    followed = [trajectory.names.index(name) for name in lens.follows if name in trajectory.names]
    if not followed:
        return np.tile(lens.eye, (len(rows), 1))
    return np.stack([lens.eye_at(trajectory.pos[row, followed].mean(axis=0)) for row in rows])


AT = {"body": "leaf", "other": "lamp", "place": [-2, 0, 1]}
SEEN = {"body": "leaf", "other": "lamp", "camera": "camera"}
GOOD = (
    # Half way between, the leaf of 0.2 m covers the lamp of 0.1 m whole, three times in three swings.
    (passing, {**AT, "min_share": 0.99, "min_times": 3, "max_times": 3}),
    (lambda: passing(low=0.1), {**AT, "of": "max", "min_share": 0.3, "max_share": 0.7}),
    (looking, {**SEEN, "min_share": 0.99, "min_times": 3, "max_times": 3}),
    (trembling, {**AT, "min_times": 1, "max_times": 1}),
)
BAD = (
    (passing, {**AT, "of": "min", "min_share": 0.1}),
    (passing, {**AT, "of": "final", "min_share": 0.1}),
    (passing, {**AT, "min_times": 4}),
    (lambda: passing(low=0.3), {**AT, "min_share": 0.05}),
    (lambda: looking(away=True), {**SEEN, "min_share": 0.05}),
    (trembling, {**AT, "min_times": 2}),
)
