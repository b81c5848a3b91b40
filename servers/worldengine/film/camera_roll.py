"""A film's camera that is rolled over: whoever sees it must still tell which way things fall."""

from typing import Any

TOLD_DEG = 30.0
"""More than this is told; a hand-held or canted camera is not."""
STEEP = 0.985
"""A camera that looks so nearly straight up or down, by the sine, shows nothing fall, whichever way it is turned."""


def degrees(film: Any, frame: int) -> float:
    """How far the camera of a frame is rolled about where it looks, -180 to 180 degrees; 0 where that is not told.

    A camera of the plan stands as its plan was approved.
    """
    import numpy as np

    if film.shots[film.shot(frame)]["planned"]:
        return 0.0
    roll = (float(film.arrays["roll_deg"][frame]) + 180.0) % 360.0 - 180.0
    way = film.arrays["target"][frame] - film.arrays["eye"][frame]
    steep = abs(float(way[2])) > STEEP * float(np.linalg.norm(way))
    return 0.0 if steep or abs(roll) <= TOLD_DEG else roll


def words(film: Any, frame: int) -> str:
    """What the picture says of it; empty where its camera stands upright."""
    roll = abs(degrees(film, frame))
    return f"camera rolled {roll:.0f}°" if roll else ""
