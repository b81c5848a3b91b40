"""A medium comes to cover a surface: paint a canvas, snow a bench, water a floor, honey a slice of bread.

Measures the share of a body's upper side, or of a level rectangle of the ground, over which a point of the medium stands at least
`thick_m` above it, and grains down to it: what is in the air covers nothing. Measured at the end of the window; at its
start that share must be under `most_before`. The upper side is that of the box around the body's largest geom, seen along its own
normal, in 32 by 32 cells, or fewer where the points lie farther apart. A medium is named by what shows it. Source: coverage as the
area fraction of a partition.
"""

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.own_laws import pouring
from ....measuring.measured import (
    Measured,
    Name,
    UnknowableError,
    Windowed,
    all_of,
    at_least,
    at_most,
    body_index,
    one_of,
    window,
)

CODE = "WE270"
EVENT = True
CELLS, WIDER, ABOVE = 32, 2.0, 2.0
"""Cells along a side at most, none narrower than so many times as the points lie apart; the lowest of a column lies so near."""
Array = np.ndarray


class Given(Windowed):
    """What covers which surface, and how much of it."""

    medium: Name = Field(description="what shows the points of the law: its `shown_by`")
    body: Name | None = Field(None, description="the body that is covered, on its upper side")
    ground: tuple[float, float, float, float] | None = Field(
        None, description="or a level rectangle of the ground: least x and y, largest x and y, m"
    )
    height_m: float = Field(0.0, description="how high that rectangle lies, m")
    min_share: float = Field(gt=0, le=1, description="least share of its area that is covered in the end")
    thick_m: float = Field(5e-4, ge=0, description="what stands less high above it covers nothing, m")
    most_before: float = Field(0.1, ge=0, lt=1, description="largest share at the start of the window")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "body", "ground")
        if self.ground and not (self.ground[0] < self.ground[2] and self.ground[1] < self.ground[3]):
            raise ValueError("ground is [least x, least y, largest x, largest y]")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The shares at both ends of the window."""
    rows, lay = window(trajectory, given.window_s), trajectory.media.of(given.medium)
    before, after = (
        _share(trajectory, given, row, lay.at(float(trajectory.t[row]))) for row in (rows.start, rows.stop - 1)
    )
    told = f"{given.medium} covers {before:.1%} of {given.body or 'the ground'} at first and {after:.1%} in the end"
    return all_of(at_least(after, given.min_share, "1", told), at_most(before, given.most_before, "1", told))


def _share(trajectory: Trajectory, given: Given, row: int, points: Array) -> float:
    """The share that is covered at a row by points (n, 3) m."""
    middle, axes, half = _side(trajectory, given, row)
    local = (points - middle) @ axes
    on = local[(np.abs(local[:, :2]) < half).all(axis=1)]
    if len(on) < 2:
        return 0.0
    apart = _apart(on)
    cells = np.clip((2 * half / (WIDER * apart)).astype(int), 1, CELLS)
    one = ((on[:, :2] / half + 1) / 2 * cells).astype(int) @ (int(cells[1]), 1)
    low, high = np.full(cells.prod(), np.inf), np.full(cells.prod(), -np.inf)
    np.minimum.at(low, one, on[:, 2])
    np.maximum.at(high, one, on[:, 2])
    skin = any(
        row.get("name") == given.medium for row in trajectory.meta.get("flexes") or ()
    )  # of which only the top is there
    lies = skin | (low < max(ABOVE * apart, given.thick_m))
    return float((lies & (high >= given.thick_m)).mean())


def _apart(points: Array) -> float:
    """How far points (n, 3) m lie from their nearest: the median of a thousand."""
    from scipy.spatial import cKDTree

    some = points[:: -(-len(points) // 1000)]
    return max(float(np.median(cKDTree(points).query(some, k=2)[0][:, 1])), 1e-9)


def _side(trajectory: Trajectory, given: Given, row: int) -> tuple[Array, Array, Array]:
    """Middle (3,) m of the surface, its axes (3, 3) as columns, the last its normal, and its half extents (2,) m."""
    if given.ground:
        low, high = np.array(given.ground[:2]), np.array(given.ground[2:])
        return np.append((low + high) / 2, given.height_m), np.eye(3), (high - low) / 2
    assert given.body is not None
    body = body_index(trajectory, given.body)
    mine = [g for g in trajectory.meta.get("geoms") or () if g["body"] == given.body and g["type"] != "plane"]
    if not mine:
        raise UnknowableError(
            f"the recording does not tell the shape of {given.body}", next_move="name `ground` instead"
        )
    boxes = [np.reshape(g["aabb"], (2, 3)) for g in mine]
    largest = int(np.argmax([np.prod(np.sort(box[1])[1:]) for box in boxes]))
    turn = matrices(trajectory.quat[row, body])
    frame = turn @ matrices(np.array(mine[largest]["quat"], float))
    centre = trajectory.pos[row, body] + turn @ np.array(mine[largest]["pos"]) + frame @ boxes[largest][0]
    up = int(np.argmax(np.abs(frame[2])))
    normal = frame[:, up] * np.sign(frame[2, up])
    rest = [axis for axis in range(3) if axis != up]
    axes = np.stack([*(frame[:, axis] for axis in rest), normal], axis=1)
    return centre + normal * boxes[largest][1][up], axes, boxes[largest][1][rest]


_POURED = {"medium": "paint", "body": "body"}
GOOD = (
    (pouring, {**_POURED, "min_share": 0.95}),
    (lambda: pouring(tilt_deg=20.0), {**_POURED, "min_share": 0.95}),
    (lambda: pouring(share=0.5), {**_POURED, "min_share": 0.45}),
    (pouring, {"medium": "paint", "ground": [-0.2, -0.1, 0.2, 0.1], "height_m": 0.05, "min_share": 0.95}),
    (lambda: pouring(apart=0.03), {**_POURED, "min_share": 0.95}),
)
BAD = (
    (lambda: pouring(share=0.5), {**_POURED, "min_share": 0.6}),
    (lambda: pouring(depth=2e-4), {**_POURED, "min_share": 0.1}),
    (lambda: pouring(begins=0.5), {**_POURED, "min_share": 0.9}),
    (lambda: pouring(depth=0.5), {**_POURED, "min_share": 0.1}),
    (pouring, {"medium": "paint", "ground": [-0.8, -0.1, 0.8, 0.1], "height_m": 0.05, "min_share": 0.5}),
)
