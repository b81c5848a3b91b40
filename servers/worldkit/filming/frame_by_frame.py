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
    if isinstance(camera.focus, str):
        focus = np.linalg.norm(recorded.position(camera.focus, times) - eye, axis=1)
    else:
        focus = away if camera.focus is None else np.full(n, float(camera.focus))
    found = {
        "eye": eye, "target": target, "roll_deg": viewpoints.between(camera.roll_deg, share),
        "fovy_deg": viewpoints.fovy_deg(viewpoints.between(camera.lens_mm, share)), "focus_m": focus,
        "aperture": np.full(n, camera.aperture or 0.0),
    }  # fmt: skip
    for name, word in (("target", "shake"), ("roll_deg", "roll_deg"), ("focus_m", "focus")):
        if not np.isfinite(found[name]).all():
            raise ProgramError(f"the {word} of shot {number + 1} is no number", "film.py", "check how it is reckoned")
    return found


def grown(thing: Thing, at: Callable[[np.ndarray], Any], times: np.ndarray) -> Thing:
    """Particles with their places in every frame."""
    told = at(times)
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
