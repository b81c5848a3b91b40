"""Cameras and particles evaluated in every frame of a film, which is what its description holds."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ..errors import ProgramError
from . import fluttering, viewpoints
from .drawn_only import Thing
from .film_bounds import MOST_COPIES
from .recorded import Recorded
from .viewpoints import Viewpoint

SOFT_PX, PICTURE_PX = 1.0, 720
"""While what a still camera focuses on is blurred by no more than this in a picture of so many rows, nobody turns the ring: nothing
else changes in the picture then, and what stands still need not be traced again."""


def sampled(shot: dict[str, Any], recorded: Recorded, number: int) -> dict[str, np.ndarray]:
    """One shot's camera in each of its frames."""
    camera: Viewpoint = shot["camera"]
    times: np.ndarray = shot["times"]
    n = len(times)
    share = np.arange(n) / max(n - 1, 1)
    course = viewpoints.Course(recorded, share, times)
    zeros = np.zeros((n, 3))
    eye = zeros if camera.eye is None else np.asarray(camera.eye(course), dtype=float)
    target = (
        zeros + np.array([1.0, 0.0, 0.0]) if camera.target is None else np.asarray(camera.target(course), dtype=float)
    )
    if eye.shape != (n, 3) or target.shape != (n, 3) or not np.isfinite([eye, target]).all():
        raise ProgramError(f"the camera of shot {number + 1} is nowhere in some frames", "film.py", "check its numbers")
    away = np.linalg.norm(target - eye, axis=1)
    if not camera.planned and away.min() < 1e-4:
        raise ProgramError(f"the camera of shot {number + 1} stands where it looks", "film.py", "move it away")
    if camera.shake:
        unsteady = np.random.default_rng(number).normal(size=(12, 3))
        seconds = np.arange(n) / recorded.fps
        waves = sum(
            unsteady[k] / (1 + k) * np.sin(2 * np.pi * (0.31 + 0.23 * k) * seconds + 1.7 * k)[:, None]
            for k in range(12)
        )
        target = target + camera.shake * 0.012 * away[:, None] * waves
    point = recorded.middle(camera.focus, times) if isinstance(camera.focus, str) else camera.focus
    if point is None:
        focus = away
    elif np.ndim(point):
        focus = np.linalg.norm(np.asarray(point, dtype=float) - eye, axis=1)
    else:
        focus = np.full(n, float(point))  # type: ignore[arg-type]
    fovy_deg = viewpoints.fovy_deg(viewpoints.between(camera.lens_mm, share))
    still = all(np.ptp(part, axis=0).max() == 0 for part in (eye, target, fovy_deg))
    if isinstance(camera.focus, str) and still and focus.min() > 0:
        held = 2.0 / (1.0 / focus.min() + 1.0 / focus.max())
        if _soft_px(held, float(focus.min()), float(fovy_deg[0]), camera.aperture or 0.0) <= SOFT_PX:
            focus = np.full(n, held)
    found = {
        "eye": eye, "target": target, "roll_deg": viewpoints.between(camera.roll_deg, share),
        "fovy_deg": fovy_deg, "focus_m": focus,
        "aperture": np.full(n, camera.aperture or 0.0),
    }  # fmt: skip
    for name, word in (("target", "shake"), ("roll_deg", "roll_deg"), ("focus_m", "focus")):
        if not np.isfinite(found[name]).all():
            raise ProgramError(f"the {word} of shot {number + 1} is no number", "film.py", "check how it is reckoned")
    return found


def _soft_px(focus_m: float, away_m: float, fovy_deg: float, aperture: float) -> float:
    """Radius of the blur of a point so far away, by the thin lens of a full-frame camera: rows of a picture of `PICTURE_PX`."""
    if aperture <= 0:
        return 0.0
    tangent = np.tan(np.radians(fovy_deg) / 2)
    opening_m = viewpoints.FRAME_MM / 1000.0 / (2.0 * tangent) / aperture / 2.0
    return float(opening_m * abs(1.0 / focus_m - 1.0 / away_m) / tangent * 0.5 * PICTURE_PX)


def grown(thing: Thing, at: Callable[[np.ndarray], Any], times: np.ndarray) -> Thing:
    """Particles with their places in every frame."""
    told = at(times)
    if thing.of:  # a piece of a figure that tells its own way: places, 1 where it is shown, and turns
        return replace(thing, ways=told[0], sizes=told[1], turns=told[2])
    places, sizes = told if isinstance(told, tuple) else (told, None)
    places = np.asarray(places, dtype=float)
    good = places.ndim == 3 and places.shape[0] == len(times) and places.shape[2] == 3 and np.isfinite(places).all()
    if not good or not 1 <= places.shape[1] <= MOST_COPIES:
        raise ProgramError(
            f"the particles {thing.name!r} must be ({len(times)}, P, 3) numbers, P at most {MOST_COPIES}; got {places.shape}",
            "film.py",
            "",
        )
    sizes = np.full(places.shape[:2], thing.size[0]) if sizes is None else np.asarray(sizes, dtype=float)
    if sizes.shape != places.shape[:2] or not (np.isfinite(sizes) & (sizes >= 0)).all():
        raise ProgramError(
            f"the diameters of {thing.name!r} must be {places.shape[:2]} numbers, none below 0", "film.py", ""
        )
    if thing.shape == "mesh":
        if isinstance(told, tuple):
            raise ProgramError(f"the leaves {thing.name!r} are all of one size", "film.py", "give their places alone")
        return replace(thing, ways=places, sizes=sizes, turns=fluttering.turns(places, times, thing.size[0]))
    return replace(thing, ways=places, sizes=sizes)
