"""What expectations about pictures ask for: a camera of the stills, what it drew, and how large a body is in it."""

from typing import Any

import numpy as np
from pydantic import Field

from worldkit.turning import matrices

from ...model.errors import NotFoundError
from ...model.evidence.reports import NEEDS_STILLS
from ...model.recording.stills import Lens
from ...model.recording.trajectory import Trajectory
from .measured import Name, UnknowableError, Windowed

Array = np.ndarray
ROUND = {"sphere": (0, 0, 0), "ellipsoid": (0, 1, 2)}
"""Which sizes are the radii along x, y, z."""


class OfCamera(Windowed):
    """Something in the picture of a camera."""

    camera: Name = Field(description="a camera of the plan")

    def lens(self, trajectory: Trajectory) -> Lens:
        """Where the camera stands.

        Raises:
            UnknowableError: no stills are drawn of this recording; NotFoundError: there is no such camera.
        """
        stills = trajectory.stills
        if stills is None:
            raise UnknowableError(
                f"{NEEDS_STILLS}: it is measured in pictures, and none are drawn of this recording",
                next_move="worldwright stage start RUN --stage stills, then scan expect again",
            )
        if self.camera not in stills.lenses:
            raise NotFoundError(
                f"there is no camera '{self.camera}' in the stills",
                next_move=f"name one of: {', '.join(stills.lenses)}",
            )
        return stills.lenses[self.camera]

    def picture(self, trajectory: Trajectory) -> Array:
        """Its still, (height, width, 3), 0 to 1."""
        self.lens(trajectory)
        assert trajectory.stills is not None
        try:
            return np.asarray(trajectory.stills.pictures[self.camera], dtype=float) / 255
        except KeyError:
            raise UnknowableError(f"{NEEDS_STILLS}: the still of {self.camera} cannot be read") from None


def sampled(picture: Array, pixels: Array) -> Array:
    """(N, 3) the picture at pixels (N, 2), bilinear; nan outside of it."""
    height, width = picture.shape[:2]
    x, y = pixels[:, 0] - 0.5, pixels[:, 1] - 0.5
    inside = (x >= 0) & (x <= width - 1) & (y >= 0) & (y <= height - 1)
    x, y = np.where(inside, x, 0.0), np.where(inside, y, 0.0)
    left, top = np.minimum(x.astype(int), width - 2), np.minimum(y.astype(int), height - 2)
    u, v = (x - left)[:, None], (y - top)[:, None]
    upper = (1 - u) * picture[top, left] + u * picture[top, left + 1]
    lower = (1 - u) * picture[top + 1, left] + u * picture[top + 1, left + 1]
    return np.where(inside[:, None], (1 - v) * upper + v * lower, np.nan)


def luminance(colours: Array) -> Array:
    """(N,) 0 to 1, of sRGB colours (N, 3): linear light, weighted as the eye does. Source: IEC 61966-2-1; ITU-R BT.709."""
    linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear @ (0.2126, 0.7152, 0.0722))


def outline(trajectory: Trajectory, body: int) -> Array:
    """(P, 3) points on the surface of a body that is drawn, in its own frame, m: of round shapes on them, else box corners.

    Raises:
        UnknowableError: the recording does not tell its shapes.
    """
    rows: list[dict[str, Any]] = [
        row for row in trajectory.meta.get("geoms") or () if row.get("body") == trajectory.names[body]
    ]
    shown = [row for row in rows if row.get("visible", True)] or rows
    clouds = [cloud for row in shown if (cloud := _points(row)) is not None]
    facts = trajectory.mechanics
    if not clouds and facts.half_extents is not None and facts.center is not None:
        half = facts.half_extents[body]
        if np.all(np.isfinite(half)):
            clouds = [_box(facts.center[body], half)]
    if not clouds:
        raise UnknowableError(f"the recording does not tell the shape of {trajectory.names[body]}")
    return np.concatenate(clouds)


def _points(row: dict[str, Any]) -> Array | None:
    kind, size = str(row.get("type", "")), np.array([*row.get("size", ()), 0.0, 0.0, 0.0], dtype=float)
    up = np.array((0.0, 0.0, size[1]))
    if kind in ROUND:
        local = _ball() * size[list(ROUND[kind])]
    elif kind == "capsule":
        ball = _ball() * size[0]
        local = np.concatenate([ball + up, ball - up])
    elif kind == "cylinder":
        turn = np.arange(48) * 2 * np.pi / 48
        ring = np.stack([size[0] * np.cos(turn), size[0] * np.sin(turn), 0 * turn], axis=1)
        local = np.concatenate([ring + up, ring - up])
    elif kind == "plane" or len(row.get("aabb", ())) != 6:
        return None
    else:
        local = _box(np.array(row["aabb"][:3]), np.array(row["aabb"][3:]))
    turn = matrices(np.array(row.get("quat", (1, 0, 0, 0)), dtype=float))
    return np.asarray(local @ turn.T + np.array(row.get("pos", (0, 0, 0)), dtype=float))


def _ball() -> Array:
    u, v = np.meshgrid(np.arange(48) * 2 * np.pi / 48, np.linspace(-np.pi / 2, np.pi / 2, 25))
    return np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)], axis=-1).reshape(-1, 3)


def _box(centre: Array, half: Array) -> Array:
    return np.asarray(centre + half * np.array([(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]))
