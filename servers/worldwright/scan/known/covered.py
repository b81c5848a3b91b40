"""A leaf that swings before a lamp, and covers it now and then."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...model.recording.stills import Lens, Stills
from ...model.recording.trajectory import Trajectory
from .analytic import clock, motion


def passing(low: float = 0.0, **more: Any) -> Trajectory:
    """A cube of 0.1 m, the `lamp`, at (2, 0, 1) m, and one of 0.2 m, the `leaf`, half way to (-2, 0, 1) m, `low` m lower.

    The leaf swings along y by 0.5 m, and is before the lamp at 0.25, 0.75 and 1.25 s.
    """
    t = clock(1.5)
    y = 0.5 * np.cos(2 * np.pi * t)
    return _before(np.stack([0 * t, y, 0 * t + 1.0 - low], axis=1), **more)


def trembling(**more: Any) -> Trajectory:
    """The same leaf, which hides the lower half of the lamp and trembles up and down by 1 mm, four times a second."""
    t = clock(1.5)
    return _before(np.stack([0 * t, 0 * t, 0.9 + 0.001 * np.sin(8 * np.pi * t)], axis=1), **more)


def looking(away: bool = False, **more: Any) -> Trajectory:
    """`passing` before a camera at (-2, 0, 1) m that looks along +x at both, or `away` from them."""
    back = np.array((1.0 if away else -1.0, 0.0, 0.0))
    up = np.array((0.0, 0.0, 1.0))
    lens = Lens(np.array((-2.0, 0.0, 1.0)), np.stack([np.cross(up, back), up, back], axis=1), 40.0, (400, 300))
    return replace(passing(**more), stills=Stills({"camera": lens}, {}))


def _before(leaf: np.ndarray, **more: Any) -> Trajectory:
    """A leaf on its way (T, 3), m, and the lamp."""
    t = clock(1.5)
    pos = np.stack([leaf, np.tile((2.0, 0.0, 1.0), (len(t), 1))], axis=1)
    fast = np.gradient(pos, t, axis=0)
    return motion(t, pos, fast, names=("leaf", "lamp"), size_m=(0.2, 0.1), **more)
