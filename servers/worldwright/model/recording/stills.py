"""The stills of a recording as expectations see them: the picture of each camera, and where it stood.

A lens looks along its own -z, with x to the right and y up in the picture. Pixels count from the upper left corner, x to the
right and y down. Metres, world frame.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

Array = np.ndarray
NEAR_M = 1e-6


@dataclass(frozen=True)
class Lens:
    """A camera: where it stands, what it shows, and whose motion it follows."""

    eye: Array
    """(3,) m; of one that follows, where it stood in the still."""
    axes: Array
    """(3, 3): its x, y and z axes in the world, as columns."""
    fovy_deg: float
    size: tuple[int, int]
    """Width and height of the picture, pixels."""
    follows: tuple[str, ...] = ()
    """Bodies whose mean place it moves with."""
    along: Array | None = None
    """(3,) bool: the axes of the world along which it follows."""
    away: Array | None = None
    """(3,) m from that mean place to the eye."""

    def pixels(self, points: Array, eye: Array | None = None) -> Array:
        """(N, 2) where points (N, 3) of the world appear; nan for those that are not in front of it."""
        local = (points - (self.eye if eye is None else eye)) @ self.axes
        depth = np.where(local[:, 2] < -NEAR_M, -local[:, 2], np.nan)
        width, height = self.size
        scale = height / 2 / np.tan(np.radians(self.fovy_deg) / 2)
        return np.stack([width / 2 + scale * local[:, 0] / depth, height / 2 - scale * local[:, 1] / depth], axis=1)

    def eye_at(self, middle: Array) -> Array:
        """(3,) where it stands when the mean place of what it follows is `middle`."""
        if self.along is None or self.away is None:
            return self.eye
        return np.where(self.along, middle + self.away, self.eye)


@dataclass(frozen=True)
class Stills:
    """What was drawn of a recording's first instant."""

    lenses: Mapping[str, Lens]
    pictures: Mapping[str, Array]
    """(height, width, 3) uint8, RGB, by camera."""


class OnDisk(Mapping[str, Array]):
    """Pictures that are read when they are asked for."""

    def __init__(self, folder: Path, names: tuple[str, ...]) -> None:
        self.folder, self.names = folder, names

    def __getitem__(self, name: str) -> Array:
        import cv2

        if name not in self.names:
            raise KeyError(name)
        found = cv2.imread(str(self.folder / f"{name}.png"))
        if found is None:
            raise KeyError(name)
        return np.asarray(found[:, :, ::-1])

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)


def lenses(said: Mapping[str, Any]) -> dict[str, Lens]:
    """The cameras of a `cameras.json`, by name; raises KeyError, TypeError or ValueError where it is none."""
    width, height = said["size"]
    return {name: lens(row, (int(width), int(height))) for name, row in said["cameras"].items()}


def lens(row: Mapping[str, Any], size: tuple[int, int]) -> Lens:
    """A camera from its row of `cameras.json`."""
    follow = row.get("follow") or {}
    return Lens(
        np.array(row["eye"], dtype=float),
        np.array(row["axes"], dtype=float),
        float(row["fovy_deg"]),
        size,
        tuple(follow.get("subjects", ())),
        np.array(follow["along"], dtype=bool) if follow else None,
        np.array(follow["away"], dtype=float) if follow else None,
    )
